// SPDX-License-Identifier: Apache-2.0
// Waits for condition variables created elsewhere, by CLOCK_MONOTONIC whatever clock they were created for.

#pragma once

#include <pthread.h>

#include "core/rt/clock.h"

namespace indurop::rt {

// Like pthread_cond_wait(): `mutex` is locked before and after; may wake up spuriously. Returns false on an error.
bool wait_for_condition(pthread_cond_t& condition, pthread_mutex_t& mutex) noexcept;
// The same until `deadline`. Returns false if it passed without a signal.
bool wait_for_condition(pthread_cond_t& condition, pthread_mutex_t& mutex, MonoTime deadline) noexcept;

}  // namespace indurop::rt
