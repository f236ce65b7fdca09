// SPDX-License-Identifier: Apache-2.0
// Copies what a module keeps while one of its runs may begin: for keyframes, in the node and in process modules.

#pragma once

#include <indurop/state.h>

#include <cstddef>
#include <span>

namespace indurop::tape {

// A run may write what is being read; the caller discards the bytes then. Word by word where it can.
void copy_racing(std::byte* to, const void* from, std::size_t size) noexcept;

// Calls save() of the module. A run that begins meanwhile may leave it something inconsistent: a fault of it is one
// more reason to try again. Returns the bytes written, 0: it cannot now. On a normal thread.
std::size_t save_by_function(const StateDescriptor& declared, std::span<std::byte> to);

}  // namespace indurop::tape
