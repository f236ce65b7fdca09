// SPDX-License-Identifier: Apache-2.0
// Statements of compiled programs: control.st.

#include <indurop/indurop.h>

#include <gtest/gtest.h>
#include <plc_test_control.glb.h>

#include "module.h"

namespace v = plc_test_control;

TEST(PlcControl, Loops_end_where_they_should) {
  const indurop::testing::PlcModule sut("plc_test_control");
  sut.scan();
  EXPECT_EQ(v::main_sum.get(), 55);
  EXPECT_EQ(v::main_after_loop.get(), 11);
  EXPECT_EQ(v::main_down.get(), 10070401);
  EXPECT_EQ(v::main_after_exit.get(), 42);
  EXPECT_EQ(v::main_all_bytes.get(), 256);
  EXPECT_EQ(v::main_odd.get(), 25);
  EXPECT_EQ(v::main_nested.get(), 9);
  EXPECT_EQ(v::main_moved.get(), 5);
  EXPECT_EQ(v::main_digits.get(), 5);
  EXPECT_EQ(v::main_doubled.get(), 128);
  EXPECT_EQ(v::main_jumped.get(), 5);
}

TEST(PlcControl, Branches_follow_their_conditions) {
  const indurop::testing::PlcModule sut("plc_test_control");
  for (const int input : {-5, 0, 5}) {
    v::main_input = static_cast<std::int16_t>(input);
    sut.scan();
    EXPECT_EQ(v::main_branch.get(), input / 5);
  }
  EXPECT_EQ(v::main_by_color.get(), 2);
}

TEST(PlcControl, Edges_of_inputs_are_seen_once) {
  const indurop::testing::PlcModule sut("plc_test_control");
  for (const bool flank : {false, true, true, false, false, true}) {
    v::main_flank = flank;
    sut.scan();
  }
  EXPECT_EQ(v::main_ups.get(), 2);
  EXPECT_EQ(v::main_total.get(), 2);
  EXPECT_EQ(v::main_downs.get(), 2);  // as F_TRIG, an input that begins with FALSE counts
}
