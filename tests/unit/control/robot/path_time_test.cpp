// SPDX-License-Identifier: Apache-2.0
// How long lines and circles from rest to rest take, against a yardstick that knows the same limits of speed and
// acceleration, of joints and tool, but none of jerk. INDUROP_ROBOT_LINES says how many.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <random>
#include <utility>
#include <vector>

#include "control/robot/path/follower.h"
#include "jerk_reference.h"
#include "robot_fixture.h"
#include "topp_reference.h"

namespace indurop::robot {
namespace {

constexpr double kPathPeriod = 0.001;

// A joint that turns by 1 rad alone, at most 2 rad/s and 8 rad/s^2: 1/2 s at full speed and 1/4 s for ramps.
TEST(Topp_reference, Knows_what_is_known_of_one_axis) {
  TimingTask task;
  task.path = [](double x) {
    Joints q = Joints::Zero();
    q[2] = x;
    return q;
  };
  task.length = 1;
  task.most_speed = Joints::Constant(2);
  task.most_acceleration = Joints::Constant(8);
  task.fastest = task.hardest = 100;
  EXPECT_NEAR(least_time(task), 0.75, 1e-3);
  task.fastest = 1;
  EXPECT_NEAR(least_time(task), 1.125, 1e-3);
  task.hardest = 2;
  EXPECT_NEAR(least_time(task), 1.5, 1e-3);
}

// Two axes on a circle of radius 1, a quarter of it: held on it by acceleration 1, no faster than 1 rad/s; the joints
// reach that speed at most.
TEST(Topp_reference, Knows_that_bends_take_acceleration) {
  TimingTask task;
  task.path = [](double x) {
    Joints q = Joints::Zero();
    q[0] = std::cos(x);
    q[1] = std::sin(x);
    return q;
  };
  task.length = 4 * kPi;
  task.most_speed = Joints::Constant(100);
  task.most_acceleration = Joints::Constant(1);
  task.fastest = task.hardest = 100;
  const double time = least_time(task);
  EXPECT_GT(time, 4 * kPi);
  EXPECT_LT(time, 4 * kPi + 2);
}

// The same joint at most 2 rad/s, 8 rad/s^2 and 80 rad/s^3: 0.1 s longer.
TEST(Jerk_reference, Knows_what_is_known_of_one_axis) {
  JerkTask task;
  task.speeds.path = [](double x) {
    Joints q = Joints::Zero();
    q[2] = x;
    return q;
  };
  task.speeds.length = 1;
  task.speeds.most_speed = Joints::Constant(2);
  task.speeds.most_acceleration = Joints::Constant(8);
  task.most_jerk = Joints::Constant(80);
  task.speeds.fastest = task.speeds.hardest = task.jerk = 1000;
  EXPECT_NEAR(least_time(task), 0.85, 0.01);
  task.jerk = 10;
  EXPECT_NEAR(least_time(task), 4 * std::cbrt(1.0 / 20), 0.015);
}

struct PathRatios {
  std::vector<double> all;
  double took = 0, least = 0;
  void add(double one, double other) {
    all.push_back(one / other);
    took += one;
    least += other;
  }
  [[nodiscard]] double mean() const {
    double sum = 0;
    for (const double ratio : all) {
      sum += ratio;
    }
    return sum / static_cast<double>(all.size());
  }
  [[nodiscard]] double part(double p) const {
    std::vector<double> sorted = all;
    std::sort(sorted.begin(), sorted.end());
    return sorted[static_cast<std::size_t>(p * static_cast<double>(sorted.size() - 1))];
  }
  void print(const char* what) const {
    fmt::print("{} {}: mean {:.3f}, median {:.3f}, p99 {:.3f}, most {:.3f} of the least time; in all {:.3f}\n",
               all.size(), what, mean(), part(0.5), part(0.99), part(1), took / least);
  }
};

class Path_time : public testing::Test {
 protected:
  Arm arm = cell_arm();
  Inverse inverse{arm};
  Places places{arm, inverse};
  JointLimits limits = cell_limits();
  ToolLimits tool{1, 4, 40, kPi, 4 * kPi, 40 * kPi};
  Planner planner{places, limits, tool};
  Follower sut{places, limits};
  std::mt19937 random{7};

