// SPDX-License-Identifier: Apache-2.0
// Function blocks of the library in compiled programs: timing.st.

#include <indurop/indurop.h>

#include <gtest/gtest.h>
#include <plc_test_timing.glb.h>

#include "module.h"

namespace v = plc_test_timing;
using std::chrono_literals::operator""ms;

TEST(PlcTiming, Timers_are_exact_to_the_scan) {
  const indurop::testing::PlcModule sut("plc_test_timing");
  v::button = true;
  for (auto at = 10ms; at < 40ms; at += 10ms) {
    sut.scan(at);
    EXPECT_FALSE(v::lamp.get());
    EXPECT_EQ(v::elapsed.get(), (at - 10ms).count() * 1'000'000);
  }
  sut.scan(40ms);
  EXPECT_TRUE(v::lamp.get());
  EXPECT_EQ(v::elapsed.get(), 30'000'000);
  v::button = false;
  sut.scan(50ms);
  EXPECT_FALSE(v::lamp.get());
}

TEST(PlcTiming, Counters_count_edges) {
  const indurop::testing::PlcModule sut("plc_test_timing");
  for (int i = 0; i < 3; ++i) {
    EXPECT_EQ(v::full.get(), i >= 2);
    v::button = true;
    sut.scan();
    sut.scan();
    v::button = false;
    sut.scan();
    EXPECT_EQ(v::count.get(), i + 1);
  }
}
