// SPDX-License-Identifier: Apache-2.0
// Parameters of single axes that programs write: what counts from then on, and what is refused.

#include <random>

#include "command_cell.h"

namespace indurop::robot {
namespace {

class AxisParameters : public testing::Test, public CommandCell {
 protected:
  void SetUp() override { ASSERT_TRUE(done(give(1, AxisService::PowerOn))); }
  ErrorCode write(int number, double value) {
    const Given given = give(1, AxisService::WriteParameter, value);
    command(given).option = static_cast<std::int16_t>(number);
    cell.step();
    EXPECT_TRUE(ended(given));
    return error(given);
  }
  [[nodiscard]] const AxisReport& now() const { return cell.out.axes[0]; }
};

TEST_F(AxisParameters, Ends_that_are_written_count_for_targets) {
  EXPECT_EQ(write(2, 40), ErrorCode::Ok);
  EXPECT_EQ(write(3, -20), ErrorCode::Ok);
  EXPECT_NEAR(now().own_upper, 40, 1e-9);
  EXPECT_NEAR(now().own_lower, -20, 1e-9);
  EXPECT_GT(now().upper, 41);
  for (const double beyond : {40.1, -20.1}) {
    const Given given = give(1, AxisService::MoveAbsolute, beyond);
    cell.step();
    EXPECT_EQ(error(given), ErrorCode::JointLimit) << beyond;
  }
  EXPECT_EQ(axis(0), AxisState::Standstill);
  EXPECT_TRUE(done(give(1, AxisService::MoveAbsolute, 40)));
  EXPECT_EQ(write(4, 0), ErrorCode::Ok);
  EXPECT_FALSE(now().upper_counts);
  EXPECT_TRUE(done(give(1, AxisService::MoveAbsolute, 50)));
  EXPECT_EQ(write(4, 1), ErrorCode::JointLimit) << "it stands beyond it";
  EXPECT_TRUE(done(give(1, AxisService::MoveAbsolute, 30)));
  EXPECT_EQ(write(4, 1), ErrorCode::Ok);
}

TEST_F(AxisParameters, On_and_on_it_stops_before_them) {
  ASSERT_EQ(write(2, 20), ErrorCode::Ok);
  const Given sut = give(1, AxisService::MoveVelocity, 0, 60);
  ASSERT_TRUE(cell.until([&] { return ended(sut); }));
  EXPECT_EQ(error(sut), ErrorCode::JointLimit);
  ASSERT_TRUE(cell.until([&] { return axis(0) == AxisState::Standstill; }));
  EXPECT_LT(joint(0), 20);
  EXPECT_GT(joint(0), 19);
}

TEST_F(AxisParameters, What_cannot_be_is_an_error_and_changes_nothing) {
  const AxisReport before = now();
  for (const int number : {0, 1, 7, 8, 10, 11, 12, 14, 16, 18, -3, 999}) {
    EXPECT_EQ(write(number, 10), ErrorCode::Value) << number;
  }
  EXPECT_EQ(write(2, before.upper + 1), ErrorCode::Value);
  EXPECT_EQ(write(3, before.lower - 1), ErrorCode::Value);
  EXPECT_EQ(write(3, before.upper), ErrorCode::Value);
  EXPECT_EQ(write(2, -5), ErrorCode::JointLimit) << "it stands beyond it";
  EXPECT_EQ(write(6, 0), ErrorCode::Value);
  EXPECT_EQ(write(6, 1), ErrorCode::Ok);
  for (const int number : {9, 13, 15, 17}) {
    for (const double value : {0.0, -1.0, 1e9, std::nan("")}) {
      EXPECT_EQ(write(number, value), ErrorCode::Value) << number;
    }
  }
  EXPECT_EQ(now().own_upper, before.own_upper);
  EXPECT_EQ(now().own_lower, before.own_lower);
  EXPECT_EQ(now().own_velocity, before.most_velocity);
  EXPECT_EQ(now().own_jerk, before.most_jerk);
  give(1, AxisService::MoveAbsolute, 40, 20);
  cell.step();
  EXPECT_EQ(write(2, 60), ErrorCode::State) << "it moves";
  EXPECT_EQ(write(9, 10), ErrorCode::Ok);
}

TEST_F(AxisParameters, Numbers_of_ends_follow_the_number_of_the_place) {
  ASSERT_EQ(write(2, 40), ErrorCode::Ok);
  ASSERT_TRUE(done(give(1, AxisService::SetPosition, 100)));
  cell.step();
  EXPECT_NEAR(now().own_upper, 140, 1e-9);
  const Given beyond = give(1, AxisService::MoveAbsolute, 141);
  cell.step();
  EXPECT_EQ(error(beyond), ErrorCode::JointLimit);
  EXPECT_TRUE(done(give(1, AxisService::MoveAbsolute, 139)));
  EXPECT_NEAR(joint(0), 39, 1e-6);
}

// Differences of set points, of any motions within any limits.
TEST_F(AxisParameters, Motions_keep_what_was_written) {
  std::mt19937 random(11);
  const auto in = [&](double low, double high) { return std::uniform_real_distribution<double>(low, high)(random); };
  for (int i = 0; i < 60 && !HasFailure(); ++i) {
    const double v = in(0.1, 1) * now().most_velocity;
    const double a = in(0.1, 1) * now().most_acceleration;
    const double d = in(0.1, 1) * now().most_acceleration;
    const double j = in(0.1, 1) * now().most_jerk;
    ASSERT_EQ(write(9, v), ErrorCode::Ok);
    ASSERT_EQ(write(13, a), ErrorCode::Ok);
    ASSERT_EQ(write(15, d), ErrorCode::Ok);
    ASSERT_EQ(write(17, j), ErrorCode::Ok);
    const Given given = give(1, AxisService::MoveAbsolute, in(-90, 90), i % 2 == 0 ? 0 : 1000);
    double place = joint(0);
    double speed = 0;
    double hard = 0;
    while (!ended(given)) {
      cell.step();
      const double velocity = (joint(0) - place) / 0.01;
      const double acceleration = (velocity - speed) / 0.01;
      EXPECT_LE(std::abs(velocity), v * 1.0001);
      EXPECT_LE(std::abs(acceleration), std::max(a, d) * 1.0001);
      if (std::abs(velocity) > std::abs(speed) + 1e-9) {
        EXPECT_LE(std::abs(acceleration), a * 1.0001);
      }
      EXPECT_LE(std::abs(acceleration - hard) / 0.01, j * 1.0001);
      place = joint(0);
      speed = velocity;
      hard = acceleration;
    }
    EXPECT_EQ(state(given), CommandState::Done);
  }
}

}  // namespace
}  // namespace indurop::robot
