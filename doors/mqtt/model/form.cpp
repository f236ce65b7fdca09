// SPDX-License-Identifier: Apache-2.0
#include "doors/mqtt/model/form.h"

#include <algorithm>
#include <array>
#include <string>
#include <utility>

namespace indurop::mqtt {
namespace {

using schema::Base;

constexpr std::uint64_t kMostTypeBytes = std::uint64_t{64} << 20U;

std::optional<Base> base_of(const std::string& kind) {
  constexpr std::array<std::pair<std::string_view, Base>, 15> kKinds{{{"bool", Base::Bool},
                                                                      {"char", Base::Char},
                                                                      {"i8", Base::Int8},
                                                                      {"u8", Base::UInt8},
                                                                      {"i16", Base::Int16},
                                                                      {"u16", Base::UInt16},
                                                                      {"i32", Base::Int32},
                                                                      {"u32", Base::UInt32},
                                                                      {"i64", Base::Int64},
                                                                      {"u64", Base::UInt64},
                                                                      {"f32", Base::Float},
                                                                      {"f64", Base::Double},
                                                                      {"text", Base::Text},
                                                                      {"enum", Base::Enum},
                                                                      {"struct", Base::Struct}}};
  const auto* const found =
      std::find_if(kKinds.begin(), kKinds.end(), [&kind](const auto& pair) { return pair.first == kind; });
  return found != kKinds.end() ? std::optional(found->second) : std::nullopt;
}

bool add_fields(const base::Json& form, schema::Type& type) {
  for (const base::Json& one : form["fields"].values()) {
    auto field_type = type_of(one["type"]);
    const auto offset = one["offset"].natural();
    if (!field_type || !offset || *offset > type.element_size || *offset + field_type->size() > type.element_size) {
      return false;
    }
    schema::Field field;
    field.name = one["name"].text().value_or("");
    field.type = std::move(*field_type);
    field.offset = static_cast<std::uint32_t>(*offset);
    field.unit = one["unit"].text().value_or("");
    type.fields.push_back(std::move(field));
  }
  return true;
}

}  // namespace

std::optional<schema::Type> type_of(const base::Json& form) {
  const auto base = base_of(form["kind"].text().value_or(""));
  const auto size = form["size"].natural();
  if (!base || !size || *size == 0 || *size > kMostTypeBytes) {
    return std::nullopt;
  }
  schema::Type type;
  type.base = *base;
  type.name = form["name"].text().value_or("");
  type.element_size = static_cast<std::uint32_t>(*size);
  type.text_size = *base == Base::Text ? type.element_size : 0;
  const std::uint32_t needed = *base == Base::Enum ? sizeof(std::int32_t) : schema::size_of(*base);
  if (type.element_size < needed) {
    return std::nullopt;
  }
  for (const base::Json& dim : form["dims"].values()) {
    const auto count = dim.natural();
    if (!count || *count == 0 || *count > kMostTypeBytes) {
      return std::nullopt;
    }
    type.dims.push_back(static_cast<std::uint32_t>(*count));
  }
  if (type.size() > kMostTypeBytes || !add_fields(form, type)) {
    return std::nullopt;
  }
  const base::Json& names = form["enumerators"];
  for (std::size_t i = 0; i < names.keys().size(); ++i) {
    type.enumerators.push_back({names.keys()[i], names.values()[i].integer().value_or(0)});
  }
  return type;
}

}  // namespace indurop::mqtt
