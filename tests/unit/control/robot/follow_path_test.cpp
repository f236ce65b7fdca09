// SPDX-License-Identifier: Apache-2.0
// A single axis follows the way of the tool (MC_SyncAxisToGroup), and single axes as such.
#include <gmock/gmock.h>

#include "synced_cell.h"

namespace indurop::robot {
namespace {

class FollowPath : public testing::Test, public SyncedCell {
 protected:
  void SetUp() override { ASSERT_TRUE(start()); }
};

TEST_F(FollowPath, Is_a_part_of_the_way_of_the_tool_from_rest_on) {
  ASSERT_TRUE(go_to_begin());
  const Given sut = follow(3, 2);
  ASSERT_TRUE(until([&] { return reached(sut); }));
  const double from = cell.out.command[kAt];
  const double way_before = way;
  line(500, -100, 400, 250);
  line(600, -100, 400, 250, BufferMode::BlendingLow, 30);
  const Given last = line(600, -100, 300, 250);
  ASSERT_TRUE(until([&] {
    EXPECT_TRUE(reached(sut));
    EXPECT_NEAR(cell.out.command[kAt] - from, 1.5 * (way - way_before), 1e-4);
    return ended(last);
  }));
  EXPECT_EQ(state(last), CommandState::Done);
  EXPECT_GT(way - way_before, 350);
  EXPECT_EQ(axis(kAt), AxisState::SynchronizedMotion);
  EXPECT_EQ(state(sut), CommandState::Active);
}

TEST_F(FollowPath, Comes_in_step_softly_while_the_tool_moves) {
  ASSERT_TRUE(go_to_begin());
  const Given last = line(500, -400, 400, 400);
  ASSERT_TRUE(until([&] { return gone > 3.9; }));
  const Given sut = follow(-1);
  command(sut).acceleration = 3000;
  double before = fed;
  ASSERT_TRUE(until([&] {
    EXPECT_LE(std::abs(fed - before), 3000 * 0.01 * 0.01 * 1.01);
    before = fed;
    return reached(sut);
  }));
  for (; !ended(last) && !HasFailure(); step()) {
    EXPECT_TRUE(cell.periods % 5 != 0 || reached(sut));
  }
  EXPECT_EQ(axis(kAt), AxisState::SynchronizedMotion);
  const Given next = give(kFeeder, AxisService::MoveAbsolute, 10);
  EXPECT_TRUE(until([&] { return ended(next); }));
  EXPECT_EQ(state(sut), CommandState::Aborted);
  EXPECT_NEAR(cell.out.command[kAt], 10, 1e-6);
}

TEST_F(FollowPath, Holds_and_stops_with_the_tool) {
  ASSERT_TRUE(go_to_begin());
  const Given sut = follow(1);
  const Given last = line(500, -300, 400, 300);
  ASSERT_TRUE(until([&] { return gone > 2.9; }));
  cell.in.hold = true;
  ASSERT_TRUE(until([&] { return gone == 0; }));
  EXPECT_NEAR(fed, 0, 1e-9);
  EXPECT_TRUE(reached(sut));
  cell.in.hold = false;
  ASSERT_TRUE(until([&] { return gone > 2.9; }));
  const Given halt = give(Service::Halt);
  ASSERT_TRUE(until([&] {
    EXPECT_NEAR(fed, gone, 1e-6);
    return ended(halt);
  }));
  EXPECT_EQ(state(last), CommandState::Aborted);
  EXPECT_TRUE(reached(sut));
}

TEST_F(FollowPath, Ends_when_the_arm_has_no_power_or_fails) {
  EXPECT_TRUE(cell.serve(Service::GroupDisable));
  const Given none = follow(1);
  step();
  EXPECT_EQ(error(none), ErrorCode::Master);
  ASSERT_TRUE(cell.serve(Service::GroupEnable));
  ASSERT_TRUE(go_to_begin());
  const Given sut = follow(1);
  line(500, -300, 400, 300);
  ASSERT_TRUE(until([&] { return gone > 2.9; }));
  cell.in.drives[2].status = Cell::kFault;
  ASSERT_TRUE(until([&] { return ended(sut); }));
  EXPECT_EQ(error(sut), ErrorCode::Master);
  EXPECT_TRUE(until([&] { return axis(kAt) == AxisState::Standstill && cell.out.state == GroupState::ErrorStop; }));
}

TEST_F(FollowPath, Rejects_what_makes_no_sense) {
  for (const auto& [numerator, denominator] : {std::pair(1.0, 0.0), std::pair(HUGE_VAL, 1.0), std::pair(1e9, 1.0)}) {
    const Given sut = follow(numerator, denominator);
    step();
    EXPECT_EQ(error(sut), ErrorCode::Value);
  }
  const Given of_arm = give(2, AxisService::FollowPath, 1);
  command(of_arm).to[1] = 1;
  step();
  EXPECT_EQ(error(of_arm), ErrorCode::Value) << "an axis of the arm cannot follow the arm";
}

TEST_F(FollowPath, Moves_while_the_group_does_and_fails_alone) {
  ASSERT_TRUE(go_to_begin());
  const Given last = line(500, -300, 400, 100);
  ASSERT_TRUE(until([&] { return gone > 0.9; }));
  const Given own = give(kFeeder, AxisService::MoveAbsolute, 300);
  ASSERT_TRUE(until([&] { return ended(own); }));
  EXPECT_EQ(state(own), CommandState::Done);
  cell.in.drives[kAt].status = Cell::kFault;
  step();
  EXPECT_EQ(axis(kAt), AxisState::ErrorStop);
  EXPECT_EQ(cell.out.state, GroupState::Moving);
  ASSERT_TRUE(until([&] { return ended(last); }));
  EXPECT_EQ(state(last), CommandState::Done);
  const Given reset = give(kFeeder, AxisService::Reset);
  EXPECT_TRUE(until([&] { return ended(reset); }));
  EXPECT_EQ(axis(kAt), AxisState::Disabled);
}

TEST_F(FollowPath, Stops_for_an_emergency_and_loses_its_power_at_rest) {
  const Given own = give(kFeeder, AxisService::MoveVelocity, 0, 2000);
  ASSERT_TRUE(until([&] { return reached(own); }));
  cell.in.emergency = true;
  step(kEmergency);
  EXPECT_EQ(error(own), ErrorCode::Emergency);
  ASSERT_TRUE(until([&] { return cell.in.drives[kAt].status != 0x27; }, 200, kEmergency));
  EXPECT_LT(std::abs(fed), 1e-6) << "it braked before";
  const Given early = give(kFeeder, AxisService::Reset);
  step();
  EXPECT_EQ(error(early), ErrorCode::Emergency);
  cell.in.emergency = false;
  const Given reset = give(kFeeder, AxisService::Reset);
  ASSERT_TRUE(until([&] { return ended(reset); }));
  EXPECT_EQ(axis(kAt), AxisState::Disabled);
  const Given power = give(kFeeder, AxisService::PowerOn);
  ASSERT_TRUE(until([&] { return ended(power); }));
  EXPECT_EQ(axis(kAt), AxisState::Standstill);
}

TEST_F(FollowPath, Moves_in_manual_mode_only_with_the_enabling_device) {
  cell.in.mode = {OperatingMode::Manual, true, 0};
  step();
  const Given own = give(kFeeder, AxisService::MoveVelocity, 0, 2000);
  ASSERT_TRUE(until([&] { return fed > 0.48; }));
  EXPECT_LE(fed, 0.5) << "as slow as 250 mm/s would be at full speed";
  cell.in.mode.enabled = false;
  ASSERT_TRUE(until([&] { return ended(own) && fed == 0; }));
  const Given no = give(kFeeder, AxisService::MoveVelocity, 0, 2000);
  step();
  EXPECT_EQ(error(no), ErrorCode::Enabling);
}

class SlowFeeder : public testing::Test, public SyncedCell {
 protected:
  SlowFeeder() : SyncedCell(10, 0.3, "-1 0.3") {}
};

TEST_F(SlowFeeder, Leaves_a_tool_that_is_too_fast_for_it_and_stops_before_its_end) {
  ASSERT_TRUE(start());
  ASSERT_TRUE(go_to_begin());
  const Given first = follow(0.2);
  const Given slow = line(500, 50, 400, 100);
  ASSERT_TRUE(until([&] { return ended(slow); }));
  EXPECT_TRUE(reached(first) && !ended(first));
  const Given sut = follow(1);
  ASSERT_TRUE(until([&] { return reached(sut); }));
  const Given fast = line(500, -300, 400, 900);
  ASSERT_TRUE(until([&] { return ended(sut); }));
  EXPECT_THAT(error(sut), testing::AnyOf(ErrorCode::Speed, ErrorCode::Acceleration, ErrorCode::Jerk));
  ASSERT_TRUE(until([&] { return ended(fast); }));
  EXPECT_EQ(state(fast), CommandState::Done) << "the tool goes on";
  const Given home = give(kFeeder, AxisService::MoveAbsolute, 270);
  ASSERT_TRUE(until([&] { return ended(home); }));
  const Given again = follow(0.1);
  ASSERT_TRUE(until([&] { return reached(again); }));
  const Given far = line(500, 300, 400, 100);
  ASSERT_TRUE(until([&] { return ended(again); }));
  ASSERT_TRUE(until([&] { return ended(far); }, 4000));
  EXPECT_EQ(error(again), ErrorCode::JointLimit);
  EXPECT_LE(cell.out.command[kAt], 300);
}

TEST(SingleAxesOfUrdf, Are_checked) {
  const std::string arm = cell_spec().urdf();
  const auto error_of = [&](const std::string& element) {
    std::string text = with_feeder(arm);
    text.replace(text.find("<single_axes"), std::string(R"(<single_axes joints="feeder"/>)").size(), element);
    const auto read = arm_from_urdf("arm.urdf", text);
    return read ? std::string() : base::to_text(read.error());
  };
  EXPECT_EQ(error_of(R"(<single_axes joints="feeder"/>)"), "");
  EXPECT_THAT(error_of(R"(<single_axes joints="feder"/>)"), testing::HasSubstr("names 'feder', which is no"));
  EXPECT_THAT(error_of(R"(<single_axes joints="feeder feeder"/>)"), testing::HasSubstr("'feeder' is an axis already"));
  EXPECT_THAT(error_of(R"(<single_axes/>)"), testing::HasSubstr("names no joint"));
  EXPECT_THAT(error_of(R"(<single_axes joints="feeder"/><single_axes joints="feeder"/>)"),
              testing::HasSubstr("there is one <single_axes> already"));
}

}  // namespace
}  // namespace indurop::robot
