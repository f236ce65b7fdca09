// SPDX-License-Identifier: Apache-2.0
#include "control/plc/front/library_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>

namespace indurop::plc {
namespace {

constexpr std::string_view kFirstLine = "indurop plc library 1";

// Consumes "<word> rest" up to the end of the line; none if the line begins with something else.
std::optional<std::string> line_of(std::string_view& text, std::string_view word) {
  const std::size_t end = text.find('\n');
  const std::string_view line = text.substr(0, end);
  if (end == std::string_view::npos || !line.starts_with(word)) {
    return std::nullopt;
  }
  text.remove_prefix(end + 1);
  return std::string(line.substr(std::min(word.size() + 1, line.size())));
}

// Reads "motor.st 1234" and the given number of bytes after it.
bool source_of(const std::string& line, std::string_view& text, LibraryFile& to) {
  const std::size_t blank = line.rfind(' ');
  std::size_t size = 0;
  const char* end = line.data() + line.size();
  const bool number =
      blank != std::string::npos && blank > 0 && std::from_chars(line.data() + blank + 1, end, size).ptr == end;
  if (!number || size >= text.size() || text[size] != '\n') {
    return false;
  }
  to.sources.push_back({line.substr(0, blank), std::string(text.substr(0, size))});
  text.remove_prefix(size + 1);
  return true;
}

std::array<long, 3> numbers_of(std::string_view version) noexcept {
  std::array<long, 3> out{};
  const char* at = version.data();
  const char* end = at + version.size();
  for (long& one : out) {
    at = std::from_chars(at, end, one).ptr;
    at += at < end ? 1 : 0;
  }
  return out;
}

}  // namespace

std::string to_text(const LibraryFile& library) {
  std::string out = fmt::format("{}\nname {}\nversion {}\ndialect {}\n", kFirstLine, library.name, library.version,
                                library.dialect == Dialect::Codesys ? "codesys" : "iec");
  for (const LibrarySource& one : library.sources) {
    out += fmt::format("source {} {}\n{}\n", one.name, one.text.size(), one.text);
  }
  return out;
}

Result<LibraryFile, base::Problem> read_library(std::string_view text) {
  LibraryFile out;
  if (!line_of(text, kFirstLine)) {
    return base::Problem{"this is no library, make one with indurop plc lib"};
  }
  const auto name = line_of(text, "name");
  const auto version = line_of(text, "version");
  const auto dialect = line_of(text, "dialect");
  bool fine = name && version && dialect && is_version(*version);
  while (fine && !text.empty()) {
    const auto source = line_of(text, "source");
    fine = source && source_of(*source, text, out);
  }
  if (!fine) {
    return base::Problem{"this library is damaged, make it again with indurop plc lib"};
  }
  out.name = *name;
  out.version = *version;
  out.dialect = *dialect == "codesys" ? Dialect::Codesys : Dialect::Iec;
  return out;
}

bool is_version(std::string_view text) noexcept {
  int dots = 0;
  char before = '.';
  for (const char c : text) {
    const bool digit = c >= '0' && c <= '9';
    if (!digit && (c != '.' || before == '.')) {
      return false;
    }
    dots += c == '.' ? 1 : 0;
    before = c;
  }
  constexpr std::size_t kMaxLetters = 20;
  return !text.empty() && before != '.' && dots <= 2 && text.size() <= kMaxLetters;
}

bool does_for(std::string_view version, std::string_view wanted) {
  const auto own = numbers_of(version);
  const auto least = numbers_of(wanted);
  return own[0] == least[0] && own >= least;
}

LibraryChoice library_choice(const std::string& text) {
  const std::size_t at = text.rfind('@');
  const bool chosen = at != std::string::npos && is_version(std::string_view(text).substr(at + 1));
  return chosen ? LibraryChoice{text.substr(0, at), text.substr(at + 1)} : LibraryChoice{text, ""};
}

}  // namespace indurop::plc
