// SPDX-License-Identifier: Apache-2.0
// Random motions that a condition ends at a random tick, as UNTIL does: the differences between their set points keep
// the limits of all joints before any gate has checked them, and it ends about when it would have at the latest.
// INDUROP_ROBOT_STOPS says how many of each arm, INDUROP_ROBOT_SEED the first one.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <random>

#include "control/robot/path/follower.h"
#include "robot_fixture.h"

namespace indurop::robot {
namespace {

class Condition_stop : public testing::TestWithParam<const char*> {
 protected:
  ArmModel model =
      arm_from_urdf("arm.urdf", std::string(GetParam()) == "cell" ? cell_urdf() : urdf_of(GetParam())).value();
  Arm arm = model.arm;
  Inverse inverse{arm};
  Places places{arm, inverse};
  JointLimits limits{model.velocity, model.velocity / 0.25, model.velocity / 0.025};
  Planner planner{places, limits, ToolLimits{1, 4, 40, kPi, 4 * kPi, 40 * kPi}};
  Follower sut{places, limits};
  std::mt19937 random;
  double period = 0.001;
  std::array<Joints, 4> way;  // the last set points, the latest first

  double in(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random); }

  // Plans a random motion; false if it cannot be planned.
  bool begin(Move move) {
    const Joints from = anywhere(arm, random, 0.1);
    const double far = std::exp(in(std::log(0.02), std::log(1.0)));
    MoveCommand command;
    command.move = move;
    command.target = pose_near(arm, from, far, random);
    command.mid = pose_near(arm, from, far / 2, random);
    if (move == Move::Joint) {
      command.target.is_pose = false;
      command.target.joints = from + (in(0, 1) < 0.5 ? far : 1) * (anywhere(arm, random, 0.1) - from);
      command.straight = in(0, 1) < 0.2;
    }
    command.speed = in(0, 1) < 0.7 ? 1 : in(0.05, 1);
    command.acceleration = in(0, 1) < 0.7 ? 1 : in(0.1, 1);
    Fault fault = planner.begin(command, from);
    while (fault.ok() && !planner.done()) {
      fault = planner.check(1000);
    }
    if (!fault.ok() || planner.segment().length <= 0) {
      return false;
    }
    way.fill(from);
    sut.reset(from);
    sut.set_override(in(0, 1) < 0.6 ? 1 : in(0.3, 1));
    sut.add(planner.segment());
    return true;
  }
  // Empty, or what is broken.
  std::string step(double hardness) {
    if (const Fault fault = sut.step(period); !fault.ok()) {
      return to_string(fault.code);
    }
    way = {sut.joints(), way[0], way[1], way[2]};
    const auto part = [](const Joints& difference, const Joints& limit, double rounding) {
      return (difference.cwiseAbs().array() - rounding).matrix().cwiseQuotient(limit).maxCoeff();
    };
    constexpr double kRounding = 8 * 5e-11;  // of a third difference; lines only show it where joints are fast
    const double v = part((way[0] - way[1]) / period, limits.velocity, 0);
    const double a = part((way[0] - 2 * way[1] + way[2]) / std::pow(period, 2), hardness * limits.acceleration, 0);
    const double j = part((way[0] - 3 * way[1] + 3 * way[2] - way[3]) / std::pow(period, 3),
                          hardness * hardness * limits.jerk, kRounding / std::pow(period, 3));
    const bool good = v <= 1.0001 && a <= 1.0001 && j <= 1.0001;
    return good ? "" : fmt::format("of their limits: speed {:.5f}, acceleration {:.5f}, jerk {:.5f}", v, a, j);
  }
  // The same for the motion of that number; nothing if it cannot be planned.
  std::optional<std::string> run(long seed, Move move) {
    random.seed(static_cast<unsigned>(seed));
    constexpr std::array kPeriods{0.001, 0.002, 0.004};
    period = kPeriods[static_cast<std::size_t>(seed) % kPeriods.size()];
    if (!begin(move)) {
      return std::nullopt;
    }
    const double wanted = sut.to_go() * in(0.02, 0.98);
    const double hardness = in(0, 1) < 0.8 ? 1 : 1.5;
    double time = 0;
    for (; time < wanted && !sut.idle(); time += period) {
      if (const std::string broken = step(1); !broken.empty()) {
        return broken + " before it";
      }
    }
    const double end = time + 1.5 * sut.to_go() + 0.01;
    sut.stop_hard(hardness);
    for (; !sut.idle(); time += period) {
      if (const std::string broken = step(hardness); !broken.empty()) {
        return fmt::format("{} at {:.3f} s, {} ms, hardness {}", broken, time, 1000 * period, hardness);
      }
      if (time > end) {
        return "it takes much longer than the motion";
      }
    }
    for (int i = 0; i < 3; ++i) {
      if (const std::string broken = step(hardness); !broken.empty()) {
        return broken + " at rest";
      }
    }
    return "";
  }
};

TEST_P(Condition_stop, Of_a_joint_motion_keeps_all_limits) {
  const long first = number_of("INDUROP_ROBOT_SEED", 1);
  const long many = number_of("INDUROP_ROBOT_STOPS", 200);
  for (long seed = first; seed < first + many; ++seed) {
    EXPECT_EQ(run(seed, Move::Joint).value_or(""), "") << "seed " << seed;
  }
}

// The last gate ends the few that cannot be stopped as hard as that on their path.
TEST_P(Condition_stop, Of_a_line_or_circle_hardly_ever_breaks_one) {
  const long first = number_of("INDUROP_ROBOT_SEED", 1);
  const long many = number_of("INDUROP_ROBOT_STOPS", 40);
  long beyond = 0;
  for (long seed = first; seed < first + many; ++seed) {
    const std::string broken = run(seed, seed % 2 == 0 ? Move::Line : Move::Circle).value_or("");
    beyond += broken.empty() ? 0 : 1;
    if (!broken.empty()) {
      fmt::print("seed {}: {}\n", seed, broken);
    }
  }
  EXPECT_LE(beyond, many / 500);
}

INSTANTIATE_TEST_SUITE_P(Of_arms, Condition_stop,
                         testing::Values("cell", "gantry", "iiwa14", "palletiser", "scara", "ur5"));

}  // namespace
}  // namespace indurop::robot
