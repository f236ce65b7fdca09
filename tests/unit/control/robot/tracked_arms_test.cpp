// SPDX-License-Identifier: Apache-2.0
// Arms of other kinds track belts: the tip, by the forward kinematics that arm_kinds_test compares with orocos-kdl,
// is on the path that was asked for, seen from where the product really is, and no set point breaks a limit.

#include <fmt/core.h>

#include "random_belts.h"

namespace indurop::robot {
namespace {

KDL::Frame frame_of(const Pose& pose) {
  const Quat& turn = pose.orientation;
  return {KDL::Rotation::Quaternion(turn.x(), turn.y(), turn.z(), turn.w()),
          KDL::Vector(pose.position.x(), pose.position.y(), pose.position.z())};
}

Eight numbers_of(const KDL::Frame& frame) {
  Eight numbers{1000 * frame.p.x(), 1000 * frame.p.y(), 1000 * frame.p.z()};
  frame.M.GetRPY(numbers[3], numbers[4], numbers[5]);
  for (std::size_t i = 3; i < 6; ++i) {
    numbers[i] = degrees(numbers[i]);
  }
  return numbers;
}

class TrackedArms : public RandomBelts, public testing::WithParamInterface<const char*> {
 protected:
  TrackedArms() : RandomBelts(urdf_of(GetParam())), arm_(arm_of(GetParam())) {}
  void SetUp() override {
    belt = [](double) { return 0.0; };
    ASSERT_TRUE(run(give(Service::GroupEnable)));
  }
  [[nodiscard]] Joints commanded() const {
    Joints q = Joints::Zero();
    for (int i = 0; i < arm_.count(); ++i) {
      q[i] = cell.out.command[static_cast<std::size_t>(i)] * (arm_.axis(i).slides() ? 0.001 : kPi / 180);
    }
    return q;
  }
  [[nodiscard]] KDL::Frame tip_here() const { return frame_of(arm_.forward(commanded())); }
  [[nodiscard]] KDL::Vector tip_there() const { return 1000 * (product_now().Inverse() * tip_here()).p; }
  // Anywhere, with the product on a level belt under the tip.
  bool begin() {
    const Joints q = anywhere(arm_, random, 0.3);
    Eight to{};
    for (int i = 0; i < arm_.count(); ++i) {
      to[static_cast<std::size_t>(i)] = q[i] * (arm_.axis(i).slides() ? 1000 : 180 / kPi);
    }
    belt = [](double) { return 0.0; };
    if (!run(give(Service::DirectAbsolute, to))) {
      return false;
    }
    const double speed = between(-60, 60);
    belt = [speed, from = time](double t) { return speed * (t - from); };
    const KDL::Frame at(KDL::Rotation::RotZ(between(-kPi, kPi)), tip_here().p);
    const KDL::Frame on_belt(at.M.Inverse() * tip_here().M);
    begin_tracking(numbers_of(at), numbers_of(on_belt));
    return true;
  }
  // Rest, and what is wrong acknowledged.
  void end() {
    if (cell.out.state == GroupState::Moving) {
      give(Service::Halt);
    }
    ASSERT_TRUE(
        until([&] { return cell.out.state == GroupState::Standby || cell.out.state == GroupState::ErrorStop; }));
    if (cell.out.state == GroupState::ErrorStop) {
      ASSERT_TRUE(run(give(Service::GroupReset)));
    }
  }
  // mm off the line from `here`.
  [[nodiscard]] double off(const KDL::Vector& here, const KDL::Vector& to) const {
    const KDL::Vector along = to - here;
    const double part = KDL::dot(tip_there() - here, along) / KDL::dot(along, along);
    return (tip_there() - here - along * part).Norm();
  }

 private:
  Arm arm_;
};

TEST_P(TrackedArms, Lines_are_straight_on_the_product) {
  const int runs = number_of("INDUROP_ROBOT_BELTS", 40) / 2;
  random.seed(static_cast<unsigned>(number_of("INDUROP_ROBOT_SEED", 1)));
  int good = 0;
  int bad = 0;
  for (int i = 0; i < runs && !failed; ++i) {
    SCOPED_TRACE(i);
    if (!begin()) {
      end();
      continue;
    }
    KDL::Vector here;
    bool known = false;
    for (int k = 0; k < 3 && cell.out.state != GroupState::ErrorStop; ++k) {
      const KDL::Vector to(between(-30, 30), between(-30, 30), between(-30, 30));
      const Given motion = give(Service::LinearAbsolute, {to[0], to[1], to[2]}, between(30, 200), BufferMode::Aborting,
                                CoordSystem::Product);
      ASSERT_TRUE(until([&] {
        if (known && state(motion) == CommandState::Active && cell.out.error == ErrorCode::Ok) {
          EXPECT_LT(off(here, to), 0.05) << time;
        }
        return ended(motion);
      }));
      known = state(motion) == CommandState::Done;
      int& count = known ? good : bad;
      ++count;
      known = known && cell.out.error == ErrorCode::Ok;  // it may fall off as it gets there
      if (known) {
        EXPECT_LT((tip_there() - to).Norm(), 0.05);
        here = to;
      }
    }
    ASSERT_NO_FATAL_FAILURE(end());
  }
  fmt::print("{} motions on products, {} that could not be\n", good, bad);
  EXPECT_GT(good, bad);
}

INSTANTIATE_TEST_SUITE_P(Kinds, TrackedArms,
                         testing::Values("delta", "gantry", "iiwa14", "offset_wrist", "palletiser", "rail", "scara",
                                         "ur10"),
                         [](const auto& arm) { return std::string(arm.param); });

}  // namespace
}  // namespace indurop::robot
