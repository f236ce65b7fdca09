// SPDX-License-Identifier: Apache-2.0
// Belts carry an arm with masses to where it weighs more: it stops before an axis needs more torque than it has, by
// orocos-kdl.

#include "belt_cell.h"
#include "heavy_arm.h"

namespace indurop::robot {
namespace {

Joints efforts(double second) {
  return joints_of({400, second, 250, 60, 50, 30});
}

// Axis 2 holds the arm before it, and little more.
class HeavyBelts : public Belts {
 protected:
  HeavyBelts() : Belts(with_torques(), heavy_cell_arm(efforts(kMaxTorque)).urdf) {}
  static Settings with_torques() {
    Settings settings = in_tick();
    settings.rated_torque = {400, 400, 250, 60, 50, 30};
    return settings;
  }
  // N m of axis 2 for how the set points have moved.
  double needed() {
    Joints q = Joints::Zero();
    for (int i = 0; i < 6; ++i) {
      q[i] = radians(cell.out.command[static_cast<std::size_t>(i)]);
    }
    seen_ = {seen_[1], seen_[2], q};
    if (++known_ < 3) {
      return 0;
    }
    const Joints velocity = (seen_[2] - seen_[1]) / 0.01;
    const Joints acceleration = (seen_[2] - 2 * seen_[1] + seen_[0]) / 1e-4;
    return kdl_torques(arm_, {}, q, velocity, acceleration)[1];
  }

  static constexpr double kMaxTorque = 85;

 private:
  HeavyArm arm_ = heavy_cell_arm(efforts(kMaxTorque));
  std::array<Joints, 3> seen_{};
  int known_ = 0;
};

TEST_F(HeavyBelts, It_falls_off_where_it_would_be_too_heavy) {
  constexpr Eight kAway{430, 0, 250, 0, 0, 0};
  belt = [](double t) { return 60 * t; };
  begin_tracking(kAway);
  ASSERT_TRUE(run(product(0, 0, 120)));
  double most = 0;
  ASSERT_TRUE(until([&] {
    if (cell.out.state == GroupState::Moving) {
      most = std::max(most, std::abs(needed()));
    }
    return cell.out.state == GroupState::ErrorStop;
  }));
  EXPECT_TRUE(stands());
  EXPECT_EQ(cell.out.error, ErrorCode::Torque);
  EXPECT_EQ(cell.out.error_axis, 2U);
  EXPECT_LE(most, 1.001 * kMaxTorque);
  EXPECT_GT(most, 0.9 * kMaxTorque);
  EXPECT_NE(message().find("no longer follows belt 1"), std::string::npos) << message();
}

}  // namespace
}  // namespace indurop::robot
