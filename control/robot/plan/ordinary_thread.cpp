// SPDX-License-Identifier: Apache-2.0
#include "control/robot/plan/ordinary_thread.h"

#include <sched.h>

#include <algorithm>

namespace indurop::robot {

bool begin_ordinary_thread(pthread_t& thread, const char* name, std::size_t stack, void* (*enter)(void*),
                           void* with) noexcept {
  pthread_attr_t attributes;
  ::pthread_attr_init(&attributes);
  ::pthread_attr_setinheritsched(&attributes, PTHREAD_EXPLICIT_SCHED);
  ::pthread_attr_setschedpolicy(&attributes, SCHED_OTHER);
  ::pthread_attr_setstacksize(&attributes, stack);
  cpu_set_t all;
  std::fill_n(reinterpret_cast<unsigned char*>(&all), sizeof all, static_cast<unsigned char>(0xFF));
  ::pthread_attr_setaffinity_np(&attributes, sizeof all, &all);
  const int code = ::pthread_create(&thread, &attributes, enter, with);
  ::pthread_attr_destroy(&attributes);
  if (code == 0) {
    ::pthread_setname_np(thread, name);
  }
  return code == 0;
}

}  // namespace indurop::robot
