// SPDX-License-Identifier: Apache-2.0
// Cyclone waits with our functions, and these do what it expects of its own.

#include "network/dds/steady_waits.h"

#include <dds/ddsrt/sync.h>
#include <gtest/gtest.h>

#include <thread>

#include "core/rt/clock.h"

namespace indurop::dds {
namespace {

TEST(SteadyWaits, Are_those_that_Cyclone_uses) {
  EXPECT_TRUE(waits_are_steady());
}

TEST(SteadyWaits, End_in_time_or_on_a_signal) {
  ddsrt_mutex_t mutex;
  ddsrt_cond_t condition;
  ddsrt_mutex_init(&mutex);
  ddsrt_cond_init(&condition);
  ddsrt_mutex_lock(&mutex);
  constexpr std::int64_t kShort = 2'000'000;
  std::int64_t begin = rt::now_ns();
  while (ddsrt_cond_waitfor(&condition, &mutex, kShort)) {  // woken for nothing
    begin = rt::now_ns();
  }
  EXPECT_GE(rt::now_ns() - begin, kShort);
  EXPECT_FALSE(ddsrt_cond_waitfor(&condition, &mutex, -1));
  EXPECT_FALSE(ddsrt_cond_waituntil(&condition, &mutex, 0));
  for (const dds_duration_t time : {DDS_INFINITY, DDS_SECS(3600)}) {
    bool signalled = false;
    std::thread other([&] {
      ddsrt_mutex_lock(&mutex);
      signalled = true;
      ddsrt_cond_signal(&condition);
      ddsrt_mutex_unlock(&mutex);
    });
    bool in_time = true;
    while (!signalled && in_time) {
      in_time = ddsrt_cond_waituntil(&condition, &mutex, time == DDS_INFINITY ? DDS_NEVER : dds_time() + time);
    }
    EXPECT_TRUE(in_time);
    ddsrt_mutex_unlock(&mutex);
    other.join();
    ddsrt_mutex_lock(&mutex);
  }
  ddsrt_mutex_unlock(&mutex);
  ddsrt_cond_destroy(&condition);
  ddsrt_mutex_destroy(&mutex);
}

}  // namespace
}  // namespace indurop::dds
