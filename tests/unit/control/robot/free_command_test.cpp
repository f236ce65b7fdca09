// SPDX-License-Identifier: Apache-2.0
// Free motions by commands, as the block RobotMoveFree gives them: what is rejected, and what ends or replaces a
// search.
#include <gtest/gtest.h>

#include <cmath>

#include "free_command_cell.h"

namespace indurop::robot {
namespace {

using Place = std::array<double, 8>;

constexpr Place kLeft{90, 45, 0, 0, 60, 0}, kRight{-90, 45, 0, 0, 60, 0};
// Two halves that no way connects: a wall with a hole that holds the column of the arm, and no more.
const char* const kWall =
    "KEEPOUT front = BOX 210 -20 0 1500 20 3000\nKEEPOUT back = BOX -1500 -20 0 -210 20 3000\n"
    "KEEPOUT above = BOX -210 -20 700 210 20 3000\n";

class Free_command_rules : public Free_command {
 protected:
  // The search does not end.
  Given search(double within = 0) {
    plans_are_ready() = false;
    const Given given = free(kRight, 0, 0, BufferMode::Aborting, CoordSystem::Axes, within);
    step(50);
    EXPECT_EQ(sut->state(given), CommandState::Waits);
    EXPECT_EQ(out().state, GroupState::Moving);
    return given;
  }
  // Whether nothing has moved, and nothing does once the thread has its path.
  void expect_still_left(const Given& given, CommandState state, ErrorCode code) {
    EXPECT_EQ(sut->state(given), state);
    EXPECT_EQ(sut->error(given), code);
    for (const bool ready : {false, true}) {
      plans_are_ready() = ready;
      step(200);
      EXPECT_EQ(out().command[0], 90);
    }
  }
  [[nodiscard]] ErrorCode refused(const Given& given) {
    step();
    EXPECT_EQ(sut->state(given), CommandState::Error);
    return sut->error(given);
  }
  Given with(double seed, double within) {
    return free(kRight, seed, 0, BufferMode::Aborting, CoordSystem::Axes, within);
  }
  void expect_at(const Place& place) {
    for (std::size_t i = 0; i < 6; ++i) {
      EXPECT_NEAR(out().command[i], place[i], 1e-6);
    }
  }
};

TEST_F(Free_command_rules, Is_active_when_its_search_has_ended) {
  begin("", kLeft);
  const Given given = search();
  EXPECT_EQ(out().command[0], 90);
  plans_are_ready() = true;
  step(3);
  EXPECT_EQ(sut->state(given), CommandState::Active);
  EXPECT_EQ(end_of(given), CommandState::Done);
  expect_at(kRight);
  EXPECT_EQ(out().state, GroupState::Standby);
}

TEST_F(Free_command_rules, Is_rejected_with_the_reason_where_there_is_no_way) {
  begin(kWall, kLeft);
  const Given given = free(kRight);
  const Given behind = free(kLeft, 0, 0, BufferMode::Buffered);
  EXPECT_EQ(end_of(given), CommandState::Error);
  EXPECT_EQ(sut->error(given), ErrorCode::NoWay);
  EXPECT_EQ(sut->state(behind), CommandState::Aborted);
  step();
  const std::string message = out().job.message;
  EXPECT_EQ(message.find("no way found in 5000 tries, mostly because of link '"), 0U) << message;
  EXPECT_EQ(out().state, GroupState::Standby);
  EXPECT_EQ(out().command[0], 90);
}

TEST_F(Free_command_rules, Gives_up_when_its_time_is_up) {
  begin("", kLeft);
  plans_are_ready() = false;
  const int begun = sut->cell.periods;
  const Given given = with(0, 0.4);
  EXPECT_EQ(end_of(given), CommandState::Error);
  EXPECT_NEAR(sut->cell.periods - begun, 100, 3);
  step();
  EXPECT_STREQ(out().job.message, to_string(ErrorCode::NoWay));
  expect_still_left(given, CommandState::Error, ErrorCode::NoWay);
}

TEST_F(Free_command_rules, Has_ten_seconds_if_it_does_not_say_how_many) {
  begin("", kLeft);
  plans_are_ready() = false;
  const int begun = sut->cell.periods;
  EXPECT_EQ(end_of(free(kRight)), CommandState::Error);
  EXPECT_NEAR(sut->cell.periods - begun, 2500, 3);
}

TEST_F(Free_command_rules, Tells_why_its_target_is_not_possible) {
  begin("KEEPOUT post = CYLINDER 0 -500 0 0 -500 900 RADIUS 100\n", kLeft);
  const Given touches = free(kRight);
  EXPECT_EQ(end_of(touches), CommandState::Error);
  EXPECT_EQ(sut->error(touches), ErrorCode::Collision);
  step();
  EXPECT_NE(std::string(out().job.message).find("and zone 'post' would touch"), std::string::npos);
  const Given far = free({3000, 0, 400, 180, 0, 180}, 0, 0, BufferMode::Aborting, CoordSystem::Machine);
  EXPECT_EQ(end_of(far), CommandState::Error);
  EXPECT_EQ(sut->error(far), ErrorCode::Unreachable);
  const Given beyond = free({0, 300, 0, 0, 0, 0});
  EXPECT_EQ(end_of(beyond), CommandState::Error);
  EXPECT_EQ(sut->error(beyond), ErrorCode::JointLimit);
}

TEST_F(Free_command_rules, Rejects_what_it_does_not_do) {
  begin("", kLeft);
  for (const BufferMode mode : {BufferMode::BlendingLow, BufferMode::BlendingPrevious, BufferMode::BlendingNext,
                                BufferMode::BlendingHigh, static_cast<BufferMode>(6)}) {
    EXPECT_EQ(refused(free(kRight, 0, 0, mode)), ErrorCode::Value);
  }
  for (const double seed : {-1.0, 0.5, 4294967296.0, std::nan("")}) {
    EXPECT_EQ(refused(with(seed, 1)), ErrorCode::Value) << seed;
  }
  for (const double within : {-0.001, 600.001, double{INFINITY}}) {
    EXPECT_EQ(refused(with(0, within)), ErrorCode::Value) << within;
  }
  for (const double velocity : {-1.0, 100.1}) {
    EXPECT_EQ(refused(free(kRight, 0, velocity)), ErrorCode::Value) << velocity;
  }
  Given given = with(0, 1);
  sut->command(given).acceleration = 10;
  EXPECT_EQ(refused(given), ErrorCode::Value);
  given = with(0, 1);
  sut->command(given).transition = 10;
  EXPECT_EQ(refused(given), ErrorCode::Value);
  EXPECT_EQ(out().state, GroupState::Standby);
  EXPECT_EQ(end_of(with(4294967295.0, 600)), CommandState::Done);
}

TEST_F(Free_command_rules, Keeps_the_motion_in_progress_if_its_numbers_are_wrong) {
  begin("", kLeft);
  const Given given = free(kRight, 0, 50);
  while (sut->state(given) != CommandState::Active || stands()) {
    step();
  }
  EXPECT_EQ(refused(with(-1, 1)), ErrorCode::Value);
  EXPECT_EQ(end_of(given), CommandState::Done);
  expect_at(kRight);
}

TEST_F(Free_command_rules, A_stop_ends_the_search) {
  begin("", kLeft);
  const Given given = search();
  const Given stop = sut->give(Service::Stop);
  step(2);
  EXPECT_EQ(sut->state(stop), CommandState::Done);
  EXPECT_EQ(out().state, GroupState::Stopping);
  EXPECT_EQ(refused(free(kRight)), ErrorCode::State);
  expect_still_left(given, CommandState::Aborted, ErrorCode::Ok);
  sut->command(stop).execute = 0;
  step();
  EXPECT_EQ(end_of(free(kRight)), CommandState::Done);
}

TEST_F(Free_command_rules, A_halt_ends_the_search) {
  begin("", kLeft);
  const Given given = search();
  const Given halt = sut->give(Service::Halt);
  step(2);
  EXPECT_EQ(sut->state(halt), CommandState::Done);
  expect_still_left(given, CommandState::Aborted, ErrorCode::Ok);
  EXPECT_EQ(out().state, GroupState::Standby);
}

TEST_F(Free_command_rules, Switching_the_power_off_ends_the_search) {
  begin("", kLeft);
  const Given given = search();
  EXPECT_EQ(end_of(sut->give(Service::GroupDisable)), CommandState::Done);
  EXPECT_EQ(out().state, GroupState::Disabled);
  expect_still_left(given, CommandState::Aborted, ErrorCode::Ok);
  EXPECT_EQ(end_of(sut->give(Service::GroupEnable)), CommandState::Done);
  EXPECT_EQ(out().command[0], 90);
  EXPECT_EQ(end_of(free(kRight)), CommandState::Done);
}

TEST_F(Free_command_rules, Lost_power_a_fault_and_an_emergency_stop_end_the_search) {
  for (const ErrorCode code : {ErrorCode::Power, ErrorCode::Drive, ErrorCode::Following, ErrorCode::Emergency}) {
    SCOPED_TRACE(static_cast<int>(code));
    begin("", kLeft);
    const Given given = search();
    DriveIn& drive = sut->cell.in.drives[1];
    if (code == ErrorCode::Power) {
      drive.status = Cell::kSwitchOnDisabled;
    } else if (code == ErrorCode::Drive) {
      drive.status = Cell::kFault;
    } else if (code == ErrorCode::Following) {
      sut->cell.stuck = true;  // as by a force of what the drive reports
      drive.position += static_cast<std::int32_t>(60 * kCounts);
    } else {
      sut->cell.in.emergency = true;
    }
    step();
    expect_still_left(given, CommandState::Error, code);
    EXPECT_EQ(out().state, GroupState::ErrorStop);
  }
}

TEST_F(Free_command_rules, A_hold_and_an_interruption_keep_it) {
  begin("", kLeft);
  const Given given = search();
  const Given hold = sut->give(Service::Interrupt);
  step(2);
  EXPECT_EQ(sut->state(hold), CommandState::Done);
  expect_still_left(given, CommandState::Waits, ErrorCode::Ok);
  sut->cell.in.hold = true;
  sut->give(Service::Continue);
  step(200);
  EXPECT_EQ(sut->state(given), CommandState::Active);
  EXPECT_EQ(out().command[0], 90);
  sut->cell.in.hold = false;
  EXPECT_EQ(end_of(given), CommandState::Done);
  expect_at(kRight);
}

TEST_F(Free_command_rules, Another_motion_replaces_the_search) {
  const Place near{80, 45, 0, 0, 60, 0};
  begin("", kLeft);
  for (const bool direct : {true, false}) {
    const Given given = search();
    const Given other = direct ? sut->give(Service::DirectAbsolute, near) : free(near, 3);
    step(2);
    EXPECT_EQ(sut->state(given), CommandState::Aborted);
    plans_are_ready() = true;
    EXPECT_EQ(end_of(other), CommandState::Done);
    expect_at(near);
    EXPECT_EQ(end_of(free(kLeft)), CommandState::Done);
  }
}

TEST_F(Free_command_rules, Replaces_a_motion_from_where_that_comes_to_rest) {
  begin("", kLeft);
  const Given direct = sut->give(Service::DirectAbsolute, {0, 45, 0, 0, 60, 0}, 50);
  while (out().command[0] > 70) {
    step();
  }
  const Given given = free(kRight);
  step();
  EXPECT_EQ(sut->state(direct), CommandState::Aborted);
  EXPECT_EQ(end_of(given), CommandState::Done);
  expect_at(kRight);
}

TEST_F(Free_command_rules, Is_buffered_between_motions_and_stops_at_both_ends) {
  begin("", kLeft);
  const Given before = sut->give(Service::DirectAbsolute, {60, 45, 0, 0, 60, 0});
  const Given given = free(kRight, 0, 0, BufferMode::Buffered);
  const Given after =
      sut->give(Service::DirectAbsolute, {-60, 45, 0, 0, 60, 0}, 0, BufferMode::BlendingNext, CoordSystem::Axes, 50);
  EXPECT_EQ(end_of(before), CommandState::Done);
  EXPECT_NEAR(out().command[0], 60, 0.01);
  EXPECT_EQ(end_of(given), CommandState::Done);
  EXPECT_NEAR(out().command[0], -90, 0.01);
  EXPECT_EQ(end_of(after), CommandState::Done);
  EXPECT_NEAR(out().command[0], -60, 1e-6);
}

TEST_F(Free_command_rules, Does_not_disturb_a_job_nor_a_job_the_search) {
  begin("POINT R = JOINT -90 45 0 0 60 0\nMOVJ R\n", kLeft);
  sut->cell.in.service.job = 1;
  sut->cell.ask(Service::JobStart);
  step(100);
  EXPECT_EQ(refused(free(kLeft)), ErrorCode::State);
  while (out().done != sut->cell.in.service.number) {
    step();
  }
  expect_at(kRight);
  plans_are_ready() = false;
  const Given given = free(kLeft);
  step(20);
  sut->cell.ask(Service::JobStart);
  step(2);
  EXPECT_EQ(out().done, sut->cell.in.service.number);
  EXPECT_EQ(out().error, ErrorCode::State);
  Given job = sut->give(Service::JobStart);
  sut->command(job).job = 1;
  EXPECT_EQ(refused(job), ErrorCode::State);
  plans_are_ready() = true;
  EXPECT_EQ(end_of(given), CommandState::Done);
  expect_at(kLeft);
}

// The product's coordinates stand still, or move with a belt, which would move the path that is proven clear.
TEST_F(Free_command_rules, Knows_coordinates_of_a_product_that_stands_still) {
  begin("", kLeft);
  const Place to{0, 0, 300, 180, 0, 180};
  EXPECT_EQ(end_of(sut->give(Service::SetTransform, {0, -500, 100, 0, 0, 0})), CommandState::Done);
  EXPECT_EQ(end_of(free(to, 0, 0, BufferMode::Aborting, CoordSystem::Product)), CommandState::Done);
  step();
  EXPECT_NEAR(out().position[0], 0, 0.01);
  EXPECT_NEAR(out().position[1], -500, 0.01);
  EXPECT_NEAR(out().position[2], 400, 0.01);
  for (int i = 0; i < 200; ++i) {
    sut->cell.in.belts[0].beat = static_cast<std::uint32_t>(i + 1);
    step();
  }
  const Given track = sut->give(Service::TrackBelt, {0, -500, 100, 0, 0, 0});
  sut->command(track).option = 1;
  step();
  EXPECT_EQ(sut->state(track), CommandState::Done);
  EXPECT_EQ(refused(free(to, 0, 0, BufferMode::Aborting, CoordSystem::Product)), ErrorCode::State);
  EXPECT_EQ(end_of(free(kLeft)), CommandState::Done);
}

}  // namespace
}  // namespace indurop::robot
