// SPDX-License-Identifier: Apache-2.0
// An axis that turns endlessly ends where its drive counts no farther in 32 bits: motions of its own are refused or end
// before it. The judge counts what the drive gets.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <random>

#include "command_cell.h"
#include "limit_judge.h"

namespace indurop::robot {
namespace {

constexpr std::size_t kTable = 6;
constexpr std::int32_t kLastCount = 2'147'483'647;
constexpr double kPerTurn = 1'320'000;
constexpr double kFarthest = kLastCount / kPerTurn * 360;  // deg

class Endless_range : public testing::Test, public CommandCell {
 protected:
  static constexpr double kPeriod = 4;  // ms

  Endless_range() : CommandCell(kPeriod, {}, urdf_of("turntable")), judge_(kPeriod / 1000, urdf_of("turntable")) {}

  // Begins with the table so far from that end.
  void begin(double turns, int side = 1) {
    cell.in.drives[kTable].position = side * (kLastCount - static_cast<std::int32_t>(turns * kPerTurn));
    cell.step();
    ASSERT_TRUE(cell.serve(Service::GroupEnable));
    for (int i = 0; i < 4; ++i) {
      cell.step();
      static_cast<void>(judge_.look(cell, 1));
    }
  }
  void step() {
    cell.step();
    const std::int32_t counts = std::abs(cell.out.drives[kTable].position);
    ASSERT_LT(counts, kLastCount) << "the set points of its drive stand still";
    most_ = std::max(most_, counts);
    ASSERT_EQ(judge_.look(cell, 1), "");
  }
  template <class Condition>
  [[nodiscard]] bool until(const Condition& condition, int most = 20000) {
    for (int i = 0; i < most && !condition() && !HasFatalFailure(); ++i) {
      step();
    }
    return condition();
  }
  void expect_named() const {
    EXPECT_STREQ(cell.out.job.message, "axis 7 (turn) would leave its range, -585677 to 585677 degrees");
  }

