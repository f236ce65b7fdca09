// SPDX-License-Identifier: Apache-2.0
// What is refused is refused soon: random motions of many arms, also past singular positions and slow ones, each
// counted in places that were checked, which are the same on every machine. What is planned keeps the limits of the
// joints, by another walk along it. INDUROP_ROBOT_REFUSALS says how many of each arm, INDUROP_ROBOT_SEED the first one.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <optional>

#include "control/robot/path/profile.h"
#include "drive_faults.h"
#include "heavy_arm.h"
#include "robot_fixture.h"

namespace indurop::robot {
namespace {

std::string urdf_called(const std::string& name) {
  const std::map<std::string, ArmSpec (*)()> specs{
      {"irb4600", irb4600_spec}, {"scara_spec", scara_spec}, {"xarm6", xarm6_spec}, {"panda", panda_spec}};
  const auto found = specs.find(name);
  return name == "cell" ? cell_urdf() : found != specs.end() ? found->second().urdf() : urdf_of(name);
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
  // A line whose middle is near a singular position.
  bool past_singular(MoveCommand& command, Joints& from) {
    const Joints middle = nearly_singular();
    const Pose there = arm.forward(middle);
    Vec3 along;
    for (const int axis : {2, 1, 0}) {  // as arguments, their order would depend on the compiler
      along[axis] = in(-1, 1);
    }
    along.normalize();
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

  Fault plan(const MoveCommand& command, const Joints& from) {
    Fault fault = planner->begin(command, from);
    while (fault.ok() && !planner->done()) {
      fault = planner->check(64);
    }
    return fault;
  }
  // Plans the random motion of this number; nothing if it has none.
  std::optional<Fault> plan_random(long seed) {
    random.seed(static_cast<unsigned>(seed * 7919 + 13));
    MoveCommand command;
    Joints from;
    return next(static_cast<int>(seed % 420), command, from) ? std::optional(plan(command, from)) : std::nullopt;
  }
  // The place of the planned motion on its path at this time.
  [[nodiscard]] double place_at(double time) const {
    const Segment& s = planner->segment();
    return s.timing.known() ? s.timing.at(time).place
                            : Profile::to_position({}, s.length, 0, s.limits).at(time).position;
  }
  // The greatest part of the joints' limits that it uses, by differences of four instants in many stretches.
  double used() {
    constexpr double kInstant = 0.001;
    constexpr int kStretches = 400;
    const Segment& s = planner->segment();
    const double duration = s.duration();
    double most = 0;
    Joints q = s.from;
    for (int i = 0; i < kStretches; ++i) {
      const double time = std::max(0.0, (duration - 4 * kInstant) * (i + in(0, 1)) / kStretches);
      std::array<Joints, 4> seen;
      for (std::size_t k = 0; k < seen.size(); ++k) {
        if (places.on(s, place_at(std::min(duration, time + kInstant * static_cast<double>(k))), q, q) != Reach::Ok) {
          return HUGE_VAL;
        }
        seen[k] = q;
      }
      const Joints first = (seen[1] - seen[0]).cwiseAbs() / kInstant;
      const Joints second = (seen[2] - 2 * seen[1] + seen[0]).cwiseAbs() / std::pow(kInstant, 2);
      const Joints third = (seen[3] - 3 * seen[2] + 3 * seen[1] - seen[0]).cwiseAbs() / std::pow(kInstant, 3);
      const double rounding = 8 * 5e-11 / std::pow(kInstant, 3);
      for (int k = 0; k < arm.count(); ++k) {
        most = std::max({most, first[k] / limits.velocity[k], second[k] / limits.acceleration[k],
                         (third[k] - rounding) / limits.jerk[k]});
      }
    }
    return most;
  }

  std::mt19937 random;
  ArmModel model = arm_from_urdf("arm.urdf", urdf_called(GetParam())).value();
  Arm arm = model.arm;
  Inverse inverse{arm};
  Places places{arm, inverse};
  JointLimits limits{model.velocity, model.velocity / 0.25, model.velocity / 0.025};
  std::unique_ptr<Planner> planner =
      std::make_unique<Planner>(places, limits, ToolLimits{1, 4, 40, kPi, 4 * kPi, 40 * kPi});
};

TEST_P(Refusal, Takes_no_more_than_its_work) {
  const long motions = number_of("INDUROP_ROBOT_REFUSALS", 60);
  const long first = number_of("INDUROP_ROBOT_SEED", 1);
  std::map<ErrorCode, long> seen;
  int most = 0;
  int most_done = 0;
  for (long i = first; i < first + motions; ++i) {
    SCOPED_TRACE(fmt::format("INDUROP_ROBOT_SEED={}", i));
    const std::optional<Fault> fault = plan_random(i);
    if (!fault) {
      continue;
    }
    ++seen[fault->code];
    if (fault->ok()) {
      most_done = std::max(most_done, planner->work());
      ASSERT_LE(used(), 1.001);
    } else {
      most = std::max(most, planner->work());
      ASSERT_LE(planner->work(), PlanningWork::kMaxRefusalWork) << to_string(fault->code);
    }
  }
  fmt::print("{}: {} planned, refused after {} places at most, planned after {}\n", GetParam(), seen[ErrorCode::Ok],
             most, most_done);
  EXPECT_GT(seen[ErrorCode::Ok], motions / 20);
  EXPECT_GE(seen.size(), 2U);
}

INSTANTIATE_TEST_SUITE_P(Of_all_kinds, Refusal,
                         testing::Values("cell", "ur5", "scara", "offset_wrist", "five_axis", "palletiser", "iiwa14",
                                         "rail", "tilt_table", "irb4600", "scara_spec", "xarm6", "panda"));

class RefusalOfHeldAxes : public Refusal {
 protected:
  // A line of 50 s through the middle, if it can be reached.
  std::optional<Fault> plan_slow_line(const Joints& middle) {
    const Pose there = arm.forward(middle);
    const Vec3 half = in(0.02, 0.06) * Vec3(in(-1, 1), in(-1, 1), in(-1, 1)).normalized();
    const auto start = inverse.nearest({there.position - half, there.orientation}, middle);
    MoveCommand command;
    command.move = Move::Line;
    command.target.is_pose = true;
    command.target.pose = {there.position + half, there.orientation};
    command.tool_speed = half.norm() / 25;
    return start.reach == Reach::Ok ? std::optional(plan(command, start.solution.q)) : std::nullopt;
  }
  // The same as used(), of jerks alone, at all instants around the one in the middle.
  double used_in_middle() {
    constexpr double kInstant = 0.001;
    constexpr int kAround = 20;
    constexpr int kPlaces = 2000;  // on the way there
    const Segment& s = planner->segment();
    double time = 0;
    for (double width = s.duration() / 2; width > 1e-9; width /= 2) {
      time += place_at(time + width) <= s.length / 2 ? width : 0;
    }
    std::array<Joints, 2 * kAround + 1> seen;
    Joints q = s.from;
    const double first = place_at(time - kAround * kInstant);
    for (int i = 1; i < kPlaces; ++i) {
      places.on(s, first * i / kPlaces, q, q);
    }
    for (std::size_t i = 0; i < seen.size(); ++i) {
      const double place = place_at(time + (static_cast<int>(i) - kAround) * kInstant);
      if (places.on(s, place, q, q) != Reach::Ok) {
        return HUGE_VAL;
      }
      seen[i] = q;
    }
    double most = 0;
    for (std::size_t i = 3; i < seen.size(); ++i) {
      const Joints third = seen[i] - 3 * seen[i - 1] + 3 * seen[i - 2] - seen[i - 3];
      const double rounding = 8 * 5e-11;
      for (int k = 0; k < arm.count(); ++k) {
        most = std::max(most, (std::abs(third[k]) - rounding) / std::pow(kInstant, 3) / limits.jerk[k]);
      }
    }
    return most;
  }
};

// A table, a rail or an elbow could keep the tool on its line where the wrist is straight, but its place is given: that
// the position is singular was overlooked, and a long motion was not rehearsed there.
TEST_P(RefusalOfHeldAxes, Comes_where_the_others_are_singular) {
  const int wrist = arm.count() - arm.world_joint() - 2;
  int planned = 0;
  int singular = 0;
  random.seed(5);
  for (int i = 0; i < 60; ++i) {
    Joints middle = anywhere(arm, random, 0.3);
    middle[wrist] = i % 3 == 0 ? decades(1e-3, 0.5) : decades(1e-9, 1e-6);
    const std::optional<Fault> fault = plan_slow_line(middle);
    singular += fault && fault->code == ErrorCode::Singular ? 1 : 0;
    if (fault && fault->ok()) {
      ++planned;
      EXPECT_LE(used_in_middle(), 1.001) << "line " << i << ", " << middle[wrist] << " rad";
    }
  }
  EXPECT_GE(singular, 3);
  EXPECT_GE(planned, 3);
  fmt::print("{}: {} planned, {} past a singular position\n", GetParam(), planned, singular);
}

INSTANTIATE_TEST_SUITE_P(On_slow_lines, RefusalOfHeldAxes,
                         testing::Values("tilt_table", "turntable", "iiwa14", "rail", "cell"));

class RefusalOfRedundantArms : public Refusal {};

// Random motions of iiwa14, rail and panda, in this order, for the same reason: the first one was planned although its
// path cannot be followed to its end, the others took too much work to be rejected.
TEST_P(RefusalOfRedundantArms, Comes_where_the_others_are_singular) {
  for (const long seed : {1201L, 1326L, 1425L}) {
    const std::optional<Fault> fault = plan_random(seed);
    if (!fault) {
      continue;
    }
    SCOPED_TRACE(seed);
    if (fault->ok()) {
      EXPECT_LE(used(), 1.001);
    } else {
      EXPECT_LE(planner->work(), PlanningWork::kMaxRefusalWork) << to_string(fault->code);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(On_random_motions, RefusalOfRedundantArms, testing::Values("iiwa14", "rail", "panda"));

class RefusalOfTables : public Refusal {};

// The random line that showed it: axis 5 is at 6e-8 rad in its middle, and axes 4 and 6 stepped by 4 mrad.
TEST_P(RefusalOfTables, Is_that_of_a_singular_position) {
  const std::optional<Fault> fault = plan_random(330);
  ASSERT_TRUE(fault);
  EXPECT_EQ(fault->code, ErrorCode::Singular) << to_string(fault->code);
  EXPECT_LT(planner->work(), 1000);
}

INSTANTIATE_TEST_SUITE_P(Next_to_the_straight_wrist, RefusalOfTables, testing::Values("tilt_table"));

class RefusalOfStretchedArms : public Refusal {};

// Where an arm without inverse kinematics in closed form is stretched, it stays as it is while the pose is near enough,
// and then its joints step: slower motions do so, too, and were rehearsed slower and slower.
TEST_P(RefusalOfStretchedArms, Comes_before_they_are_rehearsed_again) {
  for (const double far : {0.05, 0.2, 0.5}) {
    const Joints from = Joints::Zero();
    MoveCommand command;
    command.move = Move::Line;
    command.target.is_pose = true;
    command.target.pose = arm.forward(from);
    command.target.pose.position += far * Vec3(-0.6, 0.4, arm.count() < 6 ? 0 : -0.5);
    const Fault fault = plan(command, from);
    EXPECT_EQ(fault.code, ErrorCode::Singular) << far << ": " << to_string(fault.code);
    EXPECT_LE(planner->work(), PlanningWork::kMaxRefusalWork) << far;
  }
}

INSTANTIATE_TEST_SUITE_P(From_rest, RefusalOfStretchedArms, testing::Values("scara", "iiwa14"));

class RefusalOfFiveAxes : public Refusal {};

// An arm of five axes comes as close to the orientation as it can, from place to place by iteration. What that leaves
// to rounding shows as jerk, and a path that ends between two places as one that is followed.
TEST_P(RefusalOfFiveAxes, Keeps_limits_where_the_orientation_is_not_reached) {
  for (const long seed : {61L, 395L, 1188L, 1404L}) {
    SCOPED_TRACE(seed);
    const std::optional<Fault> fault = plan_random(seed);
    ASSERT_TRUE(fault);
    EXPECT_EQ(fault->ok(), seed == 61) << to_string(fault->code);
    EXPECT_TRUE(!fault->ok() || used() <= 1.001);
  }
}

INSTANTIATE_TEST_SUITE_P(With_another_orientation, RefusalOfFiveAxes, testing::Values("five_axis"));

class RefusalOfHeavyLinks : public Refusal {
 protected:
  // What the axes need to rest somewhere on the planned motion.
  Joints resting(const Dynamics& dynamics) const {
    constexpr int kPlaces = 300;
    const Segment& s = planner->segment();
    Joints q = s.from;
    Joints most = Joints::Zero();
    for (int i = 0; i <= kPlaces; ++i) {
      places.on(s, s.length * i / kPlaces, q, q);
      most = most.cwiseMax(dynamics.torques(q, Joints::Zero(), Joints::Zero()).cwiseAbs());
    }
    return most;
  }
};

// Where an axis can hardly hold the arm, the check of torques finds a motion too slow after all of its rehearsal.
TEST_P(RefusalOfHeavyLinks, Takes_no_more_than_its_work) {
  const Joints strong = joints_of({250, 250, 130, 26, 22, 12});
  const Dynamics dynamics = arm_from_urdf("arm.urdf", heavy_cell_arm(strong).urdf)->dynamics;
  int refused = 0;
  for (const long seed : {20L, 81L, 198L, 235L, 261L, 265L}) {
    SCOPED_TRACE(seed);
    ASSERT_TRUE(plan_random(seed)->ok());
    const auto axis = static_cast<Eigen::Index>(seed % 3 + 1);
    Joints effort = strong;
    effort[axis] = resting(dynamics)[axis] / 0.99 * (1 + decades(1e-7, 1e-2));
    const ArmModel heavy = arm_from_urdf("arm.urdf", heavy_cell_arm(effort).urdf).value();
    places.weigh(&heavy.dynamics);
    const Fault fault = *plan_random(seed);
    places.weigh(nullptr);
    EXPECT_TRUE(fault.ok() || planner->work() <= PlanningWork::kMaxRefusalWork)
        << to_string(fault.code) << planner->work();
    refused += fault.ok() ? 0 : 1;
  }
  EXPECT_GE(refused, 1);
}

INSTANTIATE_TEST_SUITE_P(Of_the_cell, RefusalOfHeavyLinks, testing::Values("cell"));

class RefusalOfIrb4600 : public Refusal {};

// Between two places that are checked, an axis leaves its range for some micrometres of the path and comes back: it was
// taken for a motion past a singular position, and rehearsed.
TEST_P(RefusalOfIrb4600, Names_the_axis_that_is_beyond_its_range_for_a_moment) {
  Joints from = Joints::Zero();
  from.head<6>() << -0.137313, -1.236966, -1.506456, 0.490594, -0.247233, 3.385445;
  MoveCommand command;
  command.move = Move::Line;
  command.target.is_pose = true;
  command.target.pose = {{-1.112930, 0.679907, 1.849689},
                         Quat(-0.0321134, -0.2644566, 0.1922229, 0.9445008).normalized()};
  const Fault fault = plan(command, from);
  EXPECT_EQ(fault.code, ErrorCode::JointLimit) << to_string(fault.code);
  EXPECT_EQ(fault.axis, 4);
  EXPECT_LT(planner->work(), 1000);
}

INSTANTIATE_TEST_SUITE_P(Near_its_limit, RefusalOfIrb4600, testing::Values("irb4600"));

}  // namespace
}  // namespace indurop::robot
