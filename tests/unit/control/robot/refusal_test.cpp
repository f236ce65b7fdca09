// SPDX-License-Identifier: Apache-2.0
// What is refused is refused soon: random motions of random arms, also past singular positions and slow ones, each
// counted in places that were looked at, which are the same on every machine. INDUROP_ROBOT_REFUSALS says how many of
// each arm.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <map>

#include "robot_fixture.h"

namespace indurop::robot {
namespace {

int motions() {
  const char* wanted = std::getenv("INDUROP_ROBOT_REFUSALS");
  return wanted != nullptr ? std::atoi(wanted) : 60;
}

class Refusal : public testing::TestWithParam<const char*> {
 protected:
  double in(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random); }
  double decades(double low, double high) { return std::exp(in(std::log(low), std::log(high))); }
  // One axis is where many arms are singular, or nearly.
  Joints nearly_singular() {
    Joints q = anywhere(arm, random, 0.1);
    const int axis = std::uniform_int_distribution<int>(1, arm.count() - 1)(random);
    const Axis& a = arm.axis(axis);
    q[axis] = std::clamp(decades(1e-9, 0.05), a.lower, a.upper);
    return q;
  }
  // A line whose middle is beside a singular position.
  bool past_singular(MoveCommand& command, Joints& from) {
    const Joints middle = nearly_singular();
    const Pose there = arm.forward(middle);
    const Vec3 along = Vec3(in(-1, 1), in(-1, 1), in(-1, 1)).normalized();
    const double half = decades(0.01, 0.4);
    const auto start = inverse.nearest({there.position - half * along, there.orientation}, middle);
    if (start.reach != Reach::Ok) {
      return false;
    }
    from = start.solution.q;
    command.target.pose = {there.position + half * along, there.orientation};
    return true;
  }
  bool next(int i, MoveCommand& command, Joints& from) {
    from = anywhere(arm, random, 0.05);
    command = {};
    command.move = i % 4 == 3 ? Move::Circle : Move::Line;
    command.target.is_pose = command.mid.is_pose = true;
    Joints to = i % 2 == 0 ? anywhere(arm, random, 0.05) : from;
    Joints mid = from;
    for (int k = 0; k < arm.count() && i % 2 == 1; ++k) {
      to[k] += in(-0.5, 0.5);
      mid[k] += in(-0.3, 0.3);
    }
    command.target.pose = arm.forward(to);
    command.mid.pose = arm.forward(mid);
    command.speed = i % 5 == 0 ? decades(0.01, 1) : 1;
    command.tool_speed = i % 3 == 0 ? decades(1e-5, 1) : 0;
    command.zone = i % 7 == 0 ? 0.01 : 0;
    return i % 4 != 2 || past_singular(command, from);
  }

  std::mt19937 random{11};
  ArmModel model =
      arm_from_urdf("arm.urdf", std::string(GetParam()) == "cell" ? cell_urdf() : urdf_of(GetParam())).value();
  Arm arm = model.arm;
  Inverse inverse{arm};
  Places places{arm, inverse};
  JointLimits limits{model.velocity, model.velocity / 0.25, model.velocity / 0.025};
};

TEST_P(Refusal, Takes_no_more_than_its_work) {
  const auto planner = std::make_unique<Planner>(places, limits, ToolLimits{1, 4, 40, kPi, 4 * kPi, 40 * kPi});
  std::map<ErrorCode, int> seen;
  int most = 0;
  int most_done = 0;
  for (int i = 0; i < motions(); ++i) {
    MoveCommand command;
    Joints from;
    if (!next(i, command, from)) {
      continue;
    }
    Fault fault = planner->begin(command, from);
    while (fault.ok() && !planner->done()) {
      fault = planner->check(64);
    }
    ++seen[fault.code];
    (fault.ok() ? most_done : most) = std::max(fault.ok() ? most_done : most, planner->work());
    if (!fault.ok()) {
      ASSERT_LE(planner->work(), 4 * Planner::kMostWork) << i << ": " << to_string(fault.code);
    }
  }
  fmt::print("{}: refused after {} places at most, planned after {}\n", GetParam(), most, most_done);
  EXPECT_GT(seen[ErrorCode::Ok], motions() / 20);
  EXPECT_GE(seen.size(), 2U);
}

INSTANTIATE_TEST_SUITE_P(Of_all_kinds, Refusal,
                         testing::Values("cell", "ur5", "scara", "offset_wrist", "five_axis", "palletiser", "iiwa14",
                                         "rail"));

}  // namespace
}  // namespace indurop::robot
