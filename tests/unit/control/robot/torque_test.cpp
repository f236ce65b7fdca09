// SPDX-License-Identifier: Apache-2.0
// MC_TorqueControl: an axis pushes with what it was asked for, and whatever happens meanwhile, it keeps its limits. The
// plant is orocos-kdl.
#include <fmt/core.h>
#include <gtest/gtest.h>

#include "torque_cell.h"

namespace indurop::robot {
namespace {

constexpr double kStep = 0.45;  // N m, what a thousandth is at most and rounding

double deg(double rad) {
  return rad * 180 / kPi;
}

std::unique_ptr<TorqueCell> powered(const TorqueCell::Setup& setup) {
  auto sut = std::make_unique<TorqueCell>(setup);
  sut->give(Service::GroupEnable);
  EXPECT_TRUE(sut->until([&] { return sut->cell.out.state == GroupState::Standby; }));
  sut->run(0.3);
  return sut;
}

TEST(Torque, Against_a_wall_it_pushes_with_what_is_asked_for) {
  for (const std::size_t axis : {0U, 1U, 4U}) {
    for (const double way : {1.0, -1.0}) {
      const auto sut = powered({axis, 0.004, 2, 1});
      sut->wall = {sut->q + way * 0.1, way};
      const double torque = way * (axis == 4 ? 6 : 40);
      const auto given = sut->push(torque, std::abs(torque) * 5);
      double before = 0;
      ASSERT_TRUE(sut->until([&] {
        EXPECT_LE(std::abs(sut->commanded_torque()), std::abs(torque) + kStep);
        EXPECT_LE(std::abs(sut->commanded_torque()) - before, std::abs(torque) * 5 * 0.004 + kStep);
        before = std::abs(sut->commanded_torque());
        return sut->reached(given);
      })) << axis;
      sut->run(1);
      EXPECT_TRUE(sut->reached(given));
      EXPECT_EQ(sut->now(), AxisState::ContinuousMotion);
      EXPECT_NEAR(sut->against_wall(), torque, 0.03 * std::abs(torque)) << "axis " << axis + 1;
      EXPECT_EQ(sut->broken, "");
    }
  }
}

TEST(Torque, With_nothing_in_its_way_it_keeps_its_velocity_and_stops_before_its_end) {
  for (const std::size_t axis : {0U, 1U, 3U}) {
    for (const double velocity : {5.0, 40.0}) {
      const auto sut = powered({axis, 0.004, 1, 2, 1});
      const double torque = 0.3 * most_torques()[static_cast<Eigen::Index>(axis)];
      const auto given = sut->push(torque, 10 * torque, velocity);
      ASSERT_TRUE(sut->until([&] { return deg(sut->velocity) > 0.95 * velocity || sut->ended(given); }));
      sut->run(0.4);
      EXPECT_NEAR(deg(sut->velocity), velocity, 0.05 * velocity) << "axis " << axis + 1;
      ASSERT_TRUE(sut->until([&] { return sut->ended(given); }, 100000));
      EXPECT_EQ(sut->error(given), ErrorCode::JointLimit);
      EXPECT_LE(deg(sut->fastest), 1.2 * velocity);
      ASSERT_TRUE(sut->until([&] { return sut->now() == AxisState::Standstill; }));
      sut->run(0.2);
      EXPECT_LT(sut->q, sut->end_upper + 1e-3);
      EXPECT_GT(sut->q, sut->end_upper - radians(5));
      EXPECT_EQ(sut->commanded().mode, 8);
      EXPECT_EQ(sut->commanded().torque, 0);
      EXPECT_EQ(sut->broken, "");
      EXPECT_EQ(sut->cell.out.error, ErrorCode::Ok) << to_string(sut->cell.out.error);
    }
  }
}

TEST(Torque, Without_torque_the_arm_floats) {
  const auto sut = powered({1, 0.004, 1, 1});
  const double from = sut->q;
  const auto given = sut->push(0);
  sut->run(0.5);
  EXPECT_TRUE(sut->reached(given));
  EXPECT_EQ(sut->commanded().mode, 10);
  EXPECT_NEAR(deg(sut->q), deg(from), 1);  // what the rounding of torques turns it by
  sut->pull = 15;
  sut->run(0.5);
  EXPECT_GT(deg(sut->q), deg(from) + 1) << "a hand moves it";
  sut->pull = 0;
}

TEST(Torque, What_cannot_be_is_refused_and_moves_nothing) {
  const auto sut = powered({0, 0.004, 1, 1});
  const double from = sut->q;
  const auto refused = [&](const CommandCell::Given& given) {
    EXPECT_TRUE(sut->until([&] { return sut->ended(given); }));
    return sut->error(given);
  };
  EXPECT_EQ(refused(sut->push(251)), ErrorCode::Torque);
  EXPECT_EQ(refused(sut->push(std::nan(""))), ErrorCode::Value);
  EXPECT_EQ(refused(sut->push(10, -1)), ErrorCode::Value);
  EXPECT_EQ(refused(sut->push(10, std::nan(""))), ErrorCode::Value);
  EXPECT_EQ(refused(sut->push(10, 1, -5)), ErrorCode::Value);
  sut->has_torque_mode = false;
  EXPECT_EQ(refused(sut->push(10)), ErrorCode::NoTorque);
  ASSERT_TRUE(sut->until([&] { return sut->now() == AxisState::Standstill; }));
  EXPECT_NEAR(sut->q, from, 1e-5);
  CommandCell light(4);
  ASSERT_TRUE(light.done(light.give(1, AxisService::PowerOn)));
  const auto given = light.give(1, AxisService::TorqueControl, 10);
  light.cell.step();
  EXPECT_EQ(light.error(given), ErrorCode::NoTorque) << "its mass is not known";
}

TEST(Torque, Drives_that_change_their_mode_on_their_own_are_noticed) {
  const auto sut = powered({0, 0.004, 1, 1});
  auto given = sut->push(10, 100, 10);
  sut->run(0.5);
  ASSERT_EQ(sut->commanded().mode, 10);
  sut->has_torque_mode = false;
  sut->force_mode(8);
  ASSERT_TRUE(sut->until([&] { return sut->ended(given); }));
  EXPECT_EQ(sut->error(given), ErrorCode::Drive);
  ASSERT_TRUE(sut->until([&] { return sut->now() == AxisState::Standstill; }));
  EXPECT_EQ(sut->broken, "");
  sut->has_torque_mode = true;
  given = sut->push(10, 100, 10);
  sut->run(0.5);
  ASSERT_EQ(sut->commanded().mode, 10);
  sut->stays_in_mode = true;
  const auto stop = sut->give(1, AxisService::Halt);
  ASSERT_TRUE(sut->until([&] { return sut->now() == AxisState::ErrorStop || sut->now() == AxisState::Disabled; }));
  EXPECT_TRUE(sut->ended(stop));
  sut->run(0.2);
  EXPECT_NE(sut->commanded().control & 0x0F, 0x0F) << "its brake holds it";
}

TEST(Torque, Other_commands_take_over_in_mid_motion) {
  for (const auto service : {AxisService::Stop, AxisService::Halt, AxisService::MoveAbsolute, AxisService::MoveVelocity,
                             AxisService::TorqueControl}) {
    const auto sut = powered({1, 0.004, 2, 2, 2});
    const auto given = sut->push(60, 300, 40);
    ASSERT_TRUE(sut->until([&] { return deg(sut->velocity) > 30; }));
    const auto other = sut->give(2, service, service == AxisService::TorqueControl ? -60 : 5, 15);
    ASSERT_TRUE(sut->until([&] { return sut->ended(given); }));
    EXPECT_EQ(sut->state(given), CommandState::Aborted);
    if (service == AxisService::TorqueControl) {
      EXPECT_TRUE(sut->until([&] { return deg(sut->velocity) < -10; }));
    } else if (service == AxisService::MoveVelocity) {
      EXPECT_TRUE(sut->until([&] { return sut->reached(other); }));
    } else {
      EXPECT_TRUE(sut->until([&] { return sut->state(other) == CommandState::Done; }));
      sut->run(0.3);
      EXPECT_NEAR(deg(sut->velocity), 0, 0.01);
    }
    if (service == AxisService::MoveAbsolute) {
      EXPECT_NEAR(deg(sut->q), 5, 0.01);
    }
    EXPECT_EQ(sut->broken, "") << static_cast<int>(service);
    EXPECT_EQ(sut->cell.out.error, ErrorCode::Ok) << to_string(sut->cell.out.error);
  }
}

TEST(Torque, What_gives_way_is_not_run_after) {
  const auto sut = powered({0, 0.004, 2, 2});
  sut->wall = {sut->q + 0.05, 1};
  const auto given = sut->push(100, 1000, 10);
  ASSERT_TRUE(sut->until([&] { return sut->reached(given); }));
  sut->run(0.2);
  const double from = sut->q;
  sut->wall.way = 0;
  ASSERT_TRUE(sut->until([&] { return sut->ended(given); }));
  EXPECT_EQ(sut->error(given), ErrorCode::Speed);
  ASSERT_TRUE(sut->until([&] { return sut->now() == AxisState::Standstill; }));
  sut->run(0.2);
  EXPECT_LT(deg(sut->q - from), 20);
  EXPECT_EQ(sut->broken, "");
}

}  // namespace
}  // namespace indurop::robot
