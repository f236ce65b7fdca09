// SPDX-License-Identifier: Apache-2.0
// Variables that others reach although they are inside of a program, and programs that an event starts: outside.st.

#include <indurop/indurop.h>

#include <gtest/gtest.h>
#include <plc_test_outside.glb.h>

#include <chrono>

#include "module.h"

namespace v = plc_test_outside;
using std::chrono_literals::operator""ms;  // NOLINT(misc-unused-using-decls): clang-tidy does not see its use

TEST(PlcOutside, An_access_path_shows_what_is_inside_of_a_program) {
  const indurop::testing::PlcModule sut("plc_test_outside_cyclic");
  v::wanted = 4;
  sut.scan(0ms);
  sut.scan(10ms);
  EXPECT_EQ(v::inner.get(), 11);
  EXPECT_TRUE(v::running.get());
  EXPECT_EQ(v::waited.get(), std::chrono::nanoseconds(10ms).count());
  EXPECT_EQ(v::main_seen.get(), 2);
  EXPECT_EQ(v::second_seen.get(), 2);
}

TEST(PlcOutside, What_is_written_there_goes_in_where_that_is_allowed) {
  const indurop::testing::PlcModule sut("plc_test_outside_cyclic");
  sut.scan();
  v::main_seen = 100;
  v::second_seen = 200;
  v::inner = -5;
  v::lamp = true;
  v::part = 7.5F;
  sut.scan();
  EXPECT_EQ(v::main_seen.get(), 101);
  EXPECT_EQ(v::second_seen.get(), 201);
  EXPECT_EQ(v::inner.get(), 11) << "it is read only";
  EXPECT_TRUE(v::q.get());
  EXPECT_EQ(v::tank.parts[1].get(), 9.5F) << "two programs add 1";
  EXPECT_EQ(v::part.get(), 9.5F);
}

TEST(PlcOutside, A_global_that_others_write_is_not_taken_back_by_its_access_path) {
  const indurop::testing::PlcModule sut("plc_test_outside_cyclic");
  sut.scan();
  v::tank.parts[1] = 50.0F;
  sut.scan();
  EXPECT_EQ(v::tank.parts[1].get(), 52.0F);
  EXPECT_EQ(v::part.get(), 52.0F);
}

TEST(PlcOutside, Inputs_and_outputs_of_a_program_are_connected) {
  const indurop::testing::PlcModule sut("plc_test_outside_cyclic");
  v::wanted = 20;
  v::IW4 = std::uint16_t{3};
  sut.scan();
  EXPECT_EQ(v::sum.get(), 45);
  EXPECT_EQ(v::QW3.get(), 45);
}

TEST(PlcOutside, A_task_with_SINGLE_is_due_when_the_variable_rises) {
  const indurop::testing::PlcModule sut("plc_test_outside_once");
  v::event = false;
  EXPECT_FALSE(sut.due());
  v::event = true;
  EXPECT_TRUE(sut.due());
  EXPECT_FALSE(sut.due());
  v::event = false;
  EXPECT_FALSE(sut.due());
  v::event = true;
  EXPECT_TRUE(sut.due());
  sut.scan();
  EXPECT_EQ(v::events.get(), 1);
}
