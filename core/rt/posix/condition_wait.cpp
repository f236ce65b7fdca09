// SPDX-License-Identifier: Apache-2.0
// Conditions support only the wall clock, as semaphores do (signal_word.cpp).
#include "core/rt/condition_wait.h"

namespace indurop::rt {

bool wait_for_condition(pthread_cond_t& condition, pthread_mutex_t& mutex) noexcept {
  return ::pthread_cond_wait(&condition, &mutex) == 0;
}

bool wait_for_condition(pthread_cond_t& condition, pthread_mutex_t& mutex, MonoTime deadline) noexcept {
  const timespec until = to_timespec(wall_ns() + to_ns(deadline) - now_ns());
  return ::pthread_cond_timedwait(&condition, &mutex, &until) == 0;
}

}  // namespace indurop::rt
