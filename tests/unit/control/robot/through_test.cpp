// SPDX-License-Identifier: Apache-2.0
// Motions of single axes through a place, with the velocity that they go on with. Random ones are checked by the
// differences of their set points; how long they take is written down here another way.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "command_cell.h"
#include "control/robot/axis/motion.h"

namespace indurop::robot {
namespace {

constexpr LineLimits kMaxLimits{2, 8, 80};
constexpr double kEnd = 3;
constexpr double kThroughPeriod = 0.001;

// From one velocity to another one, without acceleration at both: as long as the textbook says, and halfway between
// them on average.
double change_time(double from, double to, const LineLimits& limits) {
  const double gain = std::abs(to - from);
  return gain * limits.jerk >= limits.acceleration * limits.acceleration
             ? gain / limits.acceleration + limits.acceleration / limits.jerk
             : 2 * std::sqrt(gain / limits.jerk);
}
double change_way(double from, double to, const LineLimits& limits) {
  return change_time(from, to, limits) * (from + to) / 2;
}

class Through : public testing::Test {
 protected:
  Through() {
    sut.set_bounds(kMaxLimits, -HUGE_VAL, HUGE_VAL);
    sut.reset({0, 0, 0});
  }
  double in(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random); }
  double some(double most) { return most * std::pow(10, in(-1, 0)); }
  LineLimits any_limits() { return {some(kMaxLimits.velocity), some(kMaxLimits.acceleration), some(kMaxLimits.jerk)}; }
  void step() {
    sut.step(kThroughPeriod);
    time += kThroughPeriod;
    const double v = (sut.state().position - last.position) / kThroughPeriod;
    const double a = (v - last.velocity) / kThroughPeriod;
    EXPECT_LE(std::abs(v), kMaxLimits.velocity + 1e-6);
    if (known >= 1) {
      EXPECT_LE(std::abs(a), kMaxLimits.acceleration + 1e-5);
    }
    if (known >= 2) {
      EXPECT_LE(std::abs(a - last.acceleration), kMaxLimits.jerk * kThroughPeriod * 1.001 + 1e-5);
    }
    last = {sut.state().position, v, a};
    ++known;
  }
  // Until it has passed the place, or is at its end there. Its set points say where and how fast.
  void pass(double place, double velocity) {
    LineState before = sut.state();
    for (int i = 0; i < 200000 && !sut.went_through(place) && !HasFailure(); ++i) {
      before = sut.state();
      step();
    }
    ASSERT_TRUE(sut.went_through(place));
    EXPECT_NEAR(sut.state().velocity, velocity, 1e-9);
    EXPECT_NEAR(sut.state().acceleration, 0, 1e-9);
    const double beyond = velocity < 0 ? place - sut.state().position : sut.state().position - place;
    EXPECT_GE(beyond, -1e-9);
    EXPECT_LE(beyond, std::abs(velocity) * kThroughPeriod + 1e-9);
    passed_at = time - (velocity == 0 ? 0 : beyond / std::abs(velocity));
    for (int i = 0; i < 50; ++i) {
      step();
      EXPECT_NEAR(sut.state().velocity, velocity, 1e-9);
      EXPECT_TRUE(sut.done());
    }
  }

