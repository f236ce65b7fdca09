// SPDX-License-Identifier: Apache-2.0
// Random lines, circles and chains of short lines one after the other, or motions of all kinds that are blended, with
// holds, overrides and stops at random instants: the set points they make keep all limits before any gate has checked
// them. (Emergency stops are in random_jobs_test.cpp, behind the gate.) INDUROP_ROBOT_PATHS says how many,
// INDUROP_ROBOT_SEED from which one on.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "control/robot/path/chain.h"
#include "control/robot/path/follower.h"
#include "robot_fixture.h"

namespace indurop::robot {
namespace {

constexpr double kRounding = 1e-4;  // what the gate lets pass

class Disturbed {
 public:
  // `blended`: motions of all kinds go over into each other; else each begins and ends at rest.
  Disturbed(unsigned seed, bool blended)
      : random_(seed),
        blended_(blended),
        period_(seed % 3 == 0   ? 0.001
                : seed % 3 == 1 ? 0.004
                                : 0.01) {}

  // Empty, or what broke.
  std::string run() {
    Joints from = anywhere(arm_, random_, 0.3);
    follower_.reset(from);
    q_ = from;
    int planned = 0;
    for (int tries = 0; tries < 30 && planned < 2; ++tries) {
      planned += plan(follower_.end()) ? 1 : 0;
    }
    const double often = in(0, 1) < 0.2 ? 0 : in(1, 12) * period_;
    bool calm = false;
    for (int i = 0; i < 3600 / period_ && !follower_.idle(); ++i) {
      calm = calm || i > 20 / period_;
      if (calm) {
        follower_.set_hold(false);
        follower_.set_override(1);
      } else if (in(0, 1) < often) {
        disturb();
      }
      if (std::string broken = step(); !broken.empty()) {
        return fmt::format("{}in period {} of {} ms", broken, i, period_ * 1000);
      }
    }
    for (int i = 0; i < 4; ++i) {
      if (std::string broken = step(); !broken.empty()) {
        return broken + "at rest";
      }
    }
    return follower_.idle() ? "" : "it does not end";
  }

 private:
  double in(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random_); }
  Target pose_near(const Joints& q, double far) { return robot::pose_near(arm_, q, far, random_); }
  bool plan(const Joints& from) {
    MoveCommand command;
    const double far = std::exp(in(std::log(0.005), std::log(0.8)));
    const double kind = in(0, 1);
    command.move = kind < 0.6 ? Move::Line : blended_ && kind < 0.8 ? Move::Joint : Move::Circle;
    command.zone = blended_ ? in(0, 0.1) : 0;
    command.mid = pose_near(from, far / 2);
    command.target = pose_near(from, far);
    command.speed = in(0, 1) < 0.5 ? 1 : in(0.05, 1);
    Fault fault = !blended_ && in(0, 1) < 0.25 ? begin_chain(from) : planner_.begin(command, from);
    while (fault.ok() && !planner_.done()) {
      fault = planner_.check(1000);
    }
    if (fault.ok()) {
      follower_.add(planner_.segment(), follower_.idle() ? Blend{} : planner_.blend(before_, planner_.segment()));
      before_ = planner_.segment();
    }
    return fault.ok();
  }
  // As of a drawing program: short lines, mostly with small angles between them.
  Fault begin_chain(const Joints& from) {
    Chain& chain = chains_[next_chain_++ % chains_.size()];
    Pose pose = arm_.forward(from);
    chain.begin(pose, tool_);
    const int lines = static_cast<int>(std::exp(in(std::log(3), std::log(300))));
    const double size = std::exp(in(std::log(0.0005), std::log(0.03)));
    const double zone = size * in(0.5, 8);
    const double angle = in(0, 1) < 0.3 ? in(0, 2) : in(0, 0.1);
    const double turn = in(0, 1) < 0.5 ? 0 : in(0, 0.02);
    const double speed = in(0, 1) < 0.5 ? 1 : in(0.05, 1);
    Vec3 direction = Vec3(in(-1, 1), in(-1, 1), in(-1, 1)).normalized();
    for (int i = 0; i < lines; ++i) {
      direction = rotation_by(angle * Vec3(in(-1, 1), in(-1, 1), in(-0.5, 1))) * direction;
      pose.position += in(0.3, 1) * size * direction;
      pose.orientation = pose.orientation * rotation_by(turn * Vec3(in(-1, 1), in(-1, 1), in(-1, 1)));
      chain.add({pose, zone, speed, 0, 0});
    }
    chain.finish();
    return planner_.begin(chain, from);
  }
  void disturb() {
    const double what = in(0, 1);
    if (what < 0.3) {
      follower_.set_hold(in(0, 1) < 0.5);
    } else if (what < 0.95) {
      follower_.set_override(in(0, 1) < 0.3 ? 1 : in(0, 1));
    } else {
      follower_.stop();
    }
  }
  std::string step() {
    if (const Fault fault = follower_.step(period_); !fault.ok()) {
      return fmt::format("{} of axis {} ", to_string(fault.code), fault.axis);
    }
    const Joints v = (follower_.joints() - q_) / period_;
    const Joints a = (v - v_) / period_;
    const Joints j = (a - a_) / period_;
    q_ = follower_.joints();
    v_ = v;
    a_ = a;
    std::string broken;
    const auto judge = [&](const char* what, const Joints& value, const Joints& limit) {
      Eigen::Index axis = 0;
      const double part = value.cwiseAbs().cwiseQuotient(limit).maxCoeff(&axis);
      if (!(part <= 1 + kRounding)) {
        broken += fmt::format("axis {}: {} {:.4f} times its limit; ", axis + 1, what, part);
      }
    };
    judge("speed", v, limits_.velocity);
    judge("acceleration", a, limits_.acceleration);
    judge("jerk", j, limits_.jerk);
    return broken;
  }

  std::mt19937 random_;
  bool blended_;
  double period_;
  Arm arm_ = cell_arm();
  Inverse inverse_{arm_};
  Places places_{arm_, inverse_};
  JointLimits limits_ = cell_limits();
  ToolLimits tool_{1, 4, 40, kPi, 4 * kPi, 40 * kPi};
  Planner planner_{places_, limits_, tool_};
  std::array<Chain, 5> chains_;
  std::size_t next_chain_ = 0;
  Segment before_;
  Follower follower_{places_, limits_};
  Joints q_, v_ = Joints::Zero(), a_ = Joints::Zero();
};

class Disturbed_paths : public testing::TestWithParam<bool> {};

TEST_P(Disturbed_paths, Keep_all_limits_before_any_gate) {
  const int first = number_of("INDUROP_ROBOT_SEED", 1);
  const int many = number_of("INDUROP_ROBOT_PATHS", 400);
  int bad = 0;
  for (int i = 0; i < many; ++i) {
    const auto seed = static_cast<unsigned>(first + i);
    const std::string broken = Disturbed(seed, GetParam()).run();
    EXPECT_EQ(broken, "") << "seed " << seed;
    bad += broken.empty() ? 0 : 1;
  }
  fmt::print("{} of {} break a limit\n", bad, many);
}

INSTANTIATE_TEST_SUITE_P(Motions, Disturbed_paths, testing::Bool(),
                         [](const auto& kind) { return kind.param ? "blended" : "from_rest"; });

}  // namespace
}  // namespace indurop::robot
