// SPDX-License-Identifier: Apache-2.0
#include "store/tape/grown_array.h"

#include <charconv>
#include <cstdint>
#include <optional>

namespace indurop::tape {
namespace {

// An array of one dimension: "int [4]", or "ARRAY[1..4] OF INT" of a PLC program.
struct ArrayType {
  std::string_view element;
  std::int64_t first = 0;  // its lowest index
  std::int64_t last = 0;
};

// Reads a number at the beginning of `text` and what has to be behind it, and removes both.
std::optional<std::int64_t> take_number(std::string_view& text, std::string_view behind) noexcept {
  std::int64_t number = 0;
  const auto read = std::from_chars(text.data(), text.data() + text.size(), number);
  text.remove_prefix(static_cast<std::size_t>(read.ptr - text.data()));
  if (read.ec != std::errc() || !text.starts_with(behind)) {
    return std::nullopt;
  }
  text.remove_prefix(behind.size());
  return number;
}

std::optional<ArrayType> array_type(std::string_view type) noexcept {
  constexpr std::string_view kArray = "ARRAY[";
  if (type.starts_with(kArray)) {
    type.remove_prefix(kArray.size());
    const auto first = take_number(type, "..");
    const auto last = first ? take_number(type, "] OF ") : std::nullopt;
    return last ? std::optional(ArrayType{type, *first, *last}) : std::nullopt;
  }
  const std::size_t open = type.rfind('[');
  if (open == std::string_view::npos || type.find('[') != open) {
    return std::nullopt;
  }
  const std::string_view element = type.substr(0, open);
  type.remove_prefix(open + 1);
  const auto count = take_number(type, "]");
  return count && type.empty() ? std::optional(ArrayType{element, 0, *count - 1}) : std::nullopt;
}

}  // namespace

bool has_grown(std::string_view before, std::string_view now) noexcept {
  const auto from = array_type(before);
  const auto to = array_type(now);
  return from && to && from->element == to->element && from->first == to->first && from->last < to->last;
}

}  // namespace indurop::tape
