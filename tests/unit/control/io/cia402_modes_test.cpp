// SPDX-License-Identifier: Apache-2.0
// Torque modes, interpolation, offsets, limit switches and touch probes of the simulated drive, against the equations
// of its motor.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "control/io/cia402_drive.h"

namespace indurop::io {
namespace {

using std::chrono::milliseconds;

constexpr std::uint16_t kEnablingWords[] = {0x00, 0x06, 0x07, 0x0F};

config::IoAxis axis_in_modes() {
  config::IoAxis a;
  a.counts = 360'000;  // 1000 per degree
  a.low_limit = -90;
  a.high_limit = 90;
  a.probe = 10;
  a.probe2 = -5;
  a.mark = 7;
  return a;
}

class Cia402Modes : public ::testing::Test {
 protected:
  void enable(DriveMode mode) {
    command.mode = static_cast<std::int8_t>(mode);
    for (const std::uint16_t control : kEnablingWords) {
      command.control = control;
      steps(1);
    }
    ASSERT_EQ(sut.state(), DriveState::OperationEnabled);
    ASSERT_EQ(now.mode, command.mode);
  }
  void steps(int count) {
    for (int i = 0; i < count; ++i) {
      now = sut.step(command, milliseconds(1));
    }
  }
  // Moves there in cyclic position mode, a degree in 10 ms.
  void move_to(std::int32_t target) {
    while (command.position != target) {
      command.position += std::clamp(target - command.position, -100, 100);
      steps(1);
    }
    steps(300);
  }
  [[nodiscard]] bool has(std::uint16_t bit) const { return (now.status & bit) != 0; }

