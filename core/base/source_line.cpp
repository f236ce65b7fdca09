// SPDX-License-Identifier: Apache-2.0
#include "core/base/source_line.h"

#include <algorithm>
#include <vector>

#include "core/base/utf8.h"

namespace indurop::base {
namespace {

constexpr std::size_t kShown = 120;  // characters of a source line

// Returns one element per character; characters that a terminal might misread become '?'.
std::vector<std::string> shown_characters(std::string_view line) {
  std::vector<std::string> out;
  for (std::size_t i = 0; i < line.size();) {
    std::size_t length = 1;
    while (i + length < line.size() && base::continues_utf8(line[i + length])) {
      ++length;
    }
    const std::string_view one = line.substr(i, length);
    const auto first = static_cast<unsigned char>(one[0]);
    const bool control = (first < 0x20 && first != '\t') || first == 0x7F || one.starts_with("\xC2\x80");
    out.emplace_back(control || first_invalid_utf8(one) ? "?" : std::string(one));
    i += length;
  }
  return out;
}

}  // namespace

std::string picture_of_line(std::string_view line, std::size_t column, std::size_t width) {
  const std::vector<std::string> shown = shown_characters(line);
  const std::size_t at = std::min(column - 1, shown.size());
  const std::size_t from = at > kShown * 3 / 4 ? at - kShown * 3 / 4 : 0;
  const std::size_t to = std::min(shown.size(), from + kShown);
  std::string text = "    ";
  std::string mark = "    ";
  for (std::size_t i = from; i < to; ++i) {
    text += shown[i];
    if (i < at) {
      mark += shown[i] == "\t" ? '\t' : ' ';
    } else if (i > at && i < at + width) {
      mark += '~';
    } else if (i == at) {
      mark += '^';
    }
  }
  if (at >= to) {
    mark += '^';
  }
  return text + "\n" + mark + "\n";
}

}  // namespace indurop::base
