// SPDX-License-Identifier: Apache-2.0
#include "dds/steady_waits.h"

#include <dds/ddsrt/sync.h>
#include <dds/ddsrt/time.h>
#include <dlfcn.h>

#include <algorithm>
#include <cstdint>

#include "rt/clock.h"

extern "C" {

// False: nobody signalled in time.
[[gnu::visibility("default")]] bool ddsrt_cond_waitfor(ddsrt_cond_t* cond, ddsrt_mutex_t* mutex,
                                                       dds_duration_t reltime) {
  if (reltime == DDS_INFINITY) {
    return pthread_cond_wait(&cond->cond, &mutex->mutex) == 0;
  }
  const std::int64_t now = indurop::rt::now_ns();
  const timespec until = indurop::rt::to_timespec(now + std::clamp<std::int64_t>(reltime, 0, INT64_MAX - now));
  return pthread_cond_clockwait(&cond->cond, &mutex->mutex, CLOCK_MONOTONIC, &until) == 0;
}

[[gnu::visibility("default")]] bool ddsrt_cond_waituntil(ddsrt_cond_t* cond, ddsrt_mutex_t* mutex, dds_time_t abstime) {
  return ddsrt_cond_waitfor(cond, mutex, abstime == DDS_NEVER ? DDS_INFINITY : abstime - dds_time());
}

}  // extern "C"

namespace indurop::dds {

bool waits_are_steady() noexcept {
  const auto is_ours = [](const char* name, const void* ours) { return ::dlsym(RTLD_DEFAULT, name) == ours; };
  return is_ours("ddsrt_cond_waitfor", reinterpret_cast<const void*>(&ddsrt_cond_waitfor)) &&
         is_ours("ddsrt_cond_waituntil", reinterpret_cast<const void*>(&ddsrt_cond_waituntil));
}

}  // namespace indurop::dds
