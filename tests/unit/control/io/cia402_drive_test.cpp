// SPDX-License-Identifier: Apache-2.0
// The simulated drive in its modes: where it goes, how fast, and what stops it.
#include "control/io/cia402_drive.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace indurop::io {
namespace {

using std::chrono::milliseconds;

constexpr double kCounts = 360'000;  // 1000 per degree
constexpr milliseconds kPeriod{1};
constexpr std::uint16_t kEnabling[] = {0x00, 0x06, 0x07, 0x0F};

config::IoAxis axis() {
  config::IoAxis a;
  a.counts = kCounts;
  return a;
}

class Cia402 : public ::testing::Test {
 protected:
  explicit Cia402(const config::IoAxis& settings = axis()) : sut(settings) {}

  DriveFeedback step() { return now = sut.step(command, kPeriod); }
  void steps(int count) {
    for (int i = 0; i < count; ++i) {
      step();
    }
  }
  void enable(DriveMode mode) {
    command.mode = static_cast<std::int8_t>(mode);
    for (const std::uint16_t control : kEnabling) {
      command.control = control;
      step();
    }
    ASSERT_EQ(sut.state(), DriveState::OperationEnabled);
  }
  [[nodiscard]] bool has(std::uint16_t bit) const { return (now.status & bit) != 0; }

