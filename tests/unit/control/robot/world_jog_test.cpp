// SPDX-License-Identifier: Apache-2.0
// Jogging along and about the axes of the world, next to tables that turn the workpiece. Where the tool is in the world
// is computed from the arm without the table.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <random>

#include "limit_judge.h"

namespace indurop::robot {
namespace {

class World_jog : public testing::TestWithParam<const char*> {
 protected:
  [[nodiscard]] Pose in_world(const Cell& cell) const {
    Joints q = Joints::Zero();
    for (int i = 0; i < arm.count(); ++i) {
      q[i] = radians(cell.out.command[static_cast<std::size_t>(i)]);
    }
    return arm.forward(q);
  }
  const Arm arm = arm_of(GetParam()).in_world();
};

TEST_P(World_jog, Goes_along_the_axes_of_the_world_however_the_table_is_turned) {
  std::mt19937 random(3);
  const auto in = [&](double low, double high) { return std::uniform_real_distribution<double>(low, high)(random); };
  const bool tilts = GetParam() == std::string("tilt_table");
  for (int k = 0; k < 24; ++k) {
    const std::string turned =
        tilts ? fmt::format("{} {}", in(-20, 20), in(-300, 300)) : fmt::format("{}", in(-300, 300));
    const std::string job = tilts ? "POINT P = JOINT 20 20 -30 40 50 30 " + turned + "\nMOVJ P\n"
                                  : "POINT P = JOINT -60 -70 90 -110 -80 20 " + turned + "\nMOVJ P\n";
    Cell cell(job, 4, 0, true, {}, urdf_of(GetParam()));
    ASSERT_TRUE(cell.serve(Service::GroupEnable));
    cell.in.service.job = 1;
    ASSERT_TRUE(cell.serve(Service::JobStart)) << cell.out.job.message;
    Judge judge(0.004, urdf_of(GetParam()));
    for (int i = 0; i < 4; ++i) {
      cell.step();
      static_cast<void>(judge.look(cell, 1));
    }
    const Pose from = in_world(cell);
    const auto direction = static_cast<std::size_t>(k % 6);
    const double sign = k % 4 < 2 ? 1 : -1;
    cell.in.jog.enabled = true;
    cell.in.jog.frame = JogFrame::World;
    cell.in.jog.speed[direction] = sign * 40;
    const Vec3 axis = sign * Vec3::Unit(static_cast<Eigen::Index>(direction % 3));
    double away = 0;  // from the line or the axis of rotation
    for (int i = 0; i < 400; ++i) {
      cell.step();
      ASSERT_EQ(judge.look(cell, 1), "") << k;
      const Pose now = in_world(cell);
      const Vec3 moved = now.position - from.position;
      const Vec3 turn = from.orientation * rotation_between(from.orientation, now.orientation);
      away = std::max(away, direction < 3 ? (moved - moved.dot(axis) * axis).norm() + turn.norm()
                                          : (turn - turn.dot(axis) * axis).norm() + moved.norm());
    }
    const Pose now = in_world(cell);
    const Vec3 moved = direction < 3 ? Vec3(now.position - from.position)
                                     : Vec3(from.orientation * rotation_between(from.orientation, now.orientation));
    EXPECT_GT(moved.dot(axis), 0.02) << k;
    EXPECT_LT(away, 1e-8) << k;
  }
}

INSTANTIATE_TEST_SUITE_P(Of_tables, World_jog, testing::Values("turntable", "tilt_table"));

// Without a table, the world is the base.
TEST(World_jog_of_an_arm, Is_the_same_as_along_the_base) {
  std::vector<double> seen;
  for (const JogFrame frame : {JogFrame::Base, JogFrame::World}) {
    Cell cell;
    ASSERT_TRUE(cell.serve(Service::GroupEnable));
    cell.in.service.point = 2;
    ASSERT_TRUE(cell.serve(Service::MoveJoints));
    cell.in.jog.enabled = true;
    cell.in.jog.frame = frame;
    cell.in.jog.speed[1] = 30;
    for (int i = 0; i < 100; ++i) {
      cell.step();
    }
    seen.insert(seen.end(), cell.out.position.begin(), cell.out.position.end());
  }
  EXPECT_TRUE(std::equal(seen.begin(), seen.begin() + 3, seen.begin() + 3));
}

}  // namespace
}  // namespace indurop::robot