  Judge judge_;
  std::int32_t most_ = 0;
};

TEST_F(Endless_range, A_target_beyond_it_is_refused) {
  begin(0.5);
  const double at = cell.out.command[kTable];
  for (const double to : {kFarthest + 0.01, 6e5, -6e5, 1e12}) {
    EXPECT_FALSE(cell.serve_axis(kTable, AxisService::MoveAbsolute, to)) << to;
    EXPECT_EQ(cell.out.axes[kTable].error, ErrorCode::JointLimit);
  }
  EXPECT_FALSE(cell.serve_axis(kTable, AxisService::MoveRelative, 200));
  EXPECT_EQ(cell.out.axes[kTable].error, ErrorCode::JointLimit);
  expect_named();
  EXPECT_EQ(cell.out.axes[kTable].state, AxisState::Standstill);
  EXPECT_EQ(cell.out.command[kTable], at);
  EXPECT_TRUE(cell.serve_axis(kTable, AxisService::MoveRelative, 100));
}

TEST_F(Endless_range, An_endless_motion_rests_before_it) {
  for (const int side : {1, -1}) {
    begin(2, side);
    cell.ask_axis(kTable, AxisService::MoveVelocity, 0, side * 80);
    ASSERT_TRUE(until([&] { return cell.out.axes[kTable].error == ErrorCode::JointLimit; }));
    expect_named();
    ASSERT_TRUE(until([&] { return cell.out.axes[kTable].state == AxisState::Standstill; }, 200));
    EXPECT_LT(std::abs(cell.out.command[kTable]), kFarthest);
    EXPECT_GT(std::abs(cell.out.command[kTable]), kFarthest - 1);
    EXPECT_TRUE(cell.serve_axis(kTable, AxisService::MoveRelative, side * -90)) << "it returns";
    ASSERT_TRUE(cell.serve(Service::GroupDisable));
  }
}

TEST_F(Endless_range, A_block_that_turns_it_endlessly_ends_with_the_error) {
  begin(1);
  const Given turns = give(7, AxisService::MoveVelocity, 0, 80);
  ASSERT_TRUE(until([&] { return ended(turns); }));
  EXPECT_EQ(error(turns), ErrorCode::JointLimit);
  expect_named();
  ASSERT_TRUE(until([&] { return axis(kTable) == AxisState::Standstill; }, 200));
}

TEST_F(Endless_range, An_axis_in_gear_brakes_before_it) {
  for (const double ratio : {1.0, 2.0}) {
    begin(1);
    const Given gear = give(7, AxisService::GearIn, ratio);
    command(gear).to[1] = 1;
    command(gear).option = 1;  // the master
    ASSERT_TRUE(until([&] { return reached(gear); }));
    const Given master = give(1, AxisService::MoveAbsolute, 340, 25);
    command(master).acceleration = 50;
    command(master).jerk = 400;
    ASSERT_TRUE(until([&] { return ended(master); }));
    EXPECT_EQ(state(gear), ratio > 1 ? CommandState::Error : CommandState::Active) << to_string(error(gear));
    EXPECT_EQ(error(gear), ratio > 1 ? ErrorCode::JointLimit : ErrorCode::Ok);
    ASSERT_TRUE(cell.serve(Service::GroupDisable));
    cell.in.drives[0].position = 0;
  }
}

// Motions of all kinds near both ends.
TEST_F(Endless_range, No_motion_leaves_it) {
  std::mt19937 random;
  const auto in = [&](double low, double high) { return std::uniform_real_distribution<double>(low, high)(random); };
  const auto one_of = [&](int many) { return std::uniform_int_distribution<int>(0, many - 1)(random); };
  int refused = 0;
  const int first = number_of("INDUROP_ROBOT_SEED", 1);
  for (int seed = first; seed < first + number_of("INDUROP_ROBOT_ENDS", 12); ++seed) {
    SCOPED_TRACE(seed);
    random.seed(static_cast<unsigned>(seed));
    const int side = seed % 2 == 0 ? 1 : -1;
    begin(in(0.001, 0.3), side);
    ErrorCode before = ErrorCode::Ok;
    for (int i = 0; i < 6000; ++i) {
      if (one_of(100) == 0) {
        constexpr AxisService kServices[] = {
            AxisService::MoveAbsolute, AxisService::MoveRelative,           AxisService::MoveAdditive,
            AxisService::MoveVelocity, AxisService::MoveContinuousRelative, AxisService::MoveSuperimposed,
            AxisService::Halt};
        const AxisService what = kServices[one_of(7)];
        const double way = side * in(-60, 120);
        const Given given = give(7, what, what == AxisService::MoveAbsolute ? side * kFarthest + way : way,
                                 what == AxisService::MoveVelocity ? side * in(-80, 80) : in(5, 85));
        command(given).to[1] = what == AxisService::MoveContinuousRelative ? in(-80, 80) : 0;
        command(given).acceleration = one_of(2) == 0 ? 0 : in(30, 300);
        command(given).jerk = one_of(2) == 0 ? 0 : in(300, 3000);
        command(given).direction = static_cast<Direction>(one_of(5));
        command(given).buffer = static_cast<BufferMode>(one_of(6));
      } else if (one_of(200) == 0) {
        cell.in.speed_override = in(0, 100);
      } else if (one_of(300) == 0) {
        cell.in.jog = {};
        cell.in.jog.enabled = one_of(2) == 0;
        cell.in.jog.speed[kTable] = side * 100;
      }
      ASSERT_NO_FATAL_FAILURE(step());
      ASSERT_NE(cell.out.state, GroupState::ErrorStop) << to_string(cell.out.error);
      refused += cell.out.axes[kTable].error == ErrorCode::JointLimit && before != ErrorCode::JointLimit ? 1 : 0;
      before = cell.out.axes[kTable].error;
    }
    cell.in.jog = {};
    cell.in.speed_override = 100;
    ASSERT_TRUE(until([&] { return cell.out.state == GroupState::Standby; }));
    const Given halt = give(7, AxisService::Halt);
    ASSERT_TRUE(until([&] { return ended(halt) && axis(kTable) == AxisState::Standstill; }));
    ASSERT_TRUE(cell.serve(Service::GroupDisable));
  }
  fmt::print("{} motions refused or ended; at most {} counts before the end\n", refused, kLastCount - most_);
  EXPECT_GT(refused, 0);
}

}  // namespace
}  // namespace indurop::robot
