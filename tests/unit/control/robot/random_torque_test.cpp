// SPDX-License-Identifier: Apache-2.0
// Random torques, walls, friction, pushes from outside, commands and faults on drives that are up to six periods away:
// whatever happens, set points keep their limits, the drive never gives more than what was asked for, and the axis does
// not leave its range. INDUROP_ROBOT_TORQUES says how many runs, INDUROP_ROBOT_SEED from which one on.
#include <fmt/core.h>
#include <gtest/gtest.h>

#include <cstdlib>

#include "robot_fixture.h"
#include "torque_cell.h"

namespace indurop::robot {
namespace {

class RandomTorques {
 public:
  explicit RandomTorques(unsigned seed) : random_(seed), setup_(any_setup()), sut_(setup_) {}

  void run() {
    enable();
    for (int i = 0; i < 8 && !testing::Test::HasFailure(); ++i) {
      act();
      for (int k = static_cast<int>(in(0.01, 0.6) / setup_.period); k > 0 && !testing::Test::HasFailure(); --k) {
        sut_.step();
        look();
      }
    }
    come_to_rest();
  }
  long pushed = 0;  // periods
  long reached = 0;
  double worst_speed = 0;  // part of what was asked for, in torque mode

 private:
  double in(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random_); }
  std::size_t one_of(std::size_t many) { return random_() % many; }
  TorqueCell::Setup any_setup() {
    static constexpr double kPeriods[] = {0.001, 0.002, 0.004, 0.01};
    TorqueCell::Setup setup;
    setup.axis = one_of(6);
    setup.period = kPeriods[one_of(4)];
    setup.late_out = one_of(4);
    setup.late_in = one_of(4);
    setup.friction = in(0, 0.1) * most_torques()[static_cast<Eigen::Index>(setup.axis)];
    return setup;
  }
  void enable() {
    sut_.cell.in.emergency = false;
    sut_.pull = 0;
    sut_.give(Service::GroupDisable);
    sut_.run(1);
    sut_.give(Service::GroupReset);
    sut_.run(0.1);
    sut_.give(Service::GroupEnable);
    ASSERT_TRUE(sut_.until([&] { return sut_.cell.out.state == GroupState::Standby; }, 10000))
        << to_string(sut_.cell.out.error);
    sut_.run(0.1);
  }
  void push() {
    const double most = most_torques()[static_cast<Eigen::Index>(setup_.axis)];
    const double torque = one_of(8) == 0 ? 0 : in(-0.5, 0.5) * most;
    velocity_ = in(3, 60);
    given_ = sut_.push(torque, one_of(2) == 0 ? 0 : in(0.5, 10) * most, velocity_);
    asked_ = std::max(asked_, std::abs(torque));
    allowed_ = std::max(allowed_, velocity_);
  }
  void act() {
    switch (one_of(14)) {
      case 0:
        sut_.give(sut_.number(), AxisService::Halt);
        break;
      case 1:
        stop();
        break;
      case 2:
        sut_.give(sut_.number(), AxisService::MoveAbsolute, in(-30, 30), in(5, 60));
        break;
      case 3:
        sut_.give(sut_.number(), AxisService::MoveVelocity, 0, in(3, 40));
        break;
      case 4:
        sut_.cell.in.factors.velocity[setup_.axis] = one_of(2) == 0 ? in(0.1, 1) : one_of(2) == 0 ? 0 : 1;
        break;
      case 5:
        sut_.cell.in.emergency = true;
        break;
      case 6:
        sut_.wall = {sut_.q + in(-0.2, 0.2), one_of(2) == 0 ? 1.0 : -1.0, in(1e3, 1e5)};
        sut_.wall.place += sut_.wall.way * std::max(0.0, sut_.wall.way * (sut_.q - sut_.wall.place));
        break;
      case 7:
        sut_.wall.way = 0;
        break;
      case 8:
        sut_.pull = (one_of(2) == 0 ? 0 : in(-0.2, 0.2)) * most_torques()[static_cast<Eigen::Index>(setup_.axis)];
        break;
      default:
        if (sut_.cell.out.state == GroupState::ErrorStop && one_of(2) == 0) {
          enable();
        }
        push();
    }
  }
  void stop() {
    const auto stop = sut_.give(sut_.number(), AxisService::Stop);
    sut_.run(0.05);
    sut_.command(stop).execute = 0;
  }
  void look() {
    ASSERT_EQ(sut_.broken, "");
    ASSERT_LE(std::abs(sut_.commanded_torque()), asked_ + step());
    ASSERT_LE(sut_.most_given, asked_ + 3 * step());
    ASSERT_LE(sut_.q, sut_.end_upper + 1e-3);
    ASSERT_GE(sut_.q, sut_.end_lower - 1e-3);
    if (sut_.commanded().mode == 10) {
      ++pushed;
      reached += sut_.reached(given_) ? 1 : 0;
      worst_speed = std::max(worst_speed, std::abs(sut_.velocity) * 180 / kPi / allowed_);
    }
  }
  [[nodiscard]] double step() const { return kRatedTorque[setup_.axis] / 1000; }
  void come_to_rest() {
    sut_.pull = 0;
    sut_.give(sut_.number(), AxisService::Halt);
    sut_.run(3);
    EXPECT_NE(sut_.commanded().mode, 10);
    EXPECT_EQ(sut_.commanded().torque, 0);
    EXPECT_NEAR(sut_.velocity, 0, 0.02);  // a drive against a wall trembles
    EXPECT_NE(sut_.now(), AxisState::ContinuousMotion);
  }

  std::mt19937 random_;
  TorqueCell::Setup setup_;
  TorqueCell sut_;
  CommandCell::Given given_;
  double velocity_ = 0;
  double asked_ = 0;
  double allowed_ = 1;
};

TEST(Torque, Random_pushes_keep_their_limits) {
  const int runs = number_of("INDUROP_ROBOT_TORQUES", 40);
  const int first = number_of("INDUROP_ROBOT_SEED", 1);
  long pushed = 0;
  long reached = 0;
  double worst = 0;
  for (int i = first; i < first + runs && !HasFailure(); ++i) {
    SCOPED_TRACE(fmt::format("INDUROP_ROBOT_SEED={}", i));
    RandomTorques sut(static_cast<unsigned>(i));
    sut.run();
    pushed += sut.pushed;
    reached += sut.reached;
    worst = std::max(worst, sut.worst_speed);
  }
  fmt::print("{} periods in torque mode, {} with all of the torque; fastest {:.2f} times what was asked for\n", pushed,
             reached, worst);
  EXPECT_GT(pushed, runs * 100);
  EXPECT_GT(reached, runs * 10);
}

}  // namespace
}  // namespace indurop::robot
