// SPDX-License-Identifier: Apache-2.0
// A thread beside the tick, for what may take its time.

#pragma once

#include <pthread.h>

#include <cstddef>

namespace indurop::robot {

// Whatever the thread is that calls this: below every tick, on any processor, and with a stack of its own size, since
// all of it may be locked in memory. False: there can be none.
bool begin_ordinary_thread(pthread_t& thread, const char* name, std::size_t stack, void* (*enter)(void*),
                           void* with) noexcept;

}  // namespace indurop::robot
