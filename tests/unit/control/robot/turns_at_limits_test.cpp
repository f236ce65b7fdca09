// SPDX-License-Identifier: Apache-2.0
// Random lines and circles on which an axis turns back just before its limit: the limit is moved there after the path
// is known. Whatever is planned passes the last gate, which requires that each axis can rest before its limit, also
// with holds and overrides. INDUROP_ROBOT_PATHS says how many, INDUROP_ROBOT_SEED from which one on.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <random>
#include <vector>

#include "control/robot/axis/set_point_gate.h"
#include "control/robot/path/follower.h"
#include "control/robot/path/rates.h"
#include "robot_fixture.h"

namespace indurop::robot {
namespace {

// An arm with what plans its motions.
struct LimitedArm {
  explicit LimitedArm(const Arm& limited) : arm(limited) {}
  Fault plan(const MoveCommand& command, const Joints& from) {
    Fault fault = planner.begin(command, from);
    while (fault.ok() && !planner.done()) {
      fault = planner.check(1000);
    }
    return fault;
  }

  Arm arm;
  Inverse inverse{arm};
  Places places{arm, inverse};
  Planner planner{places, cell_limits(), ToolLimits{1, 4, 40, kPi, 4 * kPi, 40 * kPi}};
};

class Turning {
 public:
  explicit Turning(unsigned seed, bool disturbed) : random_(seed), disturbed_(disturbed) {
    constexpr std::array kPeriods{0.001, 0.004, 0.01};
    period_ = kPeriods[seed % kPeriods.size()];
  }

  enum class End { Other, Rejected, Done };

  // What the gate said; empty: nothing.
  std::string run(End& end, double& slower) {
    auto free = std::make_unique<LimitedArm>(cell_arm());
    const Joints from = anywhere(free->arm, random_, 0.3);
    MoveCommand command;
    const double far = std::exp(in(std::log(0.05), std::log(1.0)));
    command.move = in(0, 1) < 0.7 ? Move::Line : Move::Circle;
    command.mid = pose_near(free->arm, from, far / 2, random_);
    command.target = pose_near(free->arm, from, far, random_);
    command.zone = in(0, 1) < 0.8 ? 0 : 0.01;
    command.speed = in(0, 1) < 0.7 ? 1 : in(0.1, 1);
    end = End::Other;
    if (!free->plan(command, from).ok()) {
      return "";
    }
    const auto narrow = limited_where_it_turns(*free);
    if (!narrow) {
      return "";
    }
    auto limited = std::make_unique<LimitedArm>(*narrow);
    end = End::Rejected;
    if (const Fault fault = limited->plan(command, from); !fault.ok()) {
      return fault.code == ErrorCode::JointLimit ? "" : fmt::format("rejected as {}", to_string(fault.code));
    }
    end = End::Done;
    slower = limited->planner.segment().duration() / free->planner.segment().duration();
    return follow(*limited, from);
  }

 private:
  double in(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random_); }

  // The arm with one limit of an axis moved to just beyond where it turns on the planned line.
  std::optional<Arm> limited_where_it_turns(const LimitedArm& free) {
    constexpr int kPlaces = 4000;
    const Segment& s = free.planner.segment();
    Joints q = s.from;
    Joints highest = q;
    Joints lowest = q;
    for (int i = 1; i <= kPlaces; ++i) {
      if (free.places.on(s, s.length * i / kPlaces, q, q) != Reach::Ok) {
        return {};
      }
      highest = highest.cwiseMax(q);
      lowest = lowest.cwiseMin(q);
    }
    constexpr double kTurns = 0.002;  // rad
    const double room = std::exp(in(std::log(1e-8), std::log(5e-3)));
    auto axes = free.arm.axes();
    for (int k = 0; k < free.arm.count(); ++k) {
      auto& axis = axes[static_cast<std::size_t>(k)];
      if (highest[k] > std::max(s.from[k], q[k]) + kTurns) {
        axis.upper = highest[k] + room;
        return Arm{axes, free.arm.home()};
      }
      if (lowest[k] < std::min(s.from[k], q[k]) - kTurns) {
        axis.lower = lowest[k] - room;
        return Arm{axes, free.arm.home()};
      }
    }
    return {};
  }

  std::string follow(const LimitedArm& limited, const Joints& from) {
    const JointLimits limits = cell_limits();
    Follower follower{limited.places, limits};
    follower.reset(from);
    std::vector<SetPointGate> gates;
    for (int k = 0; k < limited.arm.count(); ++k) {
      const Axis& axis = limited.arm.axis(k);
      gates.emplace_back(SetPointGate::Range{axis.lowest(), axis.highest()}, limits_of_axis(limits, k), period_);
      gates.back().stand(from[k]);
    }
    follower.add(limited.planner.segment(), Blend{});
    for (int i = 0; i < 600 / period_ && !follower.idle(); ++i) {
      if (disturbed_ && in(0, 1) < 3 * period_) {
        if (in(0, 1) < 0.4) {
          follower.set_hold(in(0, 1) < 0.4);
        } else {
          follower.set_override(in(0, 1) < 0.4 ? 1 : in(0.05, 1));
        }
      }
      if (const Fault fault = follower.step(period_); !fault.ok()) {
        return fmt::format("{} of axis {} of the follower", to_string(fault.code), fault.axis);
      }
      for (int k = 0; k < limited.arm.count(); ++k) {
        const double next = follower.joints()[k];
        if (const ErrorCode code = gates[static_cast<std::size_t>(k)].check(next, 1); code != ErrorCode::Ok) {
          return fmt::format("{} of axis {} in period {} of {} ms, {:.2e} rad before its limit", to_string(code), k + 1,
                             i, period_ * 1000,
                             std::min(limited.arm.axis(k).upper - next, next - limited.arm.axis(k).lower));
        }
        gates[static_cast<std::size_t>(k)].pass(next, 1);
      }
    }
    return follower.idle() ? "" : "it does not end";
  }

  std::mt19937 random_;
  bool disturbed_;
  double period_ = 0.01;
};

class Turns_at_limits : public testing::TestWithParam<bool> {};

TEST_P(Turns_at_limits, Pass_the_last_gate) {
  const int first = number_of("INDUROP_ROBOT_SEED", 1);
  const int many = number_of("INDUROP_ROBOT_PATHS", 300);
  std::array<int, 3> ends{};
  int stopped = 0;
  double slowest = 1;
  for (int i = first; i < first + many; ++i) {
    auto end = Turning::End::Other;
    double slower = 1;
    const std::string said = Turning(static_cast<unsigned>(i), GetParam()).run(end, slower);
    EXPECT_EQ(said, "") << "seed " << i;
    stopped += said.empty() ? 0 : 1;
    ++ends[static_cast<std::size_t>(end)];
    slowest = std::max(slowest, slower);
  }
  fmt::print("of {} lines {} turn, {} of them are rejected; the gate stops {}; at most {:.2f} times as long\n", many,
             ends[1] + ends[2], ends[1], stopped, slowest);
  EXPECT_GT(ends[2], many / 20);
}

INSTANTIATE_TEST_SUITE_P(Lines, Turns_at_limits, testing::Bool(),
                         [](const auto& kind) { return kind.param ? "disturbed" : "undisturbed"; });

}  // namespace
}  // namespace indurop::robot
