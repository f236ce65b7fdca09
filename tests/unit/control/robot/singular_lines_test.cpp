// SPDX-License-Identifier: Apache-2.0
// Lines past singular positions, and lines that are hardly any: what can be done is done. Another walk along each line,
// in a hundred thousand steps, says whether the joints can follow it in one posture, and how long their speeds alone
// take. INDUROP_ROBOT_LINES says how many.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <optional>

#include "control/robot/path/follower.h"
#include "robot_fixture.h"

namespace indurop::robot {
namespace {

class Singular_lines : public testing::Test {
 protected:
  void take(const std::string& urdf) {
    const ArmModel model = arm_from_urdf("arm.urdf", urdf).value();
    arm = model.arm;
    limits.velocity = model.velocity;
    limits.acceleration = limits.velocity / 0.25;
    limits.jerk = limits.acceleration / 0.1;
    inverse = std::make_unique<Inverse>(arm);
    places = std::make_unique<Places>(arm, *inverse);
    planner = std::make_unique<Planner>(*places, limits, tool);
    follower = std::make_unique<Follower>(*places, limits);
  }
  // s, as speeds alone allow; nothing if the joints cannot follow in one posture.
  [[nodiscard]] std::optional<double> by_speeds(const Joints& from, const Pose& to) const {
    constexpr int kSteps = 100000;
    const Pose start = arm.forward(from);
    const Vec3 turn = rotation_between(start.orientation, to.orientation);
    const double least =
        std::max((to.position - start.position).norm() / tool.velocity, turn.norm() / tool.turn_velocity) / kSteps;
    Joints q = from;
    double time = 0;
    for (int i = 1; i <= kSteps; ++i) {
      const double part = static_cast<double>(i) / kSteps;
      const Pose pose{start.position + part * (to.position - start.position),
                      start.orientation * rotation_by(part * turn)};
      const auto found = inverse->nearest(pose, q);
      if (found.reach != Reach::Ok) {
        return std::nullopt;
      }
      const Joints moved = (found.solution.q - q).cwiseAbs();
      if (moved.maxCoeff() > 0.02) {
        return std::nullopt;
      }
      time += std::max(least, moved.cwiseQuotient(limits.velocity).maxCoeff());
      q = found.solution.q;
    }
    return time;
  }
  Fault plan(const Joints& from, const Pose& to, double zone = 0) {
    MoveCommand command;
    command.move = Move::Line;
    command.target.is_pose = true;
    command.target.pose = to;
    command.zone = zone;
    Fault fault = planner->begin(command, from);
    while (fault.ok() && !planner->done()) {
      fault = planner->check(1000);
    }
    return fault;
  }
  // How long it takes; set points keep all limits.
  double follow(const Joints& from, double period) {
    follower->reset(from);
    follower->add(planner->segment());
    Joints q = from;
    Joints v = Joints::Zero();
    Joints a = Joints::Zero();
    double worst = 0;
    int periods = 0;
    for (int still = 0; still < 4 && periods * period < 3600; ++periods) {
      still += follower->idle() ? 1 : 0;
      EXPECT_TRUE(follower->step(period).ok());
      const Joints speed = (follower->joints() - q) / period;
      const Joints acceleration = (speed - v) / period;
      const Joints jerk = (acceleration - a) / period;
      worst = std::max({worst, speed.cwiseQuotient(limits.velocity).cwiseAbs().maxCoeff(),
                        acceleration.cwiseQuotient(limits.acceleration).cwiseAbs().maxCoeff(),
                        jerk.cwiseQuotient(limits.jerk).cwiseAbs().maxCoeff()});
      q = follower->joints();
      v = speed;
      a = acceleration;
    }
    EXPECT_LE(worst, 1.0001);
    return period * periods;
  }

