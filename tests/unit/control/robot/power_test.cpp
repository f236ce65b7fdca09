// SPDX-License-Identifier: Apache-2.0
// Drives that answer late, each in its own time, as those on a field bus do: requests of power and its
// release at any instant get the true state.
#include <gtest/gtest.h>
#include <indurop/robot/controller.h>

#include <deque>
#include <random>

#include "drive_answer.h"
#include "robot_fixture.h"

namespace indurop::robot {
namespace {

class NoSignals final : public Signals {
 public:
  double read(std::size_t /*index*/) noexcept override { return 0; }
  void write(std::size_t /*index*/, double /*value*/) noexcept override {}
};

// CiA 402, seen through a bus that takes some periods each way.
class LateDrive {
 public:
  explicit LateDrive(std::size_t late) : commands_(late, DriveOut{}), says_(late, DriveIn{0, 0x40}) {}
  DriveIn step(const DriveOut& out) {
    commands_.push_back(out);
    const DriveOut now = commands_.front();
    commands_.pop_front();
    const unsigned control = now.control & 0x0FU;
    in_.status = test::next_status(in_.status, control);
    in_.mode = now.mode;
    in_.position = in_.status == 0x27 ? now.position : in_.position;
    says_.push_back(in_);
    const DriveIn said = says_.front();
    says_.pop_front();
    return said;
  }

 private:
  std::deque<DriveOut> commands_;
  std::deque<DriveIn> says_;
  DriveIn in_{0, 0x40};
};

// A group whose drives are up to five periods away.
class LateGroup {
 public:
  explicit LateGroup(std::mt19937& random)
      : sut_(controller_of(cell_urdf(), "POINT A = JOINT 0 0 0 0 60 0\nMOVJ A\n")) {
    for (std::size_t i = 0; i < kJoints; ++i) {
      drives_.emplace_back(random() % 6);
    }
    in.requests_known = true;
    for (DriveIn& drive : in.drives) {
      drive.status = 0x40;
    }
    step();
  }
  void step() {
    sut_->step(in, signals_, out);
    for (std::size_t i = 0; i < kJoints; ++i) {
      in.drives[i] = drives_[i].step(out.drives[i]);
    }
  }

  Inputs in;
  Outputs out;

 private:
  std::unique_ptr<Controller> sut_;
  NoSignals signals_;
  std::vector<LateDrive> drives_;
};

TEST(Power, Late_drives_are_not_taken_for_what_they_were) {
  std::mt19937 random(4);
  int enabled = 0;
  for (int run = 0; run < 40; ++run) {
    LateGroup sut(random);
    for (int k = 0; k < 60; ++k) {
      const bool on = random() % 2 == 0;
      sut.in.service.code = static_cast<std::int32_t>(on ? Service::GroupEnable : Service::GroupDisable);
      sut.in.service.number = sut.out.acknowledged + 1;
      for (int i = 0; i < 300 && sut.out.done != sut.in.service.number; ++i) {
        sut.step();
      }
      ASSERT_EQ(sut.out.done, sut.in.service.number);
      ASSERT_EQ(sut.out.error, ErrorCode::Ok) << to_string(sut.out.error);
      enabled += on ? 1 : 0;
      for (auto wait = random() % 30 + 1; wait > 0; --wait) {
        ASSERT_EQ(sut.out.state, on ? GroupState::Standby : GroupState::Disabled) << to_string(sut.out.error);
        sut.step();
      }
    }
  }
  EXPECT_GT(enabled, 500);
}

TEST(Power, Nor_are_those_of_single_axes) {
  std::mt19937 random(5);
  int enabled = 0;
  for (int run = 0; run < 40; ++run) {
    LateGroup sut(random);
    const std::size_t axis = random() % 6;
    const AxisReport& report = sut.out.axes[axis];
    for (int k = 0; k < 60; ++k) {
      const bool on = random() % 2 == 0;
      sut.in.axes[axis] = {report.acknowledged + 1,
                           static_cast<std::int32_t>(on ? AxisService::PowerOn : AxisService::PowerOff),
                           0,
                           0,
                           0,
                           0};
      const std::uint32_t number = sut.in.axes[axis].number;
      for (int i = 0; i < 300 && report.done != number && report.aborted != number; ++i) {
        sut.step();
      }
      ASSERT_EQ(report.done, number) << to_string(report.error);
      enabled += on ? 1 : 0;
      for (auto wait = random() % 30 + 1; wait > 0; --wait) {
        ASSERT_EQ(report.power, on);
        ASSERT_EQ(report.state, on ? AxisState::Standstill : AxisState::Disabled) << to_string(report.error);
        sut.step();
      }
    }
  }
  EXPECT_GT(enabled, 500);
}

// As simple simulators do: half a second, then it has what it asks for.
TEST(Power, A_drive_that_never_switches_off_has_power) {
  const auto sut = controller_of(cell_urdf(), "POINT A = JOINT 0 0 0 0 60 0\nMOVJ A\n");
  NoSignals signals;
  Inputs in;
  Outputs out;
  in.requests_known = true;
  for (DriveIn& drive : in.drives) {
    drive = {0, 0x27, 8};
  }
  sut->step(in, signals, out);
  in.service.code = static_cast<std::int32_t>(Service::GroupEnable);
  in.service.number = out.acknowledged + 1;
  int periods = 0;
  for (; periods < 1000 && out.done != in.service.number; ++periods) {
    sut->step(in, signals, out);
  }
  EXPECT_EQ(out.state, GroupState::Standby) << to_string(out.error);
  EXPECT_LE(periods, 60);
}

TEST(Power, Nor_does_one_of_a_single_axis) {
  const auto sut = controller_of(cell_urdf(), "POINT A = JOINT 0 0 0 0 60 0\nMOVJ A\n");
  NoSignals signals;
  Inputs in;
  Outputs out;
  in.requests_known = true;
  for (DriveIn& drive : in.drives) {
    drive = {0, 0x27, 8};
  }
  sut->step(in, signals, out);
  in.axes[2] = {out.axes[2].acknowledged + 1, static_cast<std::int32_t>(AxisService::PowerOn), 0, 0, 0, 0};
  for (int i = 0; i < 1000 && out.axes[2].done != in.axes[2].number; ++i) {
    sut->step(in, signals, out);
  }
  EXPECT_EQ(out.axes[2].done, in.axes[2].number);
  EXPECT_EQ(out.drives[2].control, 0x0F);
  EXPECT_TRUE(out.axes[2].power);
}

}  // namespace
}  // namespace indurop::robot
