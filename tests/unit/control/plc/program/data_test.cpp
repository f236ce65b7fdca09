// SPDX-License-Identifier: Apache-2.0
// Types and initial values of compiled programs, and how they look as shared variables: data.st.

#include <indurop/indurop.h>

#include <gtest/gtest.h>
#include <plc_test_data.glb.h>

#include "module.h"

namespace v = plc_test_data;

TEST(PlcData, Initial_values_are_those_of_variable_and_type) {
  EXPECT_EQ(v::parts[0].name.get(), "first");
  EXPECT_EQ(v::parts[0].size[1].get(), 2.5F);
  EXPECT_EQ(v::parts[0].mode.get(), v::Slow);
  EXPECT_EQ(v::parts[2].mode.get(), v::Fast);
  EXPECT_EQ(v::parts[3].name.get(), "part");
  EXPECT_EQ(v::parts[3].age.get(), 60'000'000'000);
  EXPECT_EQ(v::level.get(), 20);
  EXPECT_EQ(v::grid[1][2].get(), 5);
  EXPECT_EQ(v::grid[2][0].get(), 0);
  EXPECT_EQ(v::at_word.get(), 0x1234);
}

TEST(PlcData, Structs_arrays_texts_and_times_are_values) {
  const indurop::testing::PlcModule sut("plc_test_data");
  sut.scan();
  EXPECT_EQ(v::parts[3].name.get(), "first");
  EXPECT_EQ(v::parts[3].size[1].get(), 9.0F);
  EXPECT_EQ(v::parts[0].size[1].get(), 2.5F);
  EXPECT_EQ(v::parts[1].name.get(), "too long");
  EXPECT_EQ(v::main_text.get(), "ab'cright");
  EXPECT_EQ(v::main_short.get(), "ab'");
  EXPECT_EQ(v::main_joined.get(), "abc");
  EXPECT_EQ(v::main_length.get(), 8);
  EXPECT_TRUE(v::main_equal.get());
  EXPECT_TRUE(v::main_less.get());
  EXPECT_EQ(v::main_center.get(), 5);
  EXPECT_EQ(v::main_sum.get(), 100 + 2 + 3 + 4 + 5 + 5);
  EXPECT_TRUE(v::main_slow.get());
  EXPECT_EQ(v::main_wait.get(), 119'500'000'000);
  EXPECT_EQ(v::main_later.get() % 86'400'000'000'000, 48'600'000'000'000);
}

TEST(PlcData, Located_variables_are_one_per_address) {
  const indurop::testing::PlcModule sut("plc_test_data");
  v::at_word = 77;
  sut.scan();
  EXPECT_EQ(v::main_direct.get(), 77);
  EXPECT_TRUE(v::MX1_5.get());
}

TEST(PlcData, Scans_go_on_with_what_others_wrote) {
  const indurop::testing::PlcModule sut("plc_test_data");
  v::kept = 10;
  sut.scan();
  EXPECT_EQ(v::kept.get(), 11);
}
