// SPDX-License-Identifier: Apache-2.0
// What a group says about itself.

#include <gtest/gtest.h>

#include <array>

#include "group_cell.h"

namespace indurop::robot {
namespace {

// A supervisor of the tool's speed would trip: nothing moves, the drives have only just reported their positions.
TEST(Group, Has_no_speed_before_the_first_command) {
  Cell cell;
  const auto stands = [](const ToolReport& tool) {
    return tool.velocity == std::array<double, 6>{} && tool.acceleration == std::array<double, 6>{};
  };
  for (int i = 0; i < 3; ++i) {
    EXPECT_TRUE(stands(cell.out.machine) && stands(cell.out.product)) << i;
    EXPECT_EQ(cell.out.tool_speed, 0) << i;
    cell.in.drives[1].position += 10000;
    cell.step();
  }
  const double there = cell.out.command[1];
  ASSERT_TRUE(cell.serve(Service::GroupEnable));
  EXPECT_EQ(cell.out.tool_speed, 0);
  EXPECT_EQ(cell.out.command[1], there);
}

}  // namespace
}  // namespace indurop::robot
