// SPDX-License-Identifier: Apache-2.0
#include "core/base/source_line.h"

#include "core/base/utf8.h"

namespace indurop::base {
namespace {

constexpr std::size_t kShown = 120;  // characters of a source line

// Returns where the character after the one at `offset` begins.
std::size_t next_character(std::string_view line, std::size_t offset) {
  do {
    ++offset;
  } while (offset < line.size() && continues_utf8(line[offset]));
  return offset;
}

// Returns the character; one that a terminal might misread is a '?'.
std::string shown(std::string_view one) {
  const auto first = static_cast<unsigned char>(one[0]);
  const bool control = (first < 0x20 && first != '\t') || first == 0x7F || one.starts_with("\xC2\x80");
  return control || first_invalid_utf8(one) ? "?" : std::string(one);
}

}  // namespace

std::string picture_of_line(std::string_view line, std::size_t column, std::size_t width) {
  std::size_t at = 0;
  for (std::size_t offset = 0; at < column - 1 && offset < line.size(); ++at) {
    offset = next_character(line, offset);
  }
  const std::size_t from = at > kShown * 3 / 4 ? at - kShown * 3 / 4 : 0;
  std::size_t offset = 0;
  for (std::size_t i = 0; i < from; ++i) {
    offset = next_character(line, offset);
  }
  std::string text = "    ";
  std::string mark = "    ";
  std::size_t i = from;
  for (; i < from + kShown && offset < line.size(); ++i) {
    const std::size_t next = next_character(line, offset);
    const std::string one = shown(line.substr(offset, next - offset));
    offset = next;
    text += one;
    if (i < at) {
      mark += one == "\t" ? '\t' : ' ';
    } else if (i > at && i < at + width) {
      mark += '~';
    } else if (i == at) {
      mark += '^';
    }
  }
  if (at >= i) {
    mark += '^';
  }
  return text + "\n" + mark + "\n";
}

}  // namespace indurop::base
