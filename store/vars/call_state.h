// SPDX-License-Identifier: Apache-2.0
// The state word of a call slot: request number and CallState in one atomic, so that an answer to an abandoned request
// can never be mistaken for the answer to the next one.

#pragma once

#include <cstdint>

#include "store/vars/call_layout.h"

namespace indurop::vars {

constexpr std::uint64_t word_of(std::uint64_t sequence, CallState state) noexcept {
  return sequence << 8U | static_cast<std::uint64_t>(state);
}
constexpr std::uint64_t sequence_of(std::uint64_t word) noexcept {
  return word >> 8U;
}
constexpr CallState state_of(std::uint64_t word) noexcept {
  return static_cast<CallState>(word & 0xFFU);
}

}  // namespace indurop::vars
