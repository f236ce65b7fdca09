// SPDX-License-Identifier: Apache-2.0
// Linux lets the waiting thread choose the clock.
#include "core/rt/condition_wait.h"

namespace indurop::rt {

bool wait_for_condition(pthread_cond_t& condition, pthread_mutex_t& mutex) noexcept {
  return ::pthread_cond_wait(&condition, &mutex) == 0;
}

bool wait_for_condition(pthread_cond_t& condition, pthread_mutex_t& mutex, MonoTime deadline) noexcept {
  const timespec until = to_timespec(to_ns(deadline));
  return ::pthread_cond_clockwait(&condition, &mutex, CLOCK_MONOTONIC, &until) == 0;
}

}  // namespace indurop::rt
