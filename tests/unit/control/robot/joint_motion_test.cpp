// SPDX-License-Identifier: Apache-2.0
// Joint motions whose axes arrive together, from rest and from anything: how long they take against two yardsticks, and
// whether all set points keep the limits, whatever comes in between. INDUROP_ROBOT_MOVES says how many.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <random>
#include <vector>

#include "control/robot/axis/set_point_gate.h"
#include "control/robot/path/follower.h"
#include "rest_reference.h"
#include "robot_fixture.h"

namespace indurop::robot {
namespace {

int moves_wanted(int otherwise) {
  const char* text = std::getenv("INDUROP_ROBOT_MOVES");
  return text == nullptr ? otherwise : std::atoi(text);
}

struct Ratios {
  std::vector<double> all;
  void print(const char* what) const {
    double sum = 0;
    for (const double ratio : all) {
      sum += ratio;
    }
    fmt::print("{} {}: mean {:.5f}, least {:.5f}, most {:.5f} of the least time\n", all.size(), what,
               sum / static_cast<double>(all.size()), *std::min_element(all.begin(), all.end()),
               *std::max_element(all.begin(), all.end()));
  }
};

class Joint_motion : public testing::Test {
 protected:
  Arm arm = cell_arm();
  Inverse inverse{arm};
  Places places{arm, inverse};
  JointLimits limits = cell_limits();
  std::mt19937 random{17};
  double period = 0.001;

  double in(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random); }
  // Other limits of each axis.
  void any_limits() {
    limits = cell_limits();
    for (int i = 0; i < kAxes; ++i) {
      limits.velocity[i] *= in(0.3, 1);
      limits.acceleration[i] *= in(0.3, 1);
      limits.jerk[i] *= in(0.2, 1);
    }
  }
  MoveCommand to(const Joints& q) {
    MoveCommand command;
    command.target.joints = q;
    return command;
  }
  Joints near(const Joints& q, double far) {
    Joints target = q;
    for (int i = 0; i < arm.count(); ++i) {
      const Axis& axis = arm.axis(i);
      target[i] = std::clamp(q[i] + in(-far, far), axis.lower, axis.upper);
    }
    return target;
  }
  [[nodiscard]] RestTask task(const JointState& from, const Joints& target, int axis) const {
    return {target[axis] - from.position[axis], from.velocity[axis], from.acceleration[axis], limits.velocity[axis],
            limits.acceleration[axis],          limits.jerk[axis]};
  }

