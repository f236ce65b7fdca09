// SPDX-License-Identifier: Apache-2.0
#include "doors/c/describe.h"

#include <algorithm>
#include <cstring>
#include <utility>

namespace indurop::c {

Texts texts_of(std::string name, const schema::Type& type) {
  return {std::move(name), schema::display_name(type), schema::canonical(type)};
}

bool describe(const Texts& texts, const schema::Place& place, irp_variable* variable) {
  if (variable == nullptr || variable->struct_size < sizeof variable->struct_size) {
    return false;
  }
  irp_variable full{};
  full.struct_size = variable->struct_size;
  full.name = texts.name.c_str();
  full.type = texts.type.c_str();
  full.layout = texts.layout.c_str();
  full.unit = place.unit.c_str();
  full.description = place.variable->description.c_str();
  full.source = place.variable->source.c_str();
  full.size = place.type.size();
  if (place.range) {
    full.min = place.range->min;
    full.max = place.range->max;
    full.flags |= IRP_HAS_RANGE;
  }
  full.flags |= place.variable->retain ? static_cast<std::uint32_t>(IRP_RETAIN) : 0U;
  full.flags |= place.variable->given ? static_cast<std::uint32_t>(IRP_PARAMETER) : 0U;
  std::memcpy(variable, &full, std::min(variable->struct_size, sizeof full));
  return true;
}

}  // namespace indurop::c
