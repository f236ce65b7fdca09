// SPDX-License-Identifier: Apache-2.0
#include "doors/fmi/description/parts.h"

#include <fmt/format.h>

#include <cstddef>
#include <utility>

#include "core/schema/leaf.h"

namespace indurop::fmi {
namespace {

void visit_elements(ShownPart part, std::size_t dimension, const std::function<void(ShownPart)>& use);

void visit(const ShownPart& part, const std::function<void(ShownPart)>& use) {
  if (part.type->base != schema::Base::Struct) {
    use(part);
    return;
  }
  for (const schema::Field& field : part.type->fields) {
    ShownPart inner = part;
    inner.name += '.' + field.name;
    inner.type = &field.type;
    inner.offset += field.offset;
    inner.unit = field.unit.empty() ? part.unit : field.unit;
    inner.description = field.description.empty() ? part.description : field.description;
    inner.range = field.range ? field.range : part.range;
    visit_elements(std::move(inner), 0, use);
  }
}

// Visits all elements of the dimensions from this one on.
void visit_elements(ShownPart part, std::size_t dimension, const std::function<void(ShownPart)>& use) {
  if (dimension == part.type->dims.size()) {
    visit(part, use);
    return;
  }
  const auto stride = static_cast<std::uint32_t>(schema::stride_of(*part.type, dimension));
  for (std::uint32_t i = 0; i < part.type->dims[dimension]; ++i) {
    ShownPart element = part;
    element.name += fmt::format("[{}]", i);
    element.offset += i * stride;
    visit_elements(std::move(element), dimension + 1, use);
  }
}

}  // namespace

std::uint64_t count_parts(const schema::Type& type) {
  std::uint64_t count = type.base == schema::Base::Struct ? 0 : 1;
  for (const schema::Field& field : type.fields) {
    count += count_parts(field.type);
  }
  for (const std::uint32_t dimension : type.dims) {
    count *= dimension;  // at most the bytes of the variable
  }
  return count;
}

void for_each_part(const schema::Variable& variable, const std::function<void(ShownPart)>& use) {
  visit_elements({variable.name, &variable.type, 0, variable.unit, variable.description, variable.range}, 0, use);
}

}  // namespace indurop::fmi