  Arm arm = cell_arm();
  JointLimits limits;
  ToolLimits tool{1, 4, 40, kPi, 4 * kPi, 40 * kPi};
  std::unique_ptr<Inverse> inverse;
  std::unique_ptr<Places> places;
  std::unique_ptr<Planner> planner;
  std::unique_ptr<Follower> follower;
};

int lines() {
  const char* wanted = std::getenv("INDUROP_ROBOT_LINES");
  return wanted != nullptr ? std::atoi(wanted) : 30;
}

// Random lines through places where the wrist is nearly straight, by 0.1 mm to 30 mm.
TEST_F(Singular_lines, Past_a_straight_wrist_are_slow_there_only) {
  for (const std::string& urdf : {cell_urdf(), urdf_of("ur5")}) {
    take(urdf);
    std::mt19937 random(4);
    const auto in = [&](double low, double high) { return std::uniform_real_distribution<double>(low, high)(random); };
    int feasible = 0;
    int planned = 0;
    double worst = 0;
    for (int i = 0; i < lines(); ++i) {
      Joints q = anywhere(arm, random, 0.3);
      q[4] = 0;
      Pose middle = arm.forward(q);
      const Vec3 along = Vec3(in(-1, 1), in(-1, 1), in(-1, 1)).normalized();
      const Vec3 aside = along.unitOrthogonal() * std::exp(in(std::log(1e-4), std::log(0.03)));
      const double half = in(0.05, 0.2);
      const Pose start{middle.position + aside - half * along, middle.orientation};
      const Pose end{middle.position + aside + half * along, middle.orientation};
      const auto from = inverse->nearest(start, q);
      if (from.reach != Reach::Ok) {
        continue;
      }
      const auto least = by_speeds(from.solution.q, end);
      if (!least || *least > 10 * half) {
        continue;
      }
      ++feasible;
      const Fault fault = plan(from.solution.q, end);
      EXPECT_TRUE(fault.ok()) << "line " << i << ", " << 1000 * aside.norm() << " mm aside: " << to_string(fault.code)
                              << " of axis " << fault.axis;
      if (fault.ok()) {
        ++planned;
        const double taken = follow(from.solution.q, i % 2 == 0 ? 0.001 : 0.004);
        worst = std::max(worst, taken / (*least + 0.5));
      }
    }
    fmt::print("{} of {} feasible lines; the slowest takes {:.2f} times what speeds alone and 0.5 s take\n", planned,
               feasible, worst);
    EXPECT_GT(feasible, lines() / 10);
  }
}

TEST_F(Singular_lines, A_blend_that_would_crawl_is_left_out) {
  take(cell_urdf());
  const Quat turn = from_rpy(Vec3(kPi, kPi / 2, kPi));
  const Pose start{Vec3(0.88, -0.15, 0.907945), turn};
  const Pose end{Vec3(0.88, 0.15, 0.907945), turn};
  const Joints from = inverse->nearest(start, joints_of({0, 0, 0, 0, 1, 0})).solution.q;
  ASSERT_TRUE(plan(from, end, 0.02).ok());
  EXPECT_EQ(planner->segment().zone, 0);
  EXPECT_LT(follow(from, 0.004), 4);
}

TEST_F(Singular_lines, Of_any_length_are_done) {
  take(cell_urdf());
  std::mt19937 random(2);
  for (int i = 0; i < 10 * lines(); ++i) {
    const auto in = [&](double low, double high) { return std::uniform_real_distribution<double>(low, high)(random); };
    Joints from = anywhere(arm, random, 0.3);
    while (std::abs(arm.volume(from)) < 0.01) {
      from = anywhere(arm, random, 0.3);
    }
    const Pose start = arm.forward(from);
    const double length = std::exp(in(std::log(1e-10), std::log(1e-3)));
    const Vec3 any(in(-1, 1), in(-1, 1), in(-1, 1));
    Pose end = start;
    end.position += i % 2 == 0 ? Vec3(length * any) : Vec3(Vec3::Zero());
    end.orientation = i % 2 == 0 ? end.orientation : Quat(end.orientation * rotation_by(length * any));
    const Fault fault = plan(from, end);
    ASSERT_TRUE(fault.ok()) << length << ": " << to_string(fault.code) << " of axis " << fault.axis << " from "
                            << from.transpose();
    follow(from, 0.001);
  }
}

// A velocity so small that its square is nothing was none at all.
TEST_F(Singular_lines, At_no_speed_are_refused) {
  take(cell_urdf());
  const Joints from = joints_of({0, -0.3, 0.2, 0, 1, 0});
  MoveCommand command;
  command.move = Move::Line;
  command.target.is_pose = true;
  command.target.pose = arm.forward(joints_of({0.1, -0.3, 0.2, 0, 1, 0}));
  for (const double speed : {1e-303, 1e-160, 1e-12}) {
    command.tool_speed = speed;
    EXPECT_EQ(planner->begin(command, from).code, ErrorCode::Value);
  }
}

}  // namespace
}  // namespace indurop::robot
