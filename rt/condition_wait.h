// SPDX-License-Identifier: Apache-2.0
// Waits for condition variables that others made, by CLOCK_MONOTONIC whatever clock they were made for.

#pragma once

#include <pthread.h>

#include "rt/clock.h"

namespace indurop::rt {

// As pthread_cond_wait(): `mutex` is locked before and after; may be woken for nothing. False: an error.
bool wait_for_condition(pthread_cond_t& condition, pthread_mutex_t& mutex) noexcept;
// The same until `deadline`. False: it is over and nobody signalled.
bool wait_for_condition(pthread_cond_t& condition, pthread_mutex_t& mutex, MonoTime deadline) noexcept;

}  // namespace indurop::rt
