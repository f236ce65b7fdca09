// SPDX-License-Identifier: Apache-2.0
// Passes a description that a module gives of itself (ModuleDescriptor, StateDescriptor) to the node.

#pragma once

#include <cstring>

namespace indurop::detail {

// Copies what both know: `to->size` is the caller's size, and the module's afterwards.
template <class Descriptor>
void hand_over(const Descriptor& from, Descriptor* to) noexcept {
  std::memcpy(static_cast<void*>(to), &from, to->size < from.size ? to->size : from.size);
}

}  // namespace indurop::detail
