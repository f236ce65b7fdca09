// SPDX-License-Identifier: Apache-2.0
// Short ways to write types for the tests of core/schema/.

#pragma once

#include <string>
#include <utility>
#include <vector>

#include "core/schema/schema.h"

namespace indurop::schema {

inline Type number(Base base, std::vector<std::uint32_t> dims = {}) {
  Type type;
  type.base = base;
  type.element_size = type.align = size_of(base);
  type.dims = std::move(dims);
  return type;
}

inline Type text(std::uint32_t bytes, std::vector<std::uint32_t> dims = {}) {
  Type type;
  type.base = Base::Text;
  type.text_size = type.element_size = bytes;
  type.dims = std::move(dims);
  return type;
}

inline Type enumeration(std::string name, std::vector<Enumerator> values) {
  Type type = number(Base::Enum);
  type.name = std::move(name);
  type.enumerators = std::move(values);
  return type;
}

// Lays the fields out as C does.
inline Type structure(std::string name, const std::vector<std::pair<std::string, Type>>& fields,
                      std::vector<std::uint32_t> dims = {}) {
  Type type;
  type.base = Base::Struct;
  type.name = std::move(name);
  type.dims = std::move(dims);
  const auto up = [](std::uint32_t at, std::uint32_t align) { return (at + align - 1) / align * align; };
  for (const auto& [field_name, field_type] : fields) {
    Field field;
    field.name = field_name;
    field.offset = up(type.element_size, field_type.align);
    type.element_size = field.offset + static_cast<std::uint32_t>(field_type.size());
    type.align = std::max(type.align, field_type.align);
    field.type = field_type;
    type.fields.push_back(std::move(field));
  }
  type.element_size = up(type.element_size, type.align);
  return type;
}

inline Variable variable(std::string name, Type type) {
  Variable out;
  out.name = std::move(name);
  out.type_hash = hash_of(type);
  const bool scalar = type.dims.empty() && size_of(type.base) != 0;
  out.kind = scalar ? abi::Kind::Scalar : abi::Kind::Ring;
  out.type = std::move(type);
  return out;
}

// struct { double x; double y; double z; } joints[10] of Figure 3.
inline Type joints_type() {
  const Type real = number(Base::Double);
  return structure("knu::Robot::joints_t", {{"x", real}, {"y", real}, {"z", real}}, {10});
}

inline Type mode_type() {
  return enumeration("knu::Robot::Mode", {{"Off", 0}, {"Manual", 1}, {"Auto", 2}});
}

}  // namespace indurop::schema
