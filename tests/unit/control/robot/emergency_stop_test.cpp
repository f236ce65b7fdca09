// SPDX-License-Identifier: Apache-2.0
// Emergency stops on a path: within the joints' limits wherever they begin, and against a yardstick how soon the joints
// could bring it to rest. INDUROP_ROBOT_STOPS says how many.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <random>
#include <vector>

#include "braking_reference.h"
#include "control/robot/path/follower.h"
#include "robot_fixture.h"

namespace indurop::robot {
namespace {

constexpr double kHardness = 1.5;

int stops_wanted(int otherwise) {
  const char* text = std::getenv("INDUROP_ROBOT_STOPS");
  return text == nullptr ? otherwise : std::atoi(text);
}

class Emergency_stop : public testing::Test {
 protected:
  Arm arm = cell_arm();
  Inverse inverse{arm};
  Places places{arm, inverse};
  JointLimits limits = cell_limits();
  Planner planner{places, limits, ToolLimits{1, 4, 40, kPi, 4 * kPi, 40 * kPi}};
  Follower sut{places, limits};
  Segment segment;  // the last one
  double period = 0.001;
  std::vector<Joints> way;
  double acceleration = 0;  // along the path, in the last period
  std::mt19937 random{5};

  double in(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random); }
  Target pose_near(const Joints& q, double far) { return robot::pose_near(arm, q, far, random); }

  void start(const Joints& from) {
    sut.set_hold(false);
    sut.reset(from);
    way = {from, from, from};
  }
  bool add(const MoveCommand& command) {
    Fault fault = planner.begin(command, sut.end());
    while (fault.ok() && !planner.done()) {
      fault = planner.check(1000);
    }
    if (!fault.ok() || planner.segment().length <= 0) {
      return false;
    }
    sut.add(planner.segment(), sut.idle() ? Blend{} : planner.blend(segment, planner.segment()));
    segment = planner.segment();
    return true;
  }
  bool step() {
    const double before = sut.speed();
    const Fault fault = sut.step(period);
    way.push_back(sut.joints());
    acceleration = (sut.speed() - before) / period;
    return fault.ok();
  }
  // The part of a joint's limit that the last set point used, at most.
  [[nodiscard]] double used(double hardness) const {
    const std::size_t n = way.size() - 1;
    const Joints v = (way[n] - way[n - 1]) / period;
    const Joints a = (way[n] - 2 * way[n - 1] + way[n - 2]) / (period * period);
    const Joints j = (way[n] - 3 * way[n - 1] + 3 * way[n - 2] - way[n - 3]) / (period * period * period);
    return std::max({v.cwiseAbs().cwiseQuotient(limits.velocity).maxCoeff(),
                     a.cwiseAbs().cwiseQuotient(limits.acceleration).maxCoeff() / hardness,
                     j.cwiseAbs().cwiseQuotient(limits.jerk).maxCoeff() / hardness / hardness});
  }
  // Brakes to rest. Seconds, or below 0 if it could not stay on its path; `most`: of what the limits allow.
  double stop(double& most) {
    sut.stop_hard(kHardness);
    int periods = 0;
    for (; !sut.idle(); ++periods) {
      if (!step()) {
        return -1;
      }
      most = std::max(most, used(kHardness));
    }
    for (int i = 0; i < 3; ++i) {
      step();
      most = std::max(most, used(kHardness));
    }
    return periods * period;
  }

  // Where it is on the line.
  [[nodiscard]] double place() const {
    const Vec3 line = segment.end.position - segment.start.position;
    const Vec3 gone = arm.forward(sut.joints()).position - segment.start.position;
    return gone.dot(line) / line.squaredNorm() * segment.length;
  }
  [[nodiscard]] double least_time() const {
    BrakingTask task;
    const double here = place();
    task.path = [&, here](double x) {
      Joints q = sut.joints();
      places.on(segment, std::clamp(here + x, 0.0, segment.length), q, q);
      return q;
    };
    task.length = segment.length - here;
    task.speed = sut.speed();
    task.acceleration = acceleration;
    task.most_acceleration = kHardness * limits.acceleration;
    task.most_jerk = kHardness * kHardness * limits.jerk;
    return least_braking_time(task);
  }

