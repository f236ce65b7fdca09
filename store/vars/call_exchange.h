// SPDX-License-Identifier: Apache-2.0
// The caller's side of shared functions. A slot belongs to the holder of its robust mutex, so the slot of a killed
// caller simply passes to the next one; the state word then shows what must be cleaned up. Neither allocates nor waits
// for a lock; it does wait for the answer.

#pragma once

#include <indurop/result.h>

#include <cstdint>

#include "store/vars/call_area.h"

namespace indurop::vars {

// The bytes of arguments and result. The sizes must be those of the function; they are not read from shared memory
// again, where another process could change them meanwhile.
struct CallBytes {
  const void* args = nullptr;
  void* result = nullptr;
  std::uint32_t args_size = 0;
  std::uint32_t result_size = 0;
  std::int64_t deadline_ns = 0;  // from now
};

// Returns Ok if a server serves it, NotFound if there is none, Dead if the server died and no other has started.
Errc find_call_server(CallFunction& function) noexcept;

// What a calling thread keeps from call to call.
struct Caller {
  CallSlot* slot = nullptr;  // held by this thread
  std::uint32_t first = 0;   // first slot to try
};

// Calls the function and waits for the answer. Errors: those of find_call_server(); Busy (all slots are in use),
// Timeout, and that of the function (Failed).
Errc exchange_call(const CallArea& area, CallFunction& function, const CallBytes& call, Caller& caller) noexcept;

// Releases the slot of a thread whose call was interrupted by a fault.
void release_call(Caller& caller) noexcept;

}  // namespace indurop::vars