  config::IoAxis settings = axis_in_modes();
  Cia402Drive sut{settings};
  DriveCommand command;
  DriveFeedback now;
};

// v(t) = T/d (1 - exp(-d t / J))
TEST_F(Cia402Modes, Cyclic_torque_moves_the_motor_as_its_equation_says) {
  enable(DriveMode::CyclicTorque);
  command.torque = 10;  // 2 N m
  steps(100);
  const double wanted = 2.0 / settings.damping * (1 - std::exp(-settings.damping * 0.1 / settings.inertia));
  EXPECT_NEAR(now.velocity / 1000.0 * std::numbers::pi / 180, wanted, wanted * 0.01);
  EXPECT_EQ(now.torque, 10);
  EXPECT_TRUE(has(kModeBit12));
  command.torque_offset = -10;
  steps(1);
  EXPECT_EQ(now.torque, 0);
}

TEST_F(Cia402Modes, Profile_torque_rises_with_its_slope_and_halts) {
  settings.torque_slope = 100;
  Cia402Drive slow(settings);
  command.mode = 4;
  for (const std::uint16_t control : kEnablingWords) {
    command.control = control;
    now = slow.step(command, milliseconds(1));
  }
  command.torque = 10;
  for (int i = 0; i < 50; ++i) {
    now = slow.step(command, milliseconds(1));
  }
  EXPECT_NEAR(now.torque, 5, 1);
  EXPECT_FALSE(has(kTargetReached));
  for (int i = 0; i < 60; ++i) {
    now = slow.step(command, milliseconds(1));
  }
  EXPECT_EQ(now.torque, 10);
  EXPECT_TRUE(has(kTargetReached));
  command.control |= kHalt;
  for (int i = 0; i < 110; ++i) {
    now = slow.step(command, milliseconds(1));
  }
  EXPECT_EQ(now.torque, 0);
}

TEST_F(Cia402Modes, Torque_never_makes_it_faster_than_the_axis_may_be) {
  settings.low_limit.reset();
  settings.high_limit.reset();
  Cia402Drive free(settings);
  command.mode = 10;
  command.torque = 1000;
  for (int i = 0; i < 3000; ++i) {
    command.control = kEnablingWords[std::min(i, 3)];
    now = free.step(command, milliseconds(1));
    ASSERT_LE(now.velocity, 181'000);
  }
  EXPECT_NEAR(now.velocity, 180'000, 1000);
  EXPECT_TRUE(has(kLimitActive));
}

TEST_F(Cia402Modes, Interpolation_runs_while_bit_4_is_set) {
  enable(DriveMode::InterpolatedPosition);
  command.position = 2000;
  steps(50);
  EXPECT_EQ(now.position, 0);
  EXPECT_FALSE(has(kModeBit12));
  command.position = 0;
  command.control |= kNewSetPoint;
  steps(1);
  EXPECT_TRUE(has(kModeBit12));
  move_to(2000);
  EXPECT_NEAR(now.position, 2000, 5);
}

TEST_F(Cia402Modes, Offsets_add_to_what_is_commanded) {
  enable(DriveMode::CyclicPosition);
  for (int i = 0; i < 100; ++i) {
    command.position_offset += 50;
    steps(1);
  }
  steps(300);
  EXPECT_NEAR(now.position, 5000, 5);
  command = {};
  Cia402Drive other(settings);
  command.mode = 9;
  command.velocity = 10'000;
  command.velocity_offset = 5000;
  for (int i = 0; i < 200; ++i) {
    command.control = kEnablingWords[std::min(i, 3)];
    now = other.step(command, milliseconds(1));
  }
  EXPECT_NEAR(now.velocity, 15'000, 300);
}

TEST_F(Cia402Modes, A_limit_switch_stops_it_and_lets_it_back) {
  for (const DriveMode mode : {DriveMode::ProfileVelocity, DriveMode::CyclicVelocity, DriveMode::CyclicTorque}) {
    command = {};
    Cia402Drive drive(settings);
    command.mode = static_cast<std::int8_t>(mode);
    command.velocity = 100'000;
    command.torque = 30;
    for (int i = 0; i < 4000; ++i) {
      command.control = kEnablingWords[std::min(i, 3)];
      now = drive.step(command, milliseconds(1));
    }
    EXPECT_GE(now.position, 89'900);
    EXPECT_LT(now.position, 97'000) << "stopped with the motor's torque, mode " << static_cast<int>(mode);
    EXPECT_NEAR(now.velocity, 0, 100);
    EXPECT_EQ(now.inputs & 3U, 2U);
    EXPECT_TRUE(has(kLimitActive));
    command.velocity = -50'000;
    command.torque = -10;
    for (int i = 0; i < 400; ++i) {
      now = drive.step(command, milliseconds(1));
    }
    EXPECT_LT(now.position, 85'000) << "mode " << static_cast<int>(mode);
    EXPECT_FALSE(has(kLimitActive)) << "mode " << static_cast<int>(mode);
  }
}

TEST_F(Cia402Modes, A_probe_stores_where_its_input_changed) {
  enable(DriveMode::CyclicPosition);
  command.probe = 0x01 | 0x10 | 0x20 | 0x0100 | 0x2000;  // 1: first of both edges; 2: first to off
  move_to(20'000);
  EXPECT_EQ(now.probe, 0x0103);
  EXPECT_EQ(now.probe_rise, 10'000);
  EXPECT_EQ(now.inputs >> 16U, 3U);
  move_to(-20'000);
  EXPECT_EQ(now.probe, 0x0507);
  EXPECT_EQ(now.probe_fall, 10'000);
  EXPECT_EQ(now.probe2_fall, -5000);
  move_to(20'000);
  EXPECT_EQ(now.probe, 0x0507) << "the first, until it is switched off";
  command.probe = 0;
  steps(1);
  EXPECT_EQ(now.probe, 0);
}

TEST_F(Cia402Modes, A_probe_stores_every_mark) {
  enable(DriveMode::CyclicPosition);
  command.probe = 0x01 | 0x02 | 0x04 | 0x10;
  move_to(20'000);
  EXPECT_EQ(now.probe, 0x0003);
  EXPECT_EQ(now.probe_rise, 7000);
}

TEST_F(Cia402Modes, Tells_how_far_behind_it_is) {
  enable(DriveMode::CyclicPosition);
  std::int32_t most = 0;
  for (int i = 0; i < 100; ++i) {
    command.position += 150;
    steps(1);
    most = std::max(most, now.following);
  }
  EXPECT_GT(most, 100);
  steps(300);
  EXPECT_NEAR(now.following, 0, 2);
}

}  // namespace
}  // namespace indurop::io
