// SPDX-License-Identifier: Apache-2.0
#include "network/mirror/external/external_type.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>

#include "network/dds/descriptor.h"

namespace indurop::mirror {
namespace {

std::string replace_scopes(const std::string& name, const char* by) {
  std::string out;
  for (std::size_t i = 0; i < name.size(); ++i) {
    if (name.compare(i, 2, "::") == 0) {
      out += by;
      ++i;
    } else {
      out += name[i];
    }
  }
  return out;
}

void tidy(const schema::Type& type, std::uint8_t* at, std::uint64_t size) noexcept {
  const std::uint64_t step = type.element_size;
  if (!holds_text(type) || step == 0) {
    return;
  }
  for (std::uint64_t offset = 0; offset + step <= size; offset += step) {
    if (type.base == schema::Base::Text) {
      std::uint8_t* const end = at + offset + step;
      std::fill(std::find(at + offset, end - 1, std::uint8_t{0}), end, std::uint8_t{0});
      continue;
    }
    for (const schema::Field& field : type.fields) {
      tidy(field.type, at + offset + field.offset, field.type.size());
    }
  }
}

bool can_be_strange(const schema::Type& type) noexcept {
  return type.base == schema::Base::Bool || type.base == schema::Base::Enum ||
         std::any_of(type.fields.begin(), type.fields.end(),
                     [](const auto& field) { return can_be_strange(field.type); });
}

std::string strange_part(const schema::Type& type, const std::uint8_t* at, std::uint64_t size,
                         const std::string& path) {
  if (!can_be_strange(type) || type.element_size == 0) {
    return {};
  }
  for (std::uint64_t offset = 0; offset + type.element_size <= size; offset += type.element_size) {
    std::int64_t number = 0;
    bool known = true;
    if (type.base == schema::Base::Bool) {
      number = at[offset];
      known = number <= 1;
    } else if (type.base == schema::Base::Enum) {
      std::int32_t value = 0;
      std::memcpy(&value, at + offset, sizeof value);
      number = value;
      known = std::any_of(type.enumerators.begin(), type.enumerators.end(),
                          [value](const schema::Enumerator& one) { return one.value == value; });
    }
    if (!known) {
      return path.empty() ? std::to_string(number) : fmt::format("{}: {}", path, number);
    }
    for (const schema::Field& field : type.fields) {
      std::string found = strange_part(field.type, at + offset + field.offset, field.type.size(),
                                       path.empty() ? field.name : path + "." + field.name);
      if (!found.empty()) {
        return found;
      }
    }
  }
  return {};
}

}  // namespace

std::string strange_value(const schema::Type& type, std::span<const std::uint8_t> value) {
  return strange_part(type, value.data(), value.size(), "");
}

std::string idl_type_name(const schema::Variable& variable) {
  const bool plain = variable.type.base == schema::Base::Struct && variable.type.dims.empty();
  return plain ? variable.type.name : variable.name + "_";
}

std::string descriptor_symbol(const schema::Variable& variable) {
  return replace_scopes(idl_type_name(variable), "_") + "_desc";
}

std::string descriptor_problem(const void* descriptor, const schema::Variable& variable) {
  const dds::DescribedType type = dds::described(descriptor);
  const std::string name = idl_type_name(variable);
  if (name != type.name) {
    return fmt::format("its type is {} where {} is expected", type.name.empty() ? "?" : type.name, name);
  }
  if (type.size != variable.type.size()) {
    return fmt::format("{} has {} bytes there and {} here", name, type.size, variable.type.size());
  }
  return type.keys == 0 ? std::string{} : name + " has a key there";
}

schema::Type unwrapped(const schema::Type& type, const std::string& variable) {
  const bool wrapper = type.base == schema::Base::Struct && type.dims.empty() && type.name == variable + "_" &&
                       type.fields.size() == 1 && type.fields.front().name == "value";
  return wrapper ? type.fields.front().type : type;
}

std::string external_topic(const std::string& variable) {
  return replace_scopes(variable, "/");
}

bool holds_text(const schema::Type& type) noexcept {
  return type.base == schema::Base::Text ||
         std::any_of(type.fields.begin(), type.fields.end(), [](const auto& field) { return holds_text(field.type); });
}

void tidy_texts(const schema::Type& type, std::span<std::uint8_t> value) noexcept {
  tidy(type, value.data(), value.size());
}

}  // namespace indurop::mirror