  double in(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random); }
  Target pose_near(const Joints& q, double far) { return robot::pose_near(arm, q, far, random); }
  // A random one that is accepted; false if not.
  bool plan(Move move, const Joints& from) {
    MoveCommand command;
    command.move = move;
    const double far = in(0.05, 0.7);
    command.mid = pose_near(from, far / 2);
    command.target = pose_near(from, far);
    Fault fault = planner.begin(command, from);
    while (fault.ok() && !planner.done()) {
      fault = planner.check(1000);
    }
    return fault.ok() && planner.segment().length > 0.01;
  }
  [[nodiscard]] JerkTask task_of(const Joints& from) const {
    const Segment& s = planner.segment();
    JerkTask all;
    TimingTask& task = all.speeds;
    // Only its shape counts; it is followed from place to place, so that the joints stay in their posture.
    task.path = [&, near = from](double x) mutable {
      places.on(s, x, near, near);
      return near;
    };
    task.length = s.length;
    task.most_speed = limits.velocity;
    task.most_acceleration = limits.acceleration;
    const auto [fastest, hardest] = tool_allows(s);
    task.fastest = fastest;
    task.hardest = hardest;
    all.most_jerk = limits.jerk;
    all.jerk = std::min(tool.jerk / std::max(s.way / s.length, 1e-9),
                        tool.turn_jerk / std::max(s.turn.norm() / s.length, 1e-9));
    return all;
  }
  // Speed and acceleration of the place on the path, as the tool may move and turn: on circles half of its acceleration
  // is for the bend, half for changes of speed.
  [[nodiscard]] std::pair<double, double> tool_allows(const Segment& s) const {
    const double pace = std::max(s.way / s.length, 1e-9);
    const double turning = std::max(s.turn.norm() / s.length, 1e-9);
    const bool bent = s.move == Move::Circle;
    const double acceleration = bent ? tool.acceleration / 2 : tool.acceleration;
    double fastest = std::min(tool.velocity / pace, tool.turn_velocity / turning);
    if (bent) {
      fastest = std::min(fastest, std::sqrt(acceleration * s.radius_x.norm()) / pace);
    }
    return {fastest, std::min(acceleration / pace, tool.turn_acceleration / turning)};
  }
  // Seconds until rest; 0 if it cannot be followed to its end.
  double follow(const Joints& from) {
    sut.reset(from);
    sut.add(planner.segment());
    int periods = 0;
    for (; !sut.idle(); ++periods) {
      if (!sut.step(kPathPeriod).ok()) {
        return 0;
      }
    }
    return periods * kPathPeriod;
  }
  struct Both {
    PathRatios without, with;  // limits of jerk
  };
  Both measure(Move move) {
    const char* text = std::getenv("INDUROP_ROBOT_LINES");
    const std::size_t wanted = text == nullptr ? 40 : static_cast<std::size_t>(std::atoi(text));
    Both ratios;
    for (std::size_t tries = 0; ratios.with.all.size() < wanted && tries < 20 * wanted; ++tries) {
      const Joints from = anywhere(arm, random, 0.3);
      if (!plan(move, from)) {
        continue;
      }
      const double took = follow(from);
      EXPECT_GT(took, 0) << tries;
      ratios.without.add(took, least_time(task_of(from).speeds));
      ratios.with.add(took, least_time(task_of(from)));
    }
    return ratios;
  }
};

TEST_F(Path_time, Lines_against_the_least_time) {
  const Both ratios = measure(Move::Line);
  ratios.without.print("lines");
  ratios.with.print("lines, limits of jerk counted,");
  EXPECT_GE(ratios.without.part(0), 0.995);  // nothing is faster than the yardstick
  EXPECT_LT(ratios.with.mean(), 1.1);
  EXPECT_LT(ratios.with.part(0.95), 1.25);
}

TEST_F(Path_time, Circles_against_the_least_time) {
  const Both ratios = measure(Move::Circle);
  ratios.without.print("circles");
  ratios.with.print("circles, limits of jerk counted,");
  EXPECT_GE(ratios.without.part(0), 0.995);
  EXPECT_LT(ratios.with.mean(), 1.1);
  EXPECT_LT(ratios.with.part(0.95), 1.25);
}

}  // namespace
}  // namespace indurop::robot
