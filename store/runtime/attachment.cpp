// SPDX-License-Identifier: Apache-2.0

#include "store/runtime/attachment.h"

#include <algorithm>
#include <cstring>
#include <utility>

namespace indurop::runtime {

namespace {

bool is_plausible(const vars::CallFunction& function, std::uint64_t total_size) noexcept {
  const std::uint64_t needed = std::uint64_t{function.result_offset} + function.result_size;
  const std::uint64_t args_end = vars::kCallArgsOffset + function.args_size;
  const std::uint64_t slots = std::uint64_t{function.slot_stride} * vars::kCallSlots;
  return function.slots_offset % alignof(vars::CallSlot) == 0 && function.slot_stride % alignof(vars::CallSlot) == 0 &&
         args_end <= function.slot_stride && needed <= function.slot_stride && function.slots_offset <= total_size &&
         slots <= total_size - function.slots_offset;
}

}  // namespace

Result<Attachment> Attachment::open(const std::string& node) {
  auto store = vars::Store::attach(node, vars::Mode::ReadWrite);
  if (!store) {
    return store.error();
  }
  return Attachment(std::move(store).value());
}

Attachment::Attachment(vars::Store& store) : borrowed_(&store) {
  find_functions();
}

Attachment::Attachment(vars::Store&& store) : owned_(std::move(store)) {
  find_functions();
}

void Attachment::find_functions() {
  const vars::BlockHeader& header = store().header();
  node_.assign(header.node_name, strnlen(header.node_name, sizeof header.node_name));
  block_ = reinterpret_cast<std::byte*>(const_cast<vars::BlockHeader*>(&header));  // NOLINT: mapped read-write
  const std::uint64_t size = std::uint64_t{header.function_count} * sizeof(vars::CallFunction);
  if (header.functions_offset > header.total_size || size > header.total_size - header.functions_offset ||
      header.functions_offset % alignof(vars::CallFunction) != 0) {
    return;
  }
  functions_ = {reinterpret_cast<vars::CallFunction*>(block_ + header.functions_offset), header.function_count};
  const auto broken = [&header](const auto& function) { return !is_plausible(function, header.total_size); };
  if (std::any_of(functions_.begin(), functions_.end(), broken)) {
    functions_ = {};
  }
}

vars::CallFunction* Attachment::function(std::uint64_t name_hash) const noexcept {
  const auto found =
      std::lower_bound(functions_.begin(), functions_.end(), name_hash,
                       [](const auto& function, std::uint64_t hash) { return function.name_hash < hash; });
  return found != functions_.end() && found->name_hash == name_hash ? &*found : nullptr;
}

vars::CallFunction& Attachment::wake_of(const vars::CallFunction& function) const noexcept {
  const std::uint32_t index = function.wake_index.load(std::memory_order_acquire);
  return functions_[index < functions_.size() ? index : 0];
}

vars::CallSlot& Attachment::slot(const vars::CallFunction& function, std::size_t index) const noexcept {
  return *reinterpret_cast<vars::CallSlot*>(block_ + function.slots_offset + index * function.slot_stride);
}

}  // namespace indurop::runtime