  Cia402Drive sut;
  DriveCommand command;
  DriveFeedback now;
};

TEST_F(Cia402, Statusword_of_an_enabled_drive_is_what_field_devices_send) {
  enable(DriveMode::ProfilePosition);
  EXPECT_EQ(now.status & 0x027F, 0x0237);
  EXPECT_EQ(now.mode, 1);
}

TEST_F(Cia402, Does_not_move_unless_enabled) {
  command.mode = 8;
  command.position = 50'000;
  command.control = 0x06;
  steps(200);
  EXPECT_EQ(now.position, 0);
}

TEST_F(Cia402, Profile_position_arrives_in_the_time_of_a_trapezoid) {
  enable(DriveMode::ProfilePosition);
  command.position = 90'000;
  command.control |= kNewSetPoint;
  int reached_at = 0;
  double fastest = 0;
  for (int i = 1; i < 2000 && reached_at == 0; ++i) {
    step();
    fastest = std::max(fastest, std::fabs(static_cast<double>(now.velocity)));
    reached_at = has(kTargetReached) ? i : 0;
  }
  // 90 degrees with 180 deg/s and 720 deg/s2: 90 / 180 + 180 / 720 = 0.75 s, and some time for the loops to settle.
  EXPECT_NEAR(reached_at, 750, 80);
  EXPECT_NEAR(fastest, 180'000, 2000);
  steps(200);
  EXPECT_NEAR(now.position, 90'000, 10);
}

TEST_F(Cia402, Set_point_is_acknowledged_until_the_bit_goes) {
  enable(DriveMode::ProfilePosition);
  EXPECT_FALSE(has(kModeBit12));
  command.position = 1000;
  command.control |= kNewSetPoint;
  step();
  EXPECT_TRUE(has(kModeBit12));
  command.control = 0x0F;
  step();
  EXPECT_FALSE(has(kModeBit12));
}

TEST_F(Cia402, A_second_set_point_waits_unless_it_is_to_count_at_once) {
  enable(DriveMode::ProfilePosition);
  const auto send = [&](std::int32_t to, unsigned more) {
    command.position = to;
    command.control = static_cast<std::uint16_t>(0x0FU | kNewSetPoint | more);
    step();
    command.control = 0x0F;
    step();
  };
  send(20'000, 0);
  send(-20'000, 0);
  std::int32_t highest = 0;
  for (int i = 0; i < 2000; ++i) {
    step();
    highest = std::max(highest, now.position);
  }
  EXPECT_NEAR(highest, 20'000, 50) << "the first was reached before the second began";
  EXPECT_NEAR(now.position, -20'000, 10);
  send(80'000, 0);
  steps(100);
  send(-20'000, kChangeAtOnce);
  highest = now.position;
  for (int i = 0; i < 2000; ++i) {
    step();
    highest = std::max(highest, now.position);
  }
  EXPECT_LT(highest, 60'000);
  EXPECT_NEAR(now.position, -20'000, 10);
  send(5000, kRelative);
  steps(1000);
  EXPECT_NEAR(now.position, -15'000, 10);
}

TEST_F(Cia402, Halt_stops_on_the_ramp_and_goes_on) {
  enable(DriveMode::ProfilePosition);
  command.position = 90'000;
  command.control |= kNewSetPoint;
  steps(300);
  command.control |= kHalt;
  steps(400);
  EXPECT_TRUE(has(kTargetReached));
  EXPECT_NEAR(now.velocity, 0, 100);
  EXPECT_LT(now.position, 80'000);
  command.control = static_cast<std::uint16_t>(command.control & ~kHalt);
  steps(2000);
  EXPECT_NEAR(now.position, 90'000, 10);
}

TEST_F(Cia402, Profile_velocity_ramps_to_its_speed) {
  enable(DriveMode::ProfileVelocity);
  EXPECT_TRUE(has(kModeBit12)) << "speed is 0";
  command.velocity = 90'000;
  steps(100);
  EXPECT_NEAR(now.velocity, 72'000, 4000) << "0.1 s at 720 deg/s2";
  steps(200);
  EXPECT_NEAR(now.velocity, 90'000, 500);
  EXPECT_TRUE(has(kTargetReached));
  EXPECT_FALSE(has(kModeBit12));
}

TEST_F(Cia402, Cyclic_velocity_counts_at_once) {
  enable(DriveMode::CyclicVelocity);
  command.velocity = -30'000;
  steps(60);
  EXPECT_NEAR(now.velocity, -30'000, 500);
}

TEST_F(Cia402, Cyclic_position_follows_a_sine) {
  enable(DriveMode::CyclicPosition);
  double worst = 0;
  for (int i = 0; i < 2000; ++i) {
    command.position = static_cast<std::int32_t>(std::lround(20'000 * (1 - std::cos(0.005 * i))));
    step();
    worst = std::max(worst, std::fabs(static_cast<double>(now.position - command.position)));
  }
  EXPECT_LT(worst, 100) << "0.1 degrees";
  EXPECT_TRUE(has(kModeBit12));
  EXPECT_EQ(sut.state(), DriveState::OperationEnabled);
}

TEST_F(Cia402, A_jump_in_cyclic_position_is_a_following_error_and_a_fault) {
  enable(DriveMode::CyclicPosition);
  command.position = 170'000;
  steps(50);
  EXPECT_TRUE(has(kModeBit13));
  EXPECT_EQ(sut.state(), DriveState::OperationEnabled) << "not beyond its time yet";
  steps(1000);
  EXPECT_EQ(sut.state(), DriveState::Fault);
  EXPECT_EQ(now.error, kFollowingError);
  EXPECT_EQ(now.status & 0x4F, 0x08);
  const std::int32_t stopped = now.position;
  steps(100);
  EXPECT_EQ(now.position, stopped);
  command.control = kFaultReset;
  step();
  EXPECT_EQ(sut.state(), DriveState::SwitchOnDisabled);
  EXPECT_EQ(now.error, 0);
}

TEST_F(Cia402, Quick_stop_brakes_with_the_torque_and_disables) {
  enable(DriveMode::ProfileVelocity);
  command.velocity = 180'000;
  steps(500);
  const std::int32_t before = now.position;
  command.control = 0x02;
  step();
  EXPECT_EQ(sut.state(), DriveState::QuickStopActive);
  steps(100);
  EXPECT_EQ(sut.state(), DriveState::SwitchOnDisabled);
  EXPECT_LT(now.position - before, 3000) << "0.8 * 200 N m at 0.5 kg m2 from 180 deg/s";
}

TEST_F(Cia402, An_unknown_mode_leaves_the_old_one) {
  enable(DriveMode::CyclicPosition);
  command.mode = 42;
  step();
  EXPECT_EQ(now.mode, 8);
}

class Cia402Homing : public Cia402 {
 protected:
  static config::IoAxis settings() {
    config::IoAxis a = axis();
    a.start = 30;
    a.mark = 10;
    return a;
  }
  Cia402Homing() : Cia402(settings()) {}
};

TEST_F(Cia402Homing, Goes_to_the_mark_which_is_0_then) {
  enable(DriveMode::Homing);
  EXPECT_EQ(now.position, 30'000);
  command.control |= kNewSetPoint;
  steps(500);
  EXPECT_FALSE(has(kModeBit12));
  EXPECT_NEAR(now.velocity, -20'000, 500);
  steps(1500);
  EXPECT_TRUE(has(kModeBit12));
  EXPECT_TRUE(has(kTargetReached));
  EXPECT_NEAR(now.position, 0, 10);
  // Positions count from there in the other modes too.
  command.mode = 1;
  command.control = 0x0F;
  step();
  command.position = 5000;
  command.control |= kNewSetPoint;
  steps(1000);
  EXPECT_NEAR(now.position, 5000, 10);
}

TEST(Cia402Wrap, Positions_go_on_beyond_32_bits) {
  config::IoAxis settings = axis();
  settings.counts = 2'000'000'000;
  settings.start = 386;  // of 386.547 that 32 bits can say
  Cia402Drive sut(settings);
  DriveCommand command;
  command.mode = 1;
  for (const std::uint16_t control : kEnabling) {
    command.control = control;
    sut.step(command, kPeriod);
  }
  command.control = 0x5F;  // relative
  command.position = 50'000'000;
  DriveFeedback now;
  for (int i = 0; i < 1000; ++i) {
    now = sut.step(command, kPeriod);
  }
  EXPECT_LT(now.position, 0);
  EXPECT_NE(now.status & kTargetReached, 0);
}

TEST(Cia402Noise, Is_the_same_for_the_same_seed) {
  config::IoAxis settings = axis();
  settings.noise = 3;
  const auto run = [](const config::IoAxis& a) {
    Cia402Drive drive(a);
    std::vector<std::int32_t> seen;
    for (int i = 0; i < 200; ++i) {
      seen.push_back(drive.step({}, kPeriod).position);
    }
    return seen;
  };
  const auto first = run(settings);
  EXPECT_EQ(first, run(settings));
  settings.seed = 2;
  EXPECT_NE(first, run(settings));
  double squares = 0;
  for (const std::int32_t counts : first) {
    squares += static_cast<double>(counts) * counts;
  }
  EXPECT_NEAR(std::sqrt(squares / static_cast<double>(first.size())), 3, 0.6);
}

TEST(Cia402Period, Of_any_length_gives_the_same_way) {
  const auto arrive = [](std::chrono::nanoseconds period, int steps) {
    Cia402Drive drive(axis());
    DriveCommand command{0, 1, 45'000, 0};
    DriveFeedback now;
    for (int i = 0; i < steps; ++i) {
      constexpr std::uint16_t kSequence[] = {0x00, 0x06, 0x07, 0x0F, 0x1F};
      command.control = kSequence[std::min(i, 4)];
      now = drive.step(command, period);
    }
    return now.position;
  };
  EXPECT_NEAR(arrive(milliseconds(10), 200), 45'000, 10);
  EXPECT_NEAR(arrive(std::chrono::microseconds(333), 6000), 45'000, 10);
  EXPECT_NEAR(arrive(std::chrono::microseconds(100), 20'000), 45'000, 10);
}

// Each period of 100 us moves the torque by its share of the way to the set point; none is without a step of the model.
TEST(Cia402Period, Of_100_us_has_the_torque_of_a_winding_in_each_period) {
  constexpr double kBandwidth = 40;
  config::IoAxis settings = axis();
  settings.torque_bandwidth = kBandwidth;
  Cia402Drive drive(settings);
  DriveCommand command;
  command.mode = 10;
  for (const std::uint16_t control : kEnabling) {
    command.control = control;
    drive.step(command, std::chrono::microseconds(100));
  }
  command.torque = 150;  // slowly enough for the speed limit
  for (int i = 1; i < 200; ++i) {
    const double wanted = 150 * (1 - std::exp(-i * 100e-6 * 2 * std::numbers::pi * kBandwidth));
    EXPECT_NEAR(drive.step(command, std::chrono::microseconds(100)).torque, wanted, 0.51) << i;
  }
}

}  // namespace
}  // namespace indurop::io
