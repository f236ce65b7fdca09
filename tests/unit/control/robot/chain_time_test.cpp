// SPDX-License-Identifier: Apache-2.0
// How long whole chains of lines with zones take, against a reference that finds the least time for the same rounded
// path with the same limits of speed, acceleration and jerk of joints and tool (by components, which is less strict).
// Where the reference ends in a motion that is slower than ours, the ratio counts as 1. INDUROP_ROBOT_LINES says how
// many.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <random>
#include <vector>

#include "control/robot/path/chain.h"
#include "jerk_reference.h"
#include "robot_fixture.h"

namespace indurop::robot {
namespace {

class Chain_time : public testing::Test {
 protected:
  Arm arm = cell_arm();
  Inverse inverse{arm};
  Places places{arm, inverse};
  JointLimits limits = cell_limits();
  ToolLimits tool{1, 4, 40, kPi, 4 * kPi, 40 * kPi};
  Planner planner{places, limits, tool};
  Chain chain;
  std::mt19937 random{11};
  Vec3 along, across;  // of the plane of the chain

  double in(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random); }
  Vec3 direction() { return Vec3(in(-1, 1), in(-1, 1), in(-1, 1)).normalized(); }
  // A random one in a plane that is accepted; false if not. The tool is not turned.
  bool plan(const Joints& from, double zone) {
    along = direction();
    across = along.cross(direction()).normalized();
    Pose pose = arm.forward(from);
    chain.begin(pose, tool);
    const int lines = 2 + static_cast<int>(in(0, 5));
    double angle = 0;
    for (int i = 0; i < lines; ++i) {
      angle += in(-2, 2);
      pose.position += in(0.05, 0.3) * (std::cos(angle) * along + std::sin(angle) * across);
      chain.add({pose, zone, 1, 0, i});
    }
    chain.finish();
    Fault fault = planner.begin(chain, from);
    while (fault.ok() && !planner.done()) {
      fault = planner.check(1000);
    }
    return fault.ok();
  }
  // The tool's movement in the plane takes the place of two joints.
  [[nodiscard]] JerkTask task_of(const Joints& from) const {
    const auto with = [&](Joints joints, double most) {
      joints.tail<2>().setConstant(most);
      return joints;
    };
    JerkTask all;
    const Segment& s = planner.segment();
    all.speeds.path = [&, near = from](double x) mutable {
      places.on(s, x, near, near);
      Joints row = near;
      const Vec3 p = chain.pose_at(x).position;
      row[6] = p.dot(along);
      row[7] = p.dot(across);
      return row;
    };
    all.speeds.length = chain.length();
    all.speeds.most_speed = with(limits.velocity, tool.velocity);
    all.speeds.most_acceleration = with(limits.acceleration, tool.acceleration);
    all.most_jerk = with(limits.jerk, tool.jerk);
    all.speeds.fastest = 1e3;
    all.speeds.hardest = 1e6;
    all.jerk = 1e9;
    return all;
  }
};

TEST_F(Chain_time, Is_near_the_least_time_of_the_rounded_path) {
  const char* text = std::getenv("INDUROP_ROBOT_LINES");
  const std::size_t wanted = text == nullptr ? 25 : static_cast<std::size_t>(std::atoi(text));
  std::vector<double> ratios;
  double sum = 0;
  int ahead = 0;
  for (std::size_t tries = 0; ratios.size() < wanted && tries < 40 * wanted; ++tries) {
    const Joints from = anywhere(arm, random, 0.3);
    const double zone = std::exp(in(std::log(0.005), std::log(0.1)));
    if (!plan(from, zone)) {
      continue;
    }
    const JerkTask task = task_of(from);
    const double took = planner.segment().duration();
    EXPECT_GE(took, 0.995 * least_time(task.speeds));  // nothing is faster than without limits of jerk
    const double least = least_time(task);
    if (least <= 0) {
      continue;
    }
    ahead += took < least ? 1 : 0;
    ratios.push_back(std::max(1.0, took / least));
    sum += ratios.back();
    if (ratios.back() > 1.25) {
      fmt::print("  {:.3f}: {} lines, zone {:.1f} mm, {:.3f} s, {:.3f} s\n", ratios.back(), chain.count(), 1000 * zone,
                 took, least);
    }
  }
  std::sort(ratios.begin(), ratios.end());
  ASSERT_EQ(ratios.size(), wanted);
  const double mean = sum / static_cast<double>(wanted);
  const double p99 = ratios[(wanted - 1) * 99 / 100];
  fmt::print("{} chains: mean {:.3f}, median {:.3f}, p99 {:.3f}, most {:.3f} of the least time; {} below it\n", wanted,
             mean, ratios[wanted / 2], p99, ratios.back(), ahead);
  EXPECT_LT(mean, 1.15);
  EXPECT_LT(p99, 1.3);
}

}  // namespace
}  // namespace indurop::robot