  // Somewhere on a line, moving.
  bool on_a_line() {
    start(anywhere(arm, random, 0.8));
    MoveCommand command;
    command.move = Move::Line;
    command.target = pose_near(sut.joints(), 0.7);
    if (!add(command)) {
      return false;
    }
    const double until = in(0.1, 0.9) * segment.length;
    while (!sut.idle() && place() < until && step()) {
    }
    return !sut.idle() && sut.speed() > 0.01;
  }
  // Somewhere on one or two paths that may be blended; held, stopping or neither. False if they broke limits already,
  // which is the gate's business.
  bool on_any_path() {
    start(anywhere(arm, random, 0.8));
    for (int i = 0; i < 2; ++i) {
      MoveCommand command;
      command.zone = in(0, 1) < 0.7 ? in(0, 0.1) : 0;
      command.speed = in(0.2, 1);
      const double kind = in(0, 1);
      command.move = kind < 0.6 ? Move::Line : kind < 0.8 ? Move::Circle : Move::Joint;
      command.mid = pose_near(sut.end(), 0.4);
      command.target = pose_near(sut.end(), 0.6);
      if (!add(command) && i == 0) {
        return false;
      }
    }
    const double until = sut.to_go() * in(0.05, 2);
    const double before = in(0, 1) < 0.4 ? until * in(0, 1) : HUGE_VAL;
    const bool hold = in(0, 1) < 0.4;
    bool kept = true;
    for (double t = 0; kept && !sut.idle() && t < until; t += period) {
      kept = step() && used(1) < 1.001;
      if (t > before) {
        if (hold) {
          sut.set_hold(true);
        } else {
          sut.stop();
        }
      }
    }
    return kept && !sut.idle();
  }
};

TEST_F(Emergency_stop, On_lines_takes_hardly_longer_than_the_joints_need) {
  std::vector<double> ratios;
  const int wanted = stops_wanted(60);
  for (int tries = 0; static_cast<int>(ratios.size()) < wanted; ++tries) {
    ASSERT_LT(tries, 20 * wanted);
    period = tries % 3 == 0 ? 0.004 : 0.001;
    if (!on_a_line()) {
      continue;
    }
    const double least = least_time();
    double most = 0;
    const double took = stop(most);
    ASSERT_GE(took, 0) << tries;
    EXPECT_LT(most, 1.0001) << tries;
    EXPECT_LT(took, 1.2 * least + period) << tries;
    ratios.push_back(took / least);
  }
  std::sort(ratios.begin(), ratios.end());
  double sum = 0;
  for (const double ratio : ratios) {
    sum += ratio;
  }
  fmt::print("{} stops, of the least time: mean {:.3f}, p99 {:.3f}, most {:.3f}\n", ratios.size(),
             sum / static_cast<double>(ratios.size()), ratios[ratios.size() * 99 / 100], ratios.back());
  EXPECT_LT(sum, 1.1 * static_cast<double>(ratios.size()));
}

TEST_F(Emergency_stop, Anywhere_keeps_the_limits_and_the_path) {
  int stops = 0;
  int beyond = 0;  // the gate would brake there, off the path
  const int wanted = stops_wanted(300);
  for (int tries = 0; stops < wanted; ++tries) {
    ASSERT_LT(tries, 20 * wanted);
    period = tries % 3 == 0 ? 0.001 : tries % 3 == 1 ? 0.004 : 0.01;
    if (!on_any_path()) {
      continue;
    }
    ++stops;
    double most = 0;
    if (stop(most) < 0 || most > 1.0001) {
      ++beyond;
    }
  }
  fmt::print("{} stops, {} could not keep to their path\n", stops, beyond);
  EXPECT_LE(beyond, stops / 1000);
}

// The job: a line with an ordinary stop, then an emergency in the middle of it.
TEST_F(Emergency_stop, After_an_ordinary_stop_keeps_to_its_factor) {
  const Joints from = joints_of({0, 0.2, 0.1, 0, 0.8, 0});
  for (const int periods : {1, 10, 40, 80, 120}) {
    start(from);
    MoveCommand command;
    command.move = Move::Line;
    command.target.is_pose = true;
    command.target.pose = arm.forward(from);
    command.target.pose.position += Vec3(-0.1, 0.5, -0.1);
    ASSERT_TRUE(add(command));
    while (sut.speed() < 0.3 && !sut.idle()) {
      ASSERT_TRUE(step());
    }
    sut.stop();
    for (int i = 0; i < periods && !sut.idle(); ++i) {
      ASSERT_TRUE(step());
      ASSERT_LT(used(1), 1.001);
    }
    double most = 0;
    EXPECT_GE(stop(most), 0);
    EXPECT_LT(most, 1.0001) << periods;
  }
}

}  // namespace
}  // namespace indurop::robot
