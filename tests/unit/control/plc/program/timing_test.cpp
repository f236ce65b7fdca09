// SPDX-License-Identifier: Apache-2.0
// Function blocks of the library in compiled programs: timing.st.

#include <indurop/indurop.h>

#include <gtest/gtest.h>
#include <plc_test_timing.glb.h>

#include "module.h"

namespace v = plc_test_timing;
using std::chrono_literals::operator""ms;  // NOLINT(misc-unused-using-decls): clang-tidy does not see its use

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

TEST(PlcTiming, Programs_read_the_time_of_the_schedule) {
  const indurop::testing::PlcModule sut("plc_test_timing");
  sut.scan(1'500ms);
  EXPECT_EQ(v::now.get(), 1'500'000'000);
  EXPECT_EQ(v::now_ms.get(), 1'500U);
  EXPECT_EQ(v::now_us.get(), 1'500'000U);
  sut.scan(std::chrono::hours(24 * 100) + 7ms);
  EXPECT_EQ(v::now.get(), 8'640'000'007'000'000);
  EXPECT_EQ(v::now_ms.get(), static_cast<std::uint32_t>(8'640'000'007));
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
