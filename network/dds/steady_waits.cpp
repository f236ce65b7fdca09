// SPDX-License-Identifier: Apache-2.0
#include "network/dds/steady_waits.h"

#include <dds/ddsrt/sync.h>
#include <dds/ddsrt/time.h>
#include <dlfcn.h>

#include <algorithm>
#include <cstdint>

#include "core/rt/clock.h"
#include "core/rt/condition_wait.h"

extern "C" {

// Returns false on a timeout.
[[gnu::visibility("default")]] bool ddsrt_cond_waitfor(ddsrt_cond_t* cond, ddsrt_mutex_t* mutex,
                                                       dds_duration_t reltime) {
  if (reltime == DDS_INFINITY) {
    return indurop::rt::wait_for_condition(cond->cond, mutex->mutex);
  }
  const std::int64_t now = indurop::rt::now_ns();
  const auto until = indurop::rt::mono_time(now + std::clamp<std::int64_t>(reltime, 0, INT64_MAX - now));
  return indurop::rt::wait_for_condition(cond->cond, mutex->mutex, until);
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
