// SPDX-License-Identifier: Apache-2.0
#include "control/robot/path/chain.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "group_cell.h"

namespace indurop::robot {
namespace {

const Vec3 kCenter(0.5, 0, 0.4);
constexpr double kRadius = 0.1;

// A circle in chords of 1 mm, from its farthest point on.
Vec3 on_circle(int i) {
  constexpr int kChords = 628;
  const double angle = 2 * kPi * i / kChords;
  return kCenter + kRadius * Vec3(std::cos(angle), std::sin(angle), 0);
}

Chain corner(double zone) {
  Chain chain;
  chain.begin({Vec3(0, 0, 0), Quat::Identity()}, {});
  chain.add({{Vec3(0.2, 0, 0), rotation_by({0, 0, 0.3})}, zone, 1, 0.5, 1});
  chain.add({{Vec3(0.2, 0.2, 0), rotation_by({0, 0, 0.3})}, zone, 1, 0, 2});
  chain.finish();
  return chain;
}

TEST(Chain, Begins_and_ends_where_its_lines_do) {
  const Chain chain = corner(0.05);
  EXPECT_NEAR(chain.length(), 0.4, 1e-12);
  EXPECT_LT(distance(chain.pose_at(0), {Vec3(0, 0, 0), Quat::Identity()}), 1e-12);
  EXPECT_LT(distance(chain.pose_at(chain.length()), chain.end()), 1e-12);
}

TEST(Chain, Leaves_its_lines_in_the_zone_only) {
  const Chain chain = corner(0.05);
  for (int i = 0; i <= 400; ++i) {
    const double place = 0.001 * i;
    const Vec3 p = chain.pose_at(place).position;
    const double off = std::min(std::abs(p.y()), std::abs(p.x() - 0.2));
    EXPECT_LT(off, (p - Vec3(0.2, 0, 0)).norm() < 0.05 ? 0.02 : 1e-12) << place;
  }
  EXPECT_GT((chain.pose_at(0.2).position - Vec3(0.2, 0, 0)).norm(), 0.005);
}

TEST(Chain, Turns_the_tool_from_end_to_end) {
  const Chain chain = corner(0.05);
  EXPECT_NEAR(rotation_between(Quat::Identity(), chain.pose_at(0.1).orientation)[2], 0.15, 1e-12);
  EXPECT_NEAR(rotation_between(Quat::Identity(), chain.pose_at(0.3).orientation)[2], 0.3, 1e-12);
}

TEST(Chain, Knows_what_speed_its_bends_and_lines_allow) {
  const Chain chain = corner(0.02);
  EXPECT_NEAR(chain.limits_at(0.1).velocity, 0.5, 1e-12);
  EXPECT_NEAR(chain.limits_at(0.3).velocity, 1, 1e-12);
  const double bent = chain.limits_at(0.2).velocity;
  const double e = 1e-4;
  const Vec3 bend =
      (chain.pose_at(0.2 + e).position - 2 * chain.pose_at(0.2).position + chain.pose_at(0.2 - e).position) / (e * e);
  EXPECT_NEAR(bent * bent * bend.norm(), 0.6 * ToolLimits{}.acceleration, 0.1);
  EXPECT_EQ(chain.source_at(0.1), 1);
  EXPECT_EQ(chain.source_at(0.3), 2);
}

// 2.1 s at 300 mm/s without any ramps.
TEST(Chain, A_circle_of_short_chords_takes_2_4_seconds) {
  std::string job = fmt::format("POINT START = POSE {} {} {} RPY 180 0 180\n", 1000 * on_circle(0).x(), 0, 400);
  std::string moves;
  for (int i = 1; i <= 628; ++i) {
    const Vec3 p = 1000 * on_circle(i);
    job += fmt::format("POINT C{} = POSE {} {} {} RPY 180 0 180\n", i, p.x(), p.y(), p.z());
    moves += i == 628 ? "ZONE 0\n" : "";
    moves += fmt::format("MOVL C{}\n", i);
  }
  Cell cell(job + "MOVJ START\nWAIT 0.1s\nZONE 5 mm\nSPEED 300 mm/s\n" + moves, 4);
  ASSERT_TRUE(cell.serve(Service::GroupEnable));
  cell.in.service.job = 1;
  cell.ask(Service::JobStart);
  const Arm arm = cell_arm();
  const auto tool = [&] {
    Joints q;
    for (std::size_t i = 0; i < kJoints; ++i) {
      q[static_cast<Eigen::Index>(i)] = radians(cell.out.command[i]);
    }
    return arm.forward(q).position;
  };
  int moving = 0;
  double off = 0;
  for (int i = 0; i < 5000 && cell.out.job.state != JobState::Ended; ++i) {
    const Vec3 before = tool();
    cell.step();
    // The points are declared before the first motion.
    const bool on_it = cell.out.job.line > 640 && (tool() - before).norm() > 0;
    moving += on_it ? 1 : 0;
    off = std::max(off, on_it ? std::abs((tool() - kCenter).norm() - kRadius) : 0);
  }
  EXPECT_EQ(cell.out.job.state, JobState::Ended);
  EXPECT_LT(moving * 0.004, 2.4);
  EXPECT_GT(moving * 0.004, 2.1);
  EXPECT_LT(off, 3e-5);
}

}  // namespace
}  // namespace indurop::robot
