// SPDX-License-Identifier: Apache-2.0
// Guiding by hand: when it begins and ends, that the arm stands when nothing pushes, moves as mass and damping predict,
// and stops when its drives or its payload are not what they should be. orocos-kdl is the arm.
#include <gmock/gmock.h>

#include "guided_cell.h"
#include "limit_judge.h"
#include "tests/unit/allocations.h"

namespace indurop::robot {
namespace {

using testing::HasSubstr;

const Joints kBent = GuidedCell::joints_of_six({0.3, 0.2, -0.4, 0.2, 0.9, 0.1});

class Guiding_by_hand : public testing::Test {
 protected:
  GuidedCell sut{GuidedCell::of_cell()};

  void SetUp() override {
    ASSERT_TRUE(sut.enable());
    ASSERT_TRUE(sut.go(kBent)) << to_string(sut.cell.out.error);
  }
  [[nodiscard]] std::string message() const { return sut.cell.out.job.message; }
  [[nodiscard]] double speed() const {
    const auto& speeds = sut.cell.out.speed;
    return std::abs(
        *std::max_element(speeds.begin(), speeds.end(), [](double a, double b) { return std::abs(a) < std::abs(b); }));
  }
  [[nodiscard]] bool rests_within(double seconds) {
    return sut.until([&] { return speed() == 0 && !sut.cell.out.guided; }, seconds);
  }
};

TEST_F(Guiding_by_hand, Is_permitted_in_manual_mode_with_the_enabling_device_only) {
  sut.cell.in.mode.mode = OperatingMode::Automatic;
  EXPECT_FALSE(sut.guide());
  EXPECT_EQ(sut.cell.out.error, ErrorCode::Mode);
  sut.press(false);
  sut.cell.in.mode.mode = OperatingMode::Any;
  sut.run(0.1);
  EXPECT_FALSE(sut.guide());
  sut.press(false);
  sut.cell.in.mode = {OperatingMode::Manual, false, 0};
  sut.run(0.1);
  EXPECT_FALSE(sut.guide());
  EXPECT_EQ(sut.cell.out.error, ErrorCode::Enabling);
  sut.press(false);
  sut.cell.in.mode.enabled = true;
  sut.run(0.1);
  EXPECT_TRUE(sut.guide()) << message();
  EXPECT_EQ(sut.cell.out.state, GroupState::Moving);
}

// The torques that the robot computes are those of orocos-kdl, so nothing seems to push.
TEST_F(Guiding_by_hand, Without_a_push_the_arm_stands_for_a_minute) {
  ASSERT_TRUE(sut.guide()) << message();
  const Joints before = sut.commanded();
  sut.run(60);
  EXPECT_TRUE(sut.cell.out.guided) << message();
  EXPECT_EQ(sut.commanded(), before);
}

// A second model of the mass: levers and torques by orocos-kdl, integrated in small steps.
TEST_F(Guiding_by_hand, The_arm_moves_as_mass_and_damping_predict) {
  constexpr double kMass = 20;
  constexpr double kDamping = 150;
  constexpr double kSmooth = 0.03;  // s, of the measured push
  for (const Vec3& force : {Vec3(0, 32, 0), Vec3(30, 0, 0), Vec3(-15, 20, 8)}) {
    ASSERT_TRUE(sut.go(kBent));
    ASSERT_TRUE(sut.guide()) << message();
    sut.force = force;
    Joints q = kBent;
    Joints v = Joints::Zero();
    Joints felt = Joints::Zero();
    double worst = 0;
    double farthest = 0;
    for (int i = 0; i < 1.2 / sut.period; ++i) {
      sut.step();
      constexpr int kSteps = 20;
      for (int s = 0; s < kSteps; ++s) {
        const double h = sut.period / kSteps;
        felt += h / kSmooth * (sut.hand_torques(q) - felt);
        const KDL::Jacobian jacobian = sut.jacobian(q);
        for (int k = 0; k < 6; ++k) {
          const double lever = std::max(jacobian.data.col(k).head<3>().norm(), 0.15);
          const double least = 0.02 * sut.setup.rated[static_cast<std::size_t>(k)];
          const double torque = std::abs(felt[k]) > least ? felt[k] - std::copysign(least, felt[k]) : 0;
          v[k] += h * (torque - kDamping * lever * lever * v[k]) / (kMass * lever * lever);
        }
        q += h * v;
      }
      const Vec3 here = Vec3::Map(sut.place(sut.commanded()).p.data);
      const Vec3 there = Vec3::Map(sut.place(q).p.data);
      worst = std::max(worst, (here - there).norm());
      farthest = std::max(farthest, (there - Vec3::Map(sut.place(kBent).p.data)).norm());
    }
    fmt::print("{:.1f} mm moved, {:.2f} mm from the model\n", 1000 * farthest, 1000 * worst);
    EXPECT_GT(farthest, 0.02);
    EXPECT_LT(worst, 0.05 * farthest + 0.002);
    sut.force.setZero();
    sut.press(false);
    ASSERT_TRUE(rests_within(1)) << message();
  }
}

TEST_F(Guiding_by_hand, A_released_switch_lets_the_arm_rest) {
  for (int how = 0; how < 3; ++how) {
    sut.cell.in.mode = {OperatingMode::Manual, true, 0};
    sut.press(false);
    sut.run(0.1);
    ASSERT_TRUE(sut.go(kBent)) << to_string(sut.cell.out.error);
    ASSERT_TRUE(sut.guide()) << message();
    sut.force = {0, 60, 0};
    ASSERT_TRUE(sut.until([&] { return speed() > 10; }, 2));
    if (how == 0) {
      sut.press(false);
    } else if (how == 1) {
      sut.cell.in.mode.enabled = false;
    } else {
      sut.cell.in.mode.mode = OperatingMode::Automatic;
    }
    EXPECT_TRUE(rests_within(0.3)) << how;
    const Joints rest = sut.commanded();
    sut.run(1);
    EXPECT_EQ(sut.commanded(), rest) << how;
    EXPECT_EQ(sut.cell.out.state, GroupState::Standby) << how;
    sut.force.setZero();
  }
}

TEST_F(Guiding_by_hand, A_beat_that_stops_lets_the_arm_rest) {
  sut.cell.in.jog = {};
  sut.run(0.1);
  sut.press();
  std::uint32_t beat = 1;
  const auto beats = [&](double seconds) {
    for (int i = 0; i < seconds / 0.1; ++i) {
      sut.cell.in.jog.beat = ++beat;
      sut.run(0.1);
    }
  };
  beats(1);
  ASSERT_TRUE(sut.cell.out.guided) << message();
  sut.force = {0, 60, 0};
  beats(1);
  EXPECT_GT(speed(), 5);
  EXPECT_TRUE(rests_within(0.6));
}

TEST_F(Guiding_by_hand, Hold_and_override_count) {
  ASSERT_TRUE(sut.guide()) << message();
  sut.cell.in.hold = true;
  sut.force = {0, 60, 0};
  sut.run(1);
  EXPECT_EQ(speed(), 0);
  sut.cell.in.hold = false;
  sut.cell.in.speed_override = 10;
  sut.run(1);
  EXPECT_GT(sut.cell.out.tool_speed, 15);
  EXPECT_LT(sut.cell.out.tool_speed, 25.1);
}

TEST_F(Guiding_by_hand, Motions_and_jobs_are_refused_meanwhile_and_a_stop_ends_it) {
  ASSERT_TRUE(sut.guide()) << message();
  sut.force = {0, 60, 0};
  sut.run(0.5);
  for (const Service service : {Service::DirectAbsolute, Service::LinearAbsolute, Service::DirectAborting,
                                Service::JobStart, Service::GroupHome, Service::SelectTool, Service::JobReload}) {
    sut.cell.ask(service);
    sut.run(0.05);
    EXPECT_EQ(sut.cell.out.error, ErrorCode::State) << static_cast<int>(service);
    EXPECT_TRUE(sut.cell.out.guided);
  }
  sut.cell.ask(Service::Stop);
  sut.run(0.01);
  EXPECT_TRUE(rests_within(0.5));
}

TEST_F(Guiding_by_hand, A_fault_of_a_drive_ends_it) {
  ASSERT_TRUE(sut.guide()) << message();
  sut.force = {0, 60, 0};
  sut.run(0.5);
  sut.cell.in.drives[3].status = Cell::kFault;
  EXPECT_TRUE(sut.until([&] { return sut.cell.out.state == GroupState::ErrorStop; }, 0.5));
  EXPECT_EQ(sut.cell.out.error, ErrorCode::Drive);
  EXPECT_FALSE(sut.cell.out.guided);
}

TEST_F(Guiding_by_hand, It_does_not_begin_with_a_wrong_payload_or_a_hand_that_pushes) {
  sut.held = {3, Vec3(0, 0, 0.1), Mat3::Zero()};
  sut.run(0.5);
  EXPECT_FALSE(sut.guide());
  EXPECT_EQ(sut.cell.out.error, ErrorCode::Contact);
  EXPECT_THAT(message(), HasSubstr("before guiding begins: release it first, or correct TOOL and LOAD"));
  sut.held = {};
  sut.run(1);
  EXPECT_FALSE(sut.cell.out.guided) << "only after the switch was released";
  sut.press(false);
  sut.run(0.1);
  EXPECT_TRUE(sut.guide()) << message();
}

// A part that is taken or lost while the hand guides would let the arm sink or rise.
TEST_F(Guiding_by_hand, A_payload_that_changes_ends_it_before_the_arm_has_moved_far) {
  for (const double more : {3.0, 6.0}) {
    sut.press(false);
    sut.run(0.1);
    ASSERT_TRUE(sut.go(kBent)) << to_string(sut.cell.out.error);
    ASSERT_TRUE(sut.guide()) << message();
    const double height = sut.place(sut.commanded()).p.z();
    sut.held = {more, Vec3(0, 0, 0.03), Mat3::Zero()};
    ASSERT_TRUE(sut.until([&] { return sut.cell.out.state == GroupState::ErrorStop; }, 3));
    EXPECT_EQ(sut.cell.out.error, ErrorCode::Contact);
    EXPECT_THAT(message(), HasSubstr("the arm sinks, since it holds about"));
    fmt::print("{} kg: sunk by {:.0f} mm; {}\n", more, 1000 * (height - sut.place(sut.commanded()).p.z()), message());
    EXPECT_LT(height - sut.place(sut.commanded()).p.z(), 0.2);
    sut.held = {};
    sut.run(1);
    sut.cell.ask(Service::GroupReset);
    ASSERT_TRUE(sut.until([&] { return sut.cell.out.state == GroupState::Standby; }, 2));
  }
}

TEST_F(Guiding_by_hand, Torques_that_stay_the_same_or_are_no_push_of_a_hand_end_it) {
  ASSERT_TRUE(sut.guide()) << message();
  sut.force = {0, 60, 0};
  sut.run(0.5);
  ASSERT_TRUE(sut.cell.out.guided) << message();
  sut.stale = true;
  sut.force.setZero();
  ASSERT_TRUE(sut.until([&] { return sut.cell.out.state == GroupState::ErrorStop; }, 1));
  EXPECT_EQ(sut.cell.out.error, ErrorCode::NoTorque);
  EXPECT_THAT(message(), HasSubstr("the torque that the drive of axis 1 reports has not changed for 0.5 s"));
  sut.stale = false;
  sut.run(1);
  sut.cell.ask(Service::GroupReset);
  ASSERT_TRUE(sut.until([&] { return sut.cell.out.state == GroupState::Standby; }, 2));
  sut.press(false);
  sut.run(0.1);
  ASSERT_TRUE(sut.guide()) << message();
  sut.force = {0, 5000, 0};
  ASSERT_TRUE(sut.until([&] { return sut.cell.out.state == GroupState::ErrorStop; }, 1));
  EXPECT_EQ(sut.cell.out.error, ErrorCode::NoTorque);
  EXPECT_THAT(message(), HasSubstr("is more than a hand can push"));
}

TEST(Guiding, Without_torques_it_is_refused) {
  Cell cell;
  ASSERT_TRUE(cell.serve(Service::GroupEnable));
  cell.in.mode = {OperatingMode::Manual, true, 0};
  cell.in.jog.enabled = true;
  cell.in.jog.frame = JogFrame::Hand;
  ASSERT_TRUE(cell.until([&] { return cell.out.error == ErrorCode::NoTorque; }, 100));
  EXPECT_FALSE(cell.out.guided);
}

TEST(Guiding, Allocates_nothing) {
  GuidedCell::Setup setup =
      GuidedCell::of_cell("TOOL long = POSE 0 0 100 RPY 0 0 0\nKEEPOUT zone = BOX 300 600 -500 900 700 900\n");
  setup.workspace = {-2000, -500, -2000, 2000, 2000, 2000};
  GuidedCell sut(setup);
  ASSERT_TRUE(sut.enable());
  sut.cell.in.service.tool = 1;
  sut.cell.ask(Service::SelectTool);
  sut.run(0.1);
  ASSERT_TRUE(sut.go(kBent)) << to_string(sut.cell.out.error);
  ASSERT_TRUE(sut.guide()) << sut.cell.out.job.message;
  sut.force = {0, 60, 0};
  std::uint64_t allocated = 0;
  for (int i = 0; i < 500; ++i) {
    sut.force.y() = i < 300 ? 60 + i % 5 : -60 - i % 5;
    sut.step();
    const std::uint64_t before = g_allocations;
    sut.cell.step();
    allocated += g_allocations - before;
  }
  EXPECT_TRUE(sut.cell.out.guided) << sut.cell.out.job.message;
  EXPECT_EQ(allocated, 0U);
}

// Pushed into the end of an axis, the arm comes to rest before it, and is pushed away again.
TEST_F(Guiding_by_hand, The_end_of_an_axis_is_a_soft_wall) {
  ASSERT_TRUE(sut.guide()) << message();
  Judge judge(sut.period, sut.setup.arm.urdf);
  for (int k = 0; k < 4; ++k) {
    sut.step();
    static_cast<void>(judge.look(sut.cell, 1));
  }
  sut.moment = {0, 0, 0};
  const auto push_first = [&](double torque) {
    const Vec3 out = Vec3::Map(sut.place(sut.commanded()).p.data);
    sut.force = torque / out.head<2>().norm() * Vec3(-out.y(), out.x(), 0).normalized();
    sut.step();
    ASSERT_EQ(judge.look(sut.cell, 1), "");
  };
  for (int i = 0; i < 12 / sut.period; ++i) {
    push_first(60);
  }
  EXPECT_GT(sut.commanded()[0], 2.967 - 0.02);
  EXPECT_LT(sut.commanded()[0], 2.967);
  EXPECT_TRUE(sut.cell.out.guided) << message();
  for (int i = 0; i < 3 / sut.period; ++i) {
    push_first(-60);
  }
  EXPECT_LT(sut.commanded()[0], 2.6);
}

}  // namespace
}  // namespace indurop::robot
