// SPDX-License-Identifier: Apache-2.0

#include "store/vars/call_layout.h"

#include <algorithm>
#include <new>
#include <vector>

#include "core/rt/shared_mutex.h"
#include "store/vars/layout.h"

namespace indurop::vars {

namespace {

constexpr std::uint64_t kLine = 64;

struct Shape {
  std::uint32_t args_size;
  std::uint32_t result_offset;
  std::uint32_t result_size;
  std::uint32_t slot_stride;
};

Shape shape_of(const schema::Function& function) {
  const std::uint64_t args = function.arguments.fields.empty() ? 0 : function.arguments.size();
  const bool is_void = function.result.base == schema::Base::Struct && function.result.fields.empty();
  const std::uint64_t result = is_void ? 0 : function.result.size();
  const std::uint64_t result_offset = kCallArgsOffset + round_up(args, kLine);
  return {static_cast<std::uint32_t>(args), static_cast<std::uint32_t>(result_offset),
          static_cast<std::uint32_t>(result), static_cast<std::uint32_t>(round_up(result_offset + result, kLine))};
}

bool init_slots(std::byte* first, std::uint32_t stride) {
  for (std::size_t i = 0; i < kCallSlots; ++i) {
    auto* slot = ::new (first + i * stride) CallSlot{};
    slot->reply.init(true);
    if (!rt::init_shared_mutex(slot->caller)) {
      return false;
    }
  }
  return true;
}

}  // namespace

std::size_t call_area_size(const schema::Schema& schema) {
  std::uint64_t size = schema.functions.size() * sizeof(CallFunction);
  for (const auto& function : schema.functions) {
    size += std::uint64_t{shape_of(function).slot_stride} * kCallSlots;
  }
  return size;
}

bool init_call_area(std::byte* block, std::uint64_t functions_offset, const schema::Schema& schema) {
  std::vector<std::uint32_t> order(schema.functions.size());
  for (std::uint32_t i = 0; i < order.size(); ++i) {
    order[i] = i;
  }
  const auto hash = [&schema](std::uint32_t index) {
    const std::string& name = schema.functions[index].name;
    return abi::fnv1a64(name.data(), name.size());
  };
  std::sort(order.begin(), order.end(), [&hash](std::uint32_t a, std::uint32_t b) { return hash(a) < hash(b); });

  std::uint64_t slots = functions_offset + order.size() * sizeof(CallFunction);
  for (std::uint32_t i = 0; i < order.size(); ++i) {
    const Shape shape = shape_of(schema.functions[order[i]]);
    auto* entry = ::new (block + functions_offset + i * sizeof(CallFunction)) CallFunction{};
    entry->name_hash = hash(order[i]);
    entry->type_hash = schema.functions[order[i]].type_hash;
    entry->slots_offset = slots;
    entry->slot_stride = shape.slot_stride;
    entry->args_size = shape.args_size;
    entry->result_offset = shape.result_offset;
    entry->result_size = shape.result_size;
    entry->schema_index = order[i];
    entry->wake_index.store(i, std::memory_order_relaxed);
    entry->wake.init(true);
    if (!rt::init_shared_mutex(entry->serving) || !init_slots(block + slots, shape.slot_stride)) {
      return false;
    }
    slots += std::uint64_t{shape.slot_stride} * kCallSlots;
  }
  return true;
}

}  // namespace indurop::vars
