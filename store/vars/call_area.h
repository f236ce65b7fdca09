// SPDX-License-Identifier: Apache-2.0
// The shared functions in a block that is mapped for writing: found by the hash of their name.

#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "store/vars/call_layout.h"
#include "store/vars/layout.h"

namespace indurop::vars {

class CallArea {
 public:
  CallArea() = default;
  // Empty if the block's data about functions is inconsistent. The block must stay mapped.
  explicit CallArea(const BlockHeader& header) noexcept;

  // Returns null if the node does not know the function. Real-time safe.
  [[nodiscard]] CallFunction* function(std::uint64_t name_hash) const noexcept;
  [[nodiscard]] std::uint32_t index_of(const CallFunction& function) const noexcept {
    return static_cast<std::uint32_t>(&function - functions_.data());
  }
  // The function whose wake word the server of `function` sleeps on.
  [[nodiscard]] CallFunction& wake_of(const CallFunction& function) const noexcept;
  [[nodiscard]] CallSlot& slot(const CallFunction& function, std::size_t index) const noexcept;

 private:
  std::byte* block_ = nullptr;
  std::span<CallFunction> functions_;  // sorted by name hash
};

}  // namespace indurop::vars
