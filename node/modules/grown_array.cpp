// SPDX-License-Identifier: Apache-2.0
#include "node/modules/grown_array.h"

#include <charconv>
#include <cstddef>
#include <optional>

namespace indurop::node {
namespace {

struct ArrayType {
  std::string_view element;
  std::size_t count = 0;
};

std::optional<ArrayType> array_type(std::string_view type) noexcept {
  const std::size_t open = type.rfind('[');
  if (open == std::string_view::npos || type.find('[') != open || !type.ends_with(']')) {
    return std::nullopt;
  }
  ArrayType array{type.substr(0, open), 0};
  const char* const end = type.data() + type.size() - 1;
  const auto read = std::from_chars(type.data() + open + 1, end, array.count);
  return read.ec == std::errc() && read.ptr == end ? std::optional(array) : std::nullopt;
}

}  // namespace

bool has_grown(std::string_view before, std::string_view now) noexcept {
  const auto from = array_type(before);
  const auto to = array_type(now);
  return from && to && from->element == to->element && from->count < to->count;
}

}  // namespace indurop::node