  // Steps with gates as they stand before the drives.
  struct Robot {
    Robot(const Joint_motion& test, const Joints& from)
        : planner(test.places, test.limits, ToolLimits{1, 4, 40, kPi, 4 * kPi, 40 * kPi}),
          sut(test.places, test.limits),
          period(test.period) {
      sut.reset(from);
      for (int i = 0; i < kAxes; ++i) {
        const Axis& axis = test.arm.axis(i);
        gates[static_cast<std::size_t>(i)] =
            SetPointGate({axis.lowest(), axis.highest()},
                         {test.limits.velocity[i], test.limits.acceleration[i], test.limits.jerk[i]}, test.period);
        gates[static_cast<std::size_t>(i)].stand(from[i]);
      }
    }
    Fault plan(const MoveCommand& command) {
      Fault fault = planner.begin(command, sut.end());
      while (fault.ok() && !planner.done()) {
        fault = planner.check(1000);
      }
      return fault;
    }
    bool add(const MoveCommand& command) {
      const bool planned = plan(command).ok();
      if (planned) {
        sut.add(planner.segment(), sut.idle() ? Blend{} : planner.blend(before, planner.segment()));
        before = planner.segment();
      }
      return planned;
    }
    bool redirect(const Joints& target) {
      MoveCommand command;
      command.target.joints = target;
      return plan(command).ok() && sut.redirect(planner.segment()).ok();
    }
    // False if a gate refuses.
    bool step(double hardness = 1) {
      bool kept = sut.step(period).ok();
      for (int i = 0; i < kAxes; ++i) {
        SetPointGate& gate = gates[static_cast<std::size_t>(i)];
        if (const ErrorCode code = gate.check(sut.joints()[i], hardness); code != ErrorCode::Ok) {
          refused = fmt::format("axis {}: {}", i + 1, to_string(code));
          kept = false;
        }
        gate.pass(sut.joints()[i], hardness);
      }
      time += period;
      return kept;
    }
    // Until all axes rest if each of them brakes on its own, whatever the path.
    [[nodiscard]] double braking_alone(double hardness) const {
      std::array<SetPointGate, kAxes> alone = gates;
      int periods = 0;
      const auto rests = [](const SetPointGate& gate) { return gate.at_rest(); };
      for (; !std::all_of(alone.begin(), alone.end(), rests); ++periods) {
        for (SetPointGate& gate : alone) {
          gate.brake(hardness);
        }
      }
      return periods * period;
    }
    Planner planner;
    Follower sut;
    Segment before;
    std::array<SetPointGate, kAxes> gates;
    double period;
    double time = 0;
    std::string refused;
  };
};

TEST_F(Joint_motion, The_yardsticks_agree) {
  for (int i = 0; i < 50; ++i) {
    const RestTask task{in(-3, 3), 0, 0, in(0.5, 3), in(2, 20), in(20, 300)};
    const double least = least_time_from_rest(task);
    EXPECT_NEAR(least_time_to_rest(task, 1000), least, 0.003 * least);
  }
}

TEST_F(Joint_motion, From_rest_takes_as_long_as_the_slowest_axis) {
  Ratios ratios;
  for (int i = 0; i < moves_wanted(1000); ++i) {
    any_limits();
    const JointState from{anywhere(arm, random), Joints::Zero(), Joints::Zero()};
    const Joints target = near(from.position, i % 2 == 0 ? 3 : 0.2);
    JointTiming sut;
    sut.plan(from, target, limits);
    double least = 0;
    for (int axis = 0; axis < arm.count(); ++axis) {
      least = std::max(least, least_time_from_rest(task(from, target, axis)));
    }
    ratios.all.push_back(sut.duration() / least);
    EXPECT_NEAR(ratios.all.back(), 1, 1e-6);
    // Together: just before the end every axis that has a way to go still moves.
    const JointState late = sut.at(sut.duration() * (1 - 1e-3));
    for (int axis = 0; axis < arm.count(); ++axis) {
      EXPECT_NE(late.velocity[axis], 0) << i << " " << axis;
    }
    EXPECT_EQ(sut.at(sut.duration()).position, target);
  }
  ratios.print("joint motions from rest");
}

TEST_F(Joint_motion, A_new_target_in_mid_move_takes_as_long_as_the_slowest_axis) {
  Ratios ratios;
  int early = 0;
  const int wanted = moves_wanted(60);
  for (int i = 0; i < wanted; ++i) {
    any_limits();
    JointTiming first;
    const Joints start = anywhere(arm, random, 0.1);
    first.plan({start, Joints::Zero(), Joints::Zero()}, near(start, 3), limits);
    const JointState now = first.at(in(0, 1) * first.duration());
    const Joints target = near(now.position, i % 2 == 0 ? 3 : 0.3);
    JointTiming sut;
    sut.plan(now, target, limits);
    double least = 0;
    for (int axis = 0; axis < arm.count(); ++axis) {
      least = std::max(least, least_time_to_rest(task(now, target, axis), 1000));
    }
    ratios.all.push_back(sut.duration() / least);
    EXPECT_LT(ratios.all.back(), 1.001) << i;
    EXPECT_GT(ratios.all.back(), 0.99) << i;
    // All of them are there at the end, and none comes to it with a jump.
    const JointState late = sut.at(sut.duration() * (1 - 1e-6));
    EXPECT_LT((late.position - target).cwiseAbs().maxCoeff(), 1e-9);
    early += (sut.at(sut.duration() * (1 - 1e-3)).velocity.head(arm.count()).array() == 0).any() ? 1 : 0;
  }
  ratios.print("new targets in mid-move");
  fmt::print("{} of {} with an axis that arrives before the others\n", early, wanted);
}

TEST_F(Joint_motion, New_targets_at_any_instant_keep_all_limits) {
  int redirected = 0;
  for (int i = 0; i < moves_wanted(150); ++i) {
    period = i % 3 == 0 ? 0.001 : i % 3 == 1 ? 0.004 : 0.01;
    any_limits();
    Robot robot(*this, anywhere(arm, random, 0.1));
    ASSERT_TRUE(robot.add(to(near(robot.sut.joints(), 3))));
    Joints target = robot.sut.end();
    for (int k = 0; k < 5; ++k) {
      const int periods = static_cast<int>(in(0, 1) / period);
      for (int n = 0; n < periods; ++n) {
        ASSERT_TRUE(robot.step()) << i << " " << robot.refused;
      }
      const Joints next = near(robot.sut.joints(), k % 2 == 0 ? 2 : 0.3);
      if (robot.redirect(next)) {
        target = next;
        ++redirected;
      }
    }
    for (int n = 0; n < 100000 && !robot.sut.idle(); ++n) {
      ASSERT_TRUE(robot.step()) << i << " " << robot.refused;
    }
    ASSERT_EQ(robot.sut.joints(), target) << i;
  }
  fmt::print("{} new targets\n", redirected);
}

TEST_F(Joint_motion, New_targets_on_lines_keep_all_limits) {
  int redirected = 0;
  int refused = 0;
  for (int i = 0; redirected < moves_wanted(60) && i < 2000; ++i) {
    period = i % 3 == 0 ? 0.001 : i % 3 == 1 ? 0.004 : 0.01;
    Robot robot(*this, anywhere(arm, random, 0.6));
    bool moves = true;
    for (int k = 0; k < 2; ++k) {
      MoveCommand line;
      line.move = Move::Line;
      line.zone = i % 2 == 0 ? 0.05 : 0;
      line.target.is_pose = true;
      line.target.pose = arm.forward(near(robot.sut.end(), 0.4));
      moves = moves && robot.add(line);
    }
    if (!moves) {
      continue;
    }
    const double until = in(0, 1.5) * robot.sut.to_go();
    bool kept = true;
    while (kept && robot.time < until && !robot.sut.idle()) {
      kept = robot.step();
    }
    if (!kept) {
      continue;  // of a line itself
    }
    const Joints target = near(robot.sut.joints(), 1);
    if (!robot.redirect(target)) {
      continue;
    }
    ++redirected;
    for (int n = 0; n < 100000 && kept && !robot.sut.idle(); ++n) {
      kept = robot.step();
    }
    EXPECT_TRUE(kept) << i << " " << robot.refused;
    refused += kept ? 0 : 1;
  }
  fmt::print("{} new targets on lines, {} refused by a gate\n", redirected, refused);
}

// Overrides, holds, stops and new targets, one after the other.
TEST_F(Joint_motion, Whatever_comes_in_between_keeps_all_limits) {
  int refused = 0;
  const int wanted = moves_wanted(300);
  for (int i = 0; i < wanted; ++i) {
    period = i % 3 == 0 ? 0.001 : i % 3 == 1 ? 0.004 : 0.01;
    any_limits();
    Robot robot(*this, anywhere(arm, random, 0.1));
    ASSERT_TRUE(robot.add(to(near(robot.sut.joints(), 3))));
    bool kept = true;
    for (int k = 0; k < 12 && kept; ++k) {
      const int periods = static_cast<int>(in(0, 0.3) / period);
      for (int n = 0; n < periods && kept; ++n) {
        kept = robot.step();
      }
      const double kind = in(0, 1);
      if (kind < 0.5) {
        robot.sut.set_override(in(0, 1) < 0.4 ? 1 : in(0, 1));
      } else if (kind < 0.8) {
        robot.sut.set_hold(in(0, 1) < 0.5);
      } else if (kind < 0.9) {
        robot.redirect(near(robot.sut.joints(), 1));
      } else if (kind < 0.92) {
        robot.sut.stop();
      }
    }
    robot.sut.set_hold(false);
    robot.sut.set_override(1);
    for (int n = 0; n < 100000 && kept && !robot.sut.idle(); ++n) {
      kept = robot.step();
    }
    refused += kept ? 0 : 1;
    EXPECT_TRUE(kept) << i << " " << robot.refused;
  }
  fmt::print("{} disturbed joint motions, {} refused by a gate\n", wanted, refused);
}

TEST_F(Joint_motion, A_hold_is_as_short_as_braking) {
  std::vector<double> times;
  for (int i = 0; i < moves_wanted(100); ++i) {
    Robot robot(*this, anywhere(arm, random, 0.1));
    ASSERT_TRUE(robot.add(to(near(robot.sut.joints(), 3))));
    const double until = in(0.1, 0.9) * robot.sut.to_go();
    while (robot.time < until) {
      ASSERT_TRUE(robot.step());
    }
    robot.sut.set_hold(true);
    const double begin = robot.time;
    Joints last = robot.sut.joints();
    do {
      last = robot.sut.joints();
      ASSERT_TRUE(robot.step()) << i << robot.refused;
    } while (robot.sut.joints() != last);
    times.push_back(robot.time - begin);
  }
  std::sort(times.begin(), times.end());
  fmt::print("holds: median {:.3f} s, most {:.3f} s\n", times[times.size() / 2], times.back());
  EXPECT_LT(times.back(), 0.8);
}

TEST_F(Joint_motion, An_emergency_stop_keeps_its_limits) {
  int refused = 0;
  double sum = 0;
  double sum_alone = 0;
  const int wanted = moves_wanted(300);
  for (int i = 0; i < wanted; ++i) {
    period = i % 3 == 0 ? 0.001 : i % 3 == 1 ? 0.004 : 0.01;
    Robot robot(*this, anywhere(arm, random, 0.1));
    ASSERT_TRUE(robot.add(to(near(robot.sut.joints(), 3))));
    const double until = in(0.05, 0.95) * robot.sut.to_go();
    if (i % 2 == 0) {
      robot.sut.set_override(in(0.1, 1));
    }
    while (robot.time < until) {
      ASSERT_TRUE(robot.step());
    }
    robot.sut.stop_hard(1.5);
    const double alone = robot.braking_alone(1.5);
    const double begin = robot.time;
    bool kept = true;
    for (int n = 0; n < 1000 && kept && !robot.sut.idle(); ++n) {
      kept = robot.step(1.5);
    }
    refused += kept ? 0 : 1;
    sum += kept ? robot.time - begin : 0;
    sum_alone += kept ? alone : 0;
  }
  fmt::print(
      "{} emergency stops of joint motions, {} refused by a gate; {:.3f} s on average, each axis alone {:.3f} s\n",
      wanted, refused, sum / wanted, sum_alone / wanted);
  EXPECT_EQ(refused, 0);
}

}  // namespace
}  // namespace indurop::robot
