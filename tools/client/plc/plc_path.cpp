// SPDX-License-Identifier: Apache-2.0
#include "tools/client/plc/plc_path.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "control/plc/emit/watch_layout.h"
#include "control/plc/model/elementary.h"

namespace indurop::tools {
namespace {

// Consumes ".X" of ".X.Y".
bool enter_field(Part& part, std::string_view& path) {
  path.remove_prefix(1);
  const std::size_t end = std::min(path.find_first_of(".["), path.size());
  for (const plc::Field& field : part.type->fields) {
    if (plc::same_name(field.name, path.substr(0, end))) {
      part.type = field.type;
      part.place += "." + field.member();
      path.remove_prefix(end);
      return true;
    }
    part.offset += plc::packed_size(*field.type);
  }
  return false;
}

// Consumes "[1,2]" of "[1,2].Y".
bool enter_element(Part& part, std::string_view& path) {
  std::size_t number = 0;
  for (const plc::Bounds& bounds : part.type->dimensions) {
    path.remove_prefix(1);  // [ or ,
    std::int64_t index = 0;
    const auto [end, error] = std::from_chars(path.data(), path.data() + path.size(), index);
    if (error != std::errc() || index < bounds.low || index > bounds.high || end == path.data() + path.size()) {
      return false;
    }
    path.remove_prefix(static_cast<std::size_t>(end - path.data()));
    part.place += fmt::format("[{}]", index - bounds.low);
    number = number * bounds.count() + static_cast<std::size_t>(index - bounds.low);
  }
  if (!path.starts_with(']')) {
    return false;
  }
  path.remove_prefix(1);
  part.type = part.type->element;
  part.offset += number * plc::packed_size(*part.type);
  return true;
}

}  // namespace

std::optional<Part> part_of(const plc::Type& type, std::string_view path) {
  Part part{&type};
  while (!path.empty()) {
    const bool fine = part.type->kind == plc::Type::Kind::Struct && path.front() == '.'  ? enter_field(part, path)
                      : part.type->kind == plc::Type::Kind::Array && path.front() == '[' ? enter_element(part, path)
                                                                                         : false;
    if (!fine) {
      return std::nullopt;
    }
  }
  return part;
}

}  // namespace indurop::tools
