// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>
#include <indurop/generated.h>
#include <indurop/indurop.h>

#include <cstring>
#include <type_traits>

#include "hosted.h"

namespace indurop::testing {
namespace {

using namespace knu::Robot;

class SnapshotOf : public ::testing::Test {
 protected:
  TestNode node_;
  Hosted hosted_{node_};
};

TEST_F(SnapshotOf, Several_variables_is_a_copy_of_each) {
  tick = 5;
  joints[3].x = 1.5;
  label = "arm";
  const auto sut = snapshot(tick, joints, label);
  tick = 6;
  joints[3].x = 0;
  EXPECT_TRUE(sut.coherent());
  EXPECT_EQ(sut.get<0>(), 5U);
  EXPECT_EQ(sut.get<1>()[3].x, 1.5);
  EXPECT_EQ(sut.get<2>(), "arm");
}

TEST_F(SnapshotOf, Several_variables_can_be_taken_apart) {
  tick = 7;
  joints[0] = {1, 2, 3};
  const auto sut = snapshot(tick, joints);
  const auto& [now, all] = sut;
  static_assert(std::is_same_v<decltype(now), const std::uint32_t>);
  EXPECT_EQ(now, 7U);
  EXPECT_EQ(all[0].z, 3);
}

TEST_F(SnapshotOf, One_variable_is_its_value) {
  joints[9].y = 4;
  const auto [all] = snapshot(joints);
  EXPECT_EQ(all[9].y, 4);
}

TEST_F(SnapshotOf, A_locked_variable_is_what_was_committed) {
  joints[0].x = 1;
  auto changing = lock(joints);
  changing[0].x = 2;
  const auto sut = snapshot(joints, tick);
  EXPECT_TRUE(sut.coherent());
  EXPECT_EQ(sut.get<0>()[0].x, 1);
}

}  // namespace
}  // namespace indurop::testing
