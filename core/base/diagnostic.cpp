// SPDX-License-Identifier: Apache-2.0
// How a diagnostic is printed: the form compilers use, which editors can jump to.
#include "core/base/diagnostic.h"

#include <algorithm>
#include <limits>
#include <map>
#include <tuple>
#include <utility>

namespace indurop::base {
namespace {

const char* word(Diagnostic::Severity severity) noexcept {
  switch (severity) {
    case Diagnostic::Severity::Error:
      return "error";
    case Diagnostic::Severity::Warning:
      return "warning";
    case Diagnostic::Severity::Note:
      return "note";
  }
  return "";
}

// A name in a file may contain line breaks.
std::string in_one_line(std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](char c) { return static_cast<unsigned char>(c) < 0x20; }, ' ');
  return text;
}

}  // namespace

DiagnosticLine line_of(const Diagnostic& diagnostic, std::string_view program) {
  std::string place = diagnostic.file.empty() ? std::string(program) : diagnostic.file;
  if (diagnostic.place.line > 0) {
    place += ":" + std::to_string(diagnostic.place.line);
    if (diagnostic.place.column > 0) {
      place += ":" + std::to_string(diagnostic.place.column);
    }
  }
  place += place.empty() ? "" : ": ";
  const std::string within = diagnostic.within.empty() ? "" : diagnostic.within + ": ";
  return {in_one_line(std::move(place)), std::string(word(diagnostic.severity)) + ":",
          in_one_line(" " + within + diagnostic.text)};
}

std::string to_string(const Diagnostic& diagnostic, std::string_view program) {
  const DiagnosticLine line = line_of(diagnostic, program);
  return line.place + line.word + line.text;
}

std::string to_text(const std::vector<Diagnostic>& diagnostics, std::string_view program) {
  std::string text;
  for (const Diagnostic& one : diagnostics) {
    text += to_string(one, program) + "\n" + one.picture;
  }
  return text;
}

bool has_error(const std::vector<Diagnostic>& diagnostics) noexcept {
  return std::any_of(diagnostics.begin(), diagnostics.end(),
                     [](const Diagnostic& d) { return d.severity == Diagnostic::Severity::Error; });
}

void sort_by_place(std::vector<Diagnostic>& diagnostics) {
  const auto key = [](const Diagnostic& d) {
    return std::pair(d.place.line == 0 ? std::numeric_limits<int>::max() : d.place.line, d.place.column);
  };
  std::stable_sort(diagnostics.begin(), diagnostics.end(),
                   [key](const Diagnostic& a, const Diagnostic& b) { return key(a) < key(b); });
}

void sort_by_file(std::vector<Diagnostic>& diagnostics, const std::vector<std::string>& first) {
  std::map<std::string, std::size_t, std::less<>> order;
  for (const std::string& file : first) {
    order.try_emplace(file, order.size());
  }
  for (const Diagnostic& one : diagnostics) {
    order.try_emplace(one.file, order.size());
  }
  const auto key = [&](const Diagnostic& d) {
    return std::tuple(order.find(d.file)->second, d.place.line, d.place.column);
  };
  std::stable_sort(diagnostics.begin(), diagnostics.end(),
                   [key](const Diagnostic& a, const Diagnostic& b) { return key(a) < key(b); });
}

}  // namespace indurop::base
