// SPDX-License-Identifier: Apache-2.0
// Layout of the shared functions in the store's block: one CallFunction per function, sorted by name hash, each with
// kCallSlots slots through which callers pass arguments and get results. Store::create reserves call_area_size() bytes
// at BlockHeader::functions_offset and calls init_call_area() while the block is still Building; an adopted block keeps
// its area unchanged. Any change here requires a new abi::kVersion.

#pragma once

#include <indurop/detail/shared_mutex.h>

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "core/rt/signal_word.h"
#include "core/schema/schema.h"

namespace indurop::vars {

inline constexpr std::size_t kCallSlots = 16;  // maximum number of concurrent calls of one function

struct alignas(64) CallFunction {
  std::uint64_t name_hash;
  std::uint64_t type_hash;
  std::uint64_t slots_offset;  // of the first CallSlot, from the block's start
  std::uint32_t slot_stride;
  std::uint32_t args_size;
  std::uint32_t result_offset;  // of the result, from the slot's start
  std::uint32_t result_size;
  std::uint32_t schema_index;             // into Schema::functions
  std::atomic<std::uint32_t> wake_index;  // the CallFunction whose `wake` its server sleeps on
  abi::SharedMutex serving;               // held by the server's thread for as long as it serves: free = no server
  std::atomic<std::int32_t> server_pid;   // for display; 0: none yet, or ended normally
  std::uint32_t reserved;
  std::atomic<std::uint64_t> calls;     // answered
  std::atomic<std::uint64_t> given_up;  // no result in time
  rt::SignalWord wake;
};
static_assert(std::is_standard_layout_v<CallFunction>);

// CallSlot::state: sequence number of the request in the upper 56 bits, one of these in the lower 8.
enum class CallState : std::uint8_t {
  Free,
  Ready,      // arguments are there
  Running,    // the server is working on it
  Done,       // result or error is there
  Abandoned,  // the caller no longer waits; the server frees the slot when it is done
};

// A caller owns a slot while it holds `caller`; if it is killed, the next caller gets the slot.
struct alignas(64) CallSlot {
  abi::SharedMutex caller;
  std::atomic<std::uint64_t> state;
  std::atomic<std::uint32_t> error;  // Errc of the answer
  std::uint32_t reserved;
  rt::SignalWord reply;
};
inline constexpr std::size_t kCallArgsOffset = (sizeof(CallSlot) + 63) / 64 * 64;
static_assert(std::is_standard_layout_v<CallSlot>);

// Bytes to reserve, a multiple of 64; 0 without functions. Not real-time safe.
std::size_t call_area_size(const schema::Schema& schema);

// Fills the zeroed area that begins `functions_offset` bytes (a multiple of 64) into `block`. Not real-time safe.
// Returns false if the system cannot create such a lock.
bool init_call_area(std::byte* block, std::uint64_t functions_offset, const schema::Schema& schema);

}  // namespace indurop::vars