  std::mt19937 random{3};
  AxisMotion sut;
  LineState last;
  int known = 0;
  double time = 0, passed_at = 0;
};

TEST_F(Through, From_rest_it_takes_as_long_as_the_textbook_says) {
  for (int i = 0; i < 300 && !HasFailure(); ++i) {
    const LineLimits limits = any_limits();
    const LineLimits braking{limits.velocity, some(kMaxLimits.acceleration), limits.jerk};
    const double end = i % 3 == 0 ? some(kMaxLimits.velocity) : in(0.1, 1) * limits.velocity;
    const LineLimits& last_change = end > limits.velocity ? limits : braking;
    const double least = change_way(0, limits.velocity, limits) + change_way(limits.velocity, end, last_change);
    const double length = least + in(0, 3);
    const double sign = i % 2 == 0 ? 1 : -1;
    sut.reset({0, 0, 0});
    last = {};
    known = 0;
    time = 0;
    sut.move_through(sign * length, sign * end, limits, braking);
    pass(sign * length, sign * end);
    const double expected = change_time(0, limits.velocity, limits) + change_time(limits.velocity, end, last_change) +
                            (length - least) / limits.velocity;
    EXPECT_NEAR(passed_at, expected, 1e-6) << i;
  }
}

TEST_F(Through, A_run_up_is_as_long_as_it_has_to_be) {
  for (int i = 0; i < 300 && !HasFailure(); ++i) {
    const LineLimits limits = any_limits();
    const double end = in(0.3, 1) * limits.velocity;
    const double needed = change_way(0, end, limits);
    const double sign = i % 2 == 0 ? 1 : -1;
    const double place = sign * needed * in(-1, 0.9);  // behind it, or too near
    sut.reset({0, 0, 0});
    last = {};
    known = 0;
    sut.move_through(place, sign * end, limits, limits);
    double farthest = 0;
    while (!sut.went_through(place) && !HasFailure()) {
      step();
      farthest = std::min(farthest, sign * sut.state().position);
    }
    EXPECT_NEAR(farthest, sign * place - needed, 1e-4);
    EXPECT_NEAR(sut.state().velocity, sign * end, 1e-9);
  }
}

TEST_F(Through, From_whatever_it_does_limits_are_kept_and_place_and_velocity_met) {
  for (int i = 0; i < 600 && !HasFailure(); ++i) {
    SCOPED_TRACE(i);
    const LineLimits first = any_limits();
    if (i % 3 == 0) {
      sut.move_with(in(-2, 2), first);
    } else if (i % 3 == 1) {
      sut.move_to(in(-kEnd, kEnd), first);
    }
    for (int k = static_cast<int>(in(0, 600)); k > 0; --k) {
      step();
    }
    const LineLimits limits = any_limits();
    const double velocity = i % 7 == 0 ? 0 : (i % 2 == 0 ? 1 : -1) * some(kMaxLimits.velocity);
    const double place = sut.state().position + in(-kEnd, kEnd);
    sut.move_through(place, velocity, limits, {limits.velocity, some(kMaxLimits.acceleration), limits.jerk});
    pass(place, velocity);
  }
}

TEST_F(Through, An_override_never_turns_it_back_on_its_last_way) {
  for (int i = 0; i < 300 && !HasFailure(); ++i) {
    SCOPED_TRACE(i);
    sut.reset({0, 0, 0});
    sut.set_override(1);
    last = {};
    known = 0;
    const double place = in(1.5, kEnd);
    const double velocity = in(0.1, 2);
    sut.move_through(place, velocity, kMaxLimits, kMaxLimits);  // there is room for it
    double before = 0;
    for (int k = 0; k < 4000 && !HasFailure(); ++k) {
      if (random() % 80 == 0) {
        sut.set_override(static_cast<double>(random() % 5) / 4);
      }
      step();
      EXPECT_GE(sut.state().position, before - 1e-12);
      before = sut.state().position;
    }
    sut.set_override(1);
    for (int k = 0; k < 40000 && !sut.done(); ++k) {
      step();
    }
    EXPECT_TRUE(sut.done());
    EXPECT_NEAR(sut.state().velocity, velocity, 1e-9);
    EXPECT_TRUE(sut.went_through(place));
  }
}

class ContinuousCommands : public testing::Test, public CommandCell {
 protected:
  void SetUp() override { ASSERT_TRUE(done(give(1, AxisService::PowerOn))); }
  Given through(double to, double end, double velocity = 60, BufferMode buffer = BufferMode::Aborting,
                AxisService service = AxisService::MoveContinuousAbsolute) {
    const Given given = give(1, service, to, velocity, buffer);
    command(given).to[1] = end;
    return given;
  }
};

TEST_F(ContinuousCommands, They_are_in_continuous_motion_all_the_way_and_behind_it) {
  const Given sut = through(40, 25);
  cell.step();
  EXPECT_EQ(axis(0), AxisState::ContinuousMotion);
  EXPECT_FALSE(reached(sut));
  ASSERT_TRUE(cell.until([&] { return reached(sut); }));
  EXPECT_NEAR(joint(0), 40, 0.3);
  EXPECT_NEAR(cell.out.axes[0].velocity, 25, 1e-6);
  ASSERT_TRUE(cell.until([&] { return joint(0) > 60; }));
  EXPECT_EQ(state(sut), CommandState::Active);
  const Given next = give(1, AxisService::Halt);
  ASSERT_TRUE(done(next));
  EXPECT_EQ(state(sut), CommandState::Aborted);
  EXPECT_EQ(axis(0), AxisState::Standstill);
}

TEST_F(ContinuousCommands, Relative_ones_count_from_where_they_begin_and_may_come_back_through_the_place) {
  ASSERT_TRUE(done(give(1, AxisService::MoveAbsolute, 10)));
  const Given sut = through(20, -25, 60, BufferMode::Aborting, AxisService::MoveContinuousRelative);
  ASSERT_TRUE(cell.until([&] { return joint(0) > 30.5; }));
  EXPECT_FALSE(reached(sut));
  ASSERT_TRUE(cell.until([&] { return reached(sut); }));
  EXPECT_NEAR(joint(0), 30, 0.3);
  EXPECT_NEAR(cell.out.axes[0].velocity, -25, 1e-6);
}

TEST_F(ContinuousCommands, What_cannot_be_is_an_error_and_nothing_moves) {
  const double upper = cell.out.axes[0].upper;
  const double lower = cell.out.axes[0].lower;
  const std::pair<Given, ErrorCode> cases[] = {
      {through(upper + 1, 10), ErrorCode::JointLimit},
      {through(upper - 0.5, 90), ErrorCode::JointLimit},  // it could not rest behind it
      {through(lower + 0.5, 90), ErrorCode::JointLimit},  // no room for its run-up
      {through(10, std::nan("")), ErrorCode::Value},
      {through(10, 1e-9), ErrorCode::Value},
  };
  cell.step();
  for (const auto& [given, code] : cases) {
    EXPECT_EQ(error(given), code);
  }
  EXPECT_EQ(axis(0), AxisState::Standstill);
}

TEST_F(ContinuousCommands, One_that_waits_takes_over_once_it_has_its_velocity) {
  const Given sut = through(30, 20);
  const Given next = give(1, AxisService::MoveAbsolute, 60, 40, BufferMode::Buffered);
  ASSERT_TRUE(cell.until([&] { return state(next) == CommandState::Active; }));
  EXPECT_NEAR(joint(0), 30, 0.6);
  EXPECT_EQ(state(sut), CommandState::Aborted);
  ASSERT_TRUE(done(next));
  EXPECT_NEAR(joint(0), 60, 1e-6);
}

TEST_F(ContinuousCommands, Behind_a_motion_it_passes_its_end_as_the_mode_says) {
  const Given first = give(1, AxisService::MoveAbsolute, 30, 60);
  const Given sut = through(70, 10, 40, BufferMode::BlendingLow);
  ASSERT_TRUE(cell.until([&] { return joint(0) >= 30 - 1e-9; }));
  EXPECT_NEAR(cell.out.axes[0].velocity, 40, 0.5);
  ASSERT_TRUE(cell.until([&] { return reached(sut); }));
  EXPECT_EQ(state(first), CommandState::Done);
  EXPECT_NEAR(joint(0), 70, 0.2);
}

TEST_F(ContinuousCommands, A_change_behind_the_place_does_not_lead_back) {
  const Given sut = through(20, 20);
  ASSERT_TRUE(cell.until([&] { return reached(sut) && joint(0) > 30; }));
  command(sut).to[1] = 35;
  ++command(sut).updates;
  const double before = joint(0);
  ASSERT_TRUE(cell.until([&] { return std::abs(cell.out.axes[0].velocity - 35) < 1e-6; }));
  EXPECT_GT(joint(0), before);
}

}  // namespace
}  // namespace indurop::robot
