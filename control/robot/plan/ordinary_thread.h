// SPDX-License-Identifier: Apache-2.0
// A background thread for work that may take longer than a tick.

#pragma once

#include <pthread.h>

#include <cstddef>

namespace indurop::robot {

// Starts a thread with ordinary priority whatever the calling thread has: below every tick, on any processor, and with
// a stack of the given size, since all of it may be locked in memory. Returns false if no thread can be created.
bool begin_ordinary_thread(pthread_t& thread, const char* name, std::size_t stack, void* (*enter)(void*),
                           void* with) noexcept;

}  // namespace indurop::robot
