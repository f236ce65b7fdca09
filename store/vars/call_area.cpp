// SPDX-License-Identifier: Apache-2.0
#include "store/vars/call_area.h"

#include <algorithm>

namespace indurop::vars {
namespace {

bool is_plausible(const CallFunction& function, std::uint64_t total_size) noexcept {
  const std::uint64_t needed = std::uint64_t{function.result_offset} + function.result_size;
  const std::uint64_t args_end = kCallArgsOffset + function.args_size;
  const std::uint64_t slots = std::uint64_t{function.slot_stride} * kCallSlots;
  return function.slots_offset % alignof(CallSlot) == 0 && function.slot_stride % alignof(CallSlot) == 0 &&
         args_end <= function.slot_stride && needed <= function.slot_stride && function.slots_offset <= total_size &&
         slots <= total_size - function.slots_offset;
}

}  // namespace

CallArea::CallArea(const BlockHeader& header) noexcept
    : block_(reinterpret_cast<std::byte*>(const_cast<BlockHeader*>(&header))) {  // NOLINT: mapped read-write
  const std::uint64_t size = std::uint64_t{header.function_count} * sizeof(CallFunction);
  if (header.functions_offset > header.total_size || size > header.total_size - header.functions_offset ||
      header.functions_offset % alignof(CallFunction) != 0) {
    return;
  }
  functions_ = {reinterpret_cast<CallFunction*>(block_ + header.functions_offset), header.function_count};
  const auto broken = [&header](const auto& function) { return !is_plausible(function, header.total_size); };
  if (std::any_of(functions_.begin(), functions_.end(), broken)) {
    functions_ = {};
  }
}

CallFunction* CallArea::function(std::uint64_t name_hash) const noexcept {
  const auto found =
      std::lower_bound(functions_.begin(), functions_.end(), name_hash,
                       [](const auto& function, std::uint64_t hash) { return function.name_hash < hash; });
  return found != functions_.end() && found->name_hash == name_hash ? &*found : nullptr;
}

CallFunction& CallArea::wake_of(const CallFunction& function) const noexcept {
  const std::uint32_t index = function.wake_index.load(std::memory_order_acquire);
  return functions_[index < functions_.size() ? index : 0];
}

CallSlot& CallArea::slot(const CallFunction& function, std::size_t index) const noexcept {
  return *reinterpret_cast<CallSlot*>(block_ + function.slots_offset + index * function.slot_stride);
}

}  // namespace indurop::vars
