// SPDX-License-Identifier: Apache-2.0
// How a diagnostic is printed: the form compilers use, which editors can jump to.
#include <algorithm>

#include "deploy/config.h"

namespace indurop::deploy {
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

}  // namespace

std::string to_string(const Diagnostic& diagnostic) {
  std::string text = diagnostic.file;
  if (diagnostic.place.line > 0) {
    text += ":" + std::to_string(diagnostic.place.line);
    if (diagnostic.place.column > 0) {
      text += ":" + std::to_string(diagnostic.place.column);
    }
  }
  text += (text.empty() ? "" : ": ") + std::string(word(diagnostic.severity)) + ": " + diagnostic.text;
  for (char& c : text) {
    c = static_cast<unsigned char>(c) < 0x20 ? ' ' : c;  // one line, whatever a name in the file holds
  }
  return text;
}

bool has_error(const std::vector<Diagnostic>& diagnostics) noexcept {
  return std::any_of(diagnostics.begin(), diagnostics.end(),
                     [](const Diagnostic& d) { return d.severity == Diagnostic::Severity::Error; });
}

}  // namespace indurop::deploy
