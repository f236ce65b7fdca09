// SPDX-License-Identifier: Apache-2.0
#include <indurop/robot/controller.h>

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cmath>
#include <cstdio>

#include "group_cell.h"

namespace indurop::robot {
namespace {

TEST(Group, From_disabled_to_a_motion_and_back) {
  Cell cell;
  EXPECT_EQ(cell.out.state, GroupState::Disabled);
  ASSERT_TRUE(cell.serve(Service::GroupEnable));
  EXPECT_EQ(cell.out.state, GroupState::Standby);
  EXPECT_TRUE(cell.out.motion_done);
  cell.in.service.point = 1;
  cell.ask(Service::MoveJoints);
  cell.step();
  cell.step();
  EXPECT_EQ(cell.out.state, GroupState::Moving);
  EXPECT_TRUE(cell.out.busy);
  EXPECT_FALSE(cell.out.motion_done);
  ASSERT_TRUE(cell.until([&] { return !cell.out.busy; }));
  EXPECT_TRUE(cell.out.motion_done);
  EXPECT_EQ(cell.out.done, cell.out.acknowledged);
  EXPECT_NEAR(cell.out.command[0], 20, 1e-9);
  EXPECT_NEAR(cell.in.drives[2].position, -20 * 1320000.0 / 360, 1);
  const AxisNumbers there = cell.out.command;
  for (int i = 0; i < 200; ++i) {
    cell.step();
  }
  EXPECT_EQ(cell.out.command, there);
  EXPECT_EQ(cell.out.axes[0].state, AxisState::Standstill);
  cell.in.service.point = 2;
  ASSERT_TRUE(cell.serve(Service::MoveLine));
  EXPECT_NEAR(cell.out.position[1], 100, 1e-3);
  ASSERT_TRUE(cell.serve(Service::GroupDisable));
  cell.step();
  EXPECT_EQ(cell.out.state, GroupState::Disabled);
  EXPECT_FALSE(cell.until([&] { return cell.in.drives[0].status != Cell::kSwitchOnDisabled; }, 20));
}

TEST(Group, A_request_without_a_number_as_in_the_chapter) {
  Cell cell;
  cell.in.service.code = static_cast<std::int32_t>(Service::GroupEnable);
  cell.in.edit = true;
  ASSERT_TRUE(cell.until([&] { return cell.out.edit_done; }));
  EXPECT_TRUE(cell.out.motion_done);
  EXPECT_EQ(cell.out.state, GroupState::Standby);
  cell.step();
  EXPECT_TRUE(cell.out.edit_done);  // until it is seen
  cell.in.edit = false;
  cell.step();
  EXPECT_FALSE(cell.out.edit_done);
  cell.in.service.code = static_cast<std::int32_t>(Service::DirectAbsolute);
  cell.in.service.target = {10, 0, 0, 0, 0, 0};
  cell.in.edit = true;
  ASSERT_TRUE(cell.until([&] { return cell.out.edit_done; }));
  EXPECT_NEAR(cell.out.command[0], 10, 1e-9);
}

TEST(Group, What_was_asked_for_before_the_start_is_not_done) {
  Cell cell("", 10, 7);
  EXPECT_EQ(cell.out.acknowledged, 7U);
  EXPECT_EQ(cell.out.done, 7U);
  EXPECT_EQ(cell.out.error, ErrorCode::Aborted);
  EXPECT_FALSE(cell.until([&] { return cell.out.state != GroupState::Disabled; }, 50));
  EXPECT_TRUE(cell.serve(Service::GroupEnable));
}

TEST(Group, A_request_that_was_waiting_on_a_silent_board_is_not_a_new_one) {
  Cell cell("", 10, 0, false);
  for (int i = 0; i < 20; ++i) {
    cell.step();
  }
  cell.in.service.number = 57;
  cell.in.axes[0] = {12, static_cast<std::int32_t>(AxisService::PowerOn), 0, 0, 0, 0};
  cell.in.requests_known = true;
  EXPECT_FALSE(cell.until([&] { return cell.out.state != GroupState::Disabled || cell.out.axes[0].power; }, 50));
  EXPECT_EQ(cell.out.acknowledged, 57U);
  EXPECT_EQ(cell.out.axes[0].aborted, 12U);
  EXPECT_TRUE(cell.serve(Service::GroupEnable));
}

TEST(Group, Requests_that_cannot_be_served_say_why) {
  Cell cell;
  EXPECT_FALSE(cell.serve(Service::MoveJoints));
  EXPECT_EQ(cell.out.error, ErrorCode::State);
  EXPECT_FALSE(cell.serve(static_cast<Service>(99)));
  EXPECT_EQ(cell.out.error, ErrorCode::Opcode);
  ASSERT_TRUE(cell.serve(Service::GroupEnable));
  cell.in.service.point = 44;
  EXPECT_FALSE(cell.serve(Service::MoveJoints));
  EXPECT_EQ(cell.out.error, ErrorCode::Point);
  cell.in.service.point = 3;
  EXPECT_FALSE(cell.serve(Service::MoveLine));
  EXPECT_EQ(cell.out.error, ErrorCode::Unreachable);
  EXPECT_EQ(cell.out.state, GroupState::Standby);
  cell.in.service.job = 9;
  EXPECT_FALSE(cell.serve(Service::JobStart));
  EXPECT_EQ(cell.out.error, ErrorCode::Job);
  cell.in.service.target = {0, 0, 0, 0, 170, 0};
  EXPECT_FALSE(cell.serve(Service::DirectAbsolute));
  EXPECT_EQ(cell.out.error, ErrorCode::JointLimit);
  EXPECT_EQ(cell.out.error_axis, 5U);
  EXPECT_EQ(cell.out.state, GroupState::Standby);
}

TEST(Group, Drives_that_take_no_power_are_named) {
  Cell cell;
  cell.stuck = true;
  EXPECT_FALSE(cell.serve(Service::GroupEnable));
  EXPECT_EQ(cell.out.error, ErrorCode::Power);
  EXPECT_EQ(cell.out.error_axis, 1U);
  EXPECT_EQ(cell.out.state, GroupState::Disabled);
}

TEST(Group, A_job_with_signals) {
  Cell cell("SPEED 50%\nMOVJ P1\nSET O8 ON\nWAIT I4 TIMEOUT 5s\nZONE 50\nMOVL P2\nMOVJ P1\nSET O8 OFF\n");
  EXPECT_EQ(cell.sut->signals(), (std::vector<std::string>{"O8", "I4"}));
  ASSERT_TRUE(cell.serve(Service::GroupEnable));
  cell.in.service.job = 1;
  cell.ask(Service::JobStart);
  ASSERT_TRUE(cell.until([&] { return cell.values[0] == 1; }));
  EXPECT_TRUE(cell.out.moving_by_job);
  EXPECT_NEAR(cell.out.command[0], 20, 1e-9);
  cell.values[1] = 1;
  ASSERT_TRUE(cell.until([&] { return cell.out.job.state == JobState::Ended; }));
  EXPECT_EQ(cell.values[0], 0);
  EXPECT_EQ(cell.out.job.cycles, 1U);
  cell.step();
  EXPECT_EQ(cell.out.state, GroupState::Standby);
  EXPECT_TRUE(cell.out.motion_done);
}

TEST(Group, A_job_that_fails_stops_and_names_its_line) {
  Cell cell("MOVJ P1\nMOVL P3\n");
  ASSERT_TRUE(cell.serve(Service::GroupEnable));
  cell.in.service.job = 1;
  EXPECT_FALSE(cell.serve(Service::JobStart));
  EXPECT_EQ(cell.out.job.state, JobState::Failed);
  EXPECT_NE(std::string(cell.out.job.message).find("main.job:5: the target is out of reach"), std::string::npos)
      << cell.out.job.message;
  ASSERT_TRUE(cell.until([&] { return cell.out.state == GroupState::ErrorStop; }));
  EXPECT_FALSE(cell.serve(Service::MoveJoints));
  ASSERT_TRUE(cell.serve(Service::GroupReset));
  EXPECT_EQ(cell.out.state, GroupState::Standby);
}

TEST(Group, Emergency_stop_of_category_0_takes_power_away_at_once) {
  Settings settings;
  settings.emergency_category = StopCategory::Category0;
  Cell cell("", 1, 0, true, settings);
  ASSERT_TRUE(cell.serve(Service::GroupEnable));
  cell.in.service.target = {100, 0, 0, 0, 0, 50};
  cell.ask(Service::DirectAbsolute);
  ASSERT_TRUE(cell.until([&] { return cell.out.path_speed > 90; }));
  cell.in.emergency = true;
  cell.step();
  for (const DriveOut& drive : cell.out.drives) {
    EXPECT_EQ(drive.control, 0x00);
  }
  ASSERT_TRUE(cell.until([&] { return cell.out.state == GroupState::ErrorStop; }));
  EXPECT_EQ(cell.out.error, ErrorCode::Emergency);
  cell.in.emergency = false;
  ASSERT_TRUE(cell.serve(Service::GroupReset));
  EXPECT_EQ(cell.out.state, GroupState::Disabled);
}

TEST(Group, No_power_during_an_emergency) {
  Cell cell;
  cell.in.emergency = true;
  EXPECT_FALSE(cell.serve(Service::GroupEnable));
  EXPECT_EQ(cell.out.error, ErrorCode::Emergency);
  EXPECT_EQ(cell.out.state, GroupState::Disabled);
}

TEST(Group, A_faulty_drive_stops_the_others) {
  Cell cell;
  ASSERT_TRUE(cell.serve(Service::GroupEnable));
  cell.in.service.target = {100, 0, 0, 0, 0, 50};
  cell.ask(Service::DirectAbsolute);
  ASSERT_TRUE(cell.until([&] { return cell.out.path_speed > 99.9; }));
  cell.in.drives[3].status = Cell::kFault;
  cell.step();
  EXPECT_EQ(cell.out.error, ErrorCode::Drive);
  EXPECT_EQ(cell.out.error_axis, 4U);
  double last = cell.out.speed[0];
  ASSERT_TRUE(cell.until([&] {
    EXPECT_LE(cell.out.speed[0], last + 1e-6);
    last = cell.out.speed[0];
    return cell.out.state == GroupState::ErrorStop;
  }));
  EXPECT_EQ(cell.out.error, ErrorCode::Drive);
  ASSERT_TRUE(cell.serve(Service::GroupReset));
  EXPECT_EQ(cell.out.state, GroupState::Disabled);
}

TEST(Group, An_axis_that_does_not_follow_stops_the_group) {
  Cell cell;
  ASSERT_TRUE(cell.serve(Service::GroupEnable));
  cell.in.service.target = {100, 0, 0, 0, 0, 0};
  cell.ask(Service::DirectAbsolute);
  cell.stuck = true;
  ASSERT_TRUE(cell.until([&] { return cell.out.error == ErrorCode::Following; }));
  EXPECT_EQ(cell.out.error_axis, 1U);
}

// It would be an error again in the next period.
TEST(Group, An_axis_that_is_behind_is_not_reset) {
  Cell cell;
  ASSERT_TRUE(cell.serve(Service::GroupEnable));
  cell.in.service.target = {100, 0, 0, 0, 0, 0};
  cell.ask(Service::DirectAbsolute);
  cell.stuck = true;
  ASSERT_TRUE(cell.until([&] { return cell.out.state == GroupState::ErrorStop; }));
  EXPECT_FALSE(cell.serve(Service::GroupReset)) << "it does not come";
  EXPECT_EQ(cell.out.error, ErrorCode::Following);
  EXPECT_EQ(cell.out.error_axis, 1U);
  EXPECT_EQ(cell.out.state, GroupState::ErrorStop);
  cell.ask(Service::GroupReset);
  for (int i = 0; i < 20; ++i) {
    cell.step();
    ASSERT_EQ(cell.out.state, GroupState::ErrorStop) << "it waits";
  }
  cell.stuck = false;
  ASSERT_TRUE(cell.until([&] { return cell.out.done == cell.in.service.number; }));
  for (int i = 0; i < 20; ++i) {
    EXPECT_EQ(cell.out.error, ErrorCode::Ok);
    EXPECT_EQ(cell.out.state, GroupState::Standby);
    cell.step();
  }
}

TEST(Group, What_trips_names_the_line_that_moves) {
  Cell cell("POINT A = JOINT 100 0 0 0 60 0\nPOINT B = JOINT 0 0 0 0 60 0\nMOVJ A\nMOVJ B\nMOVJ A\n", 1);
  ASSERT_TRUE(cell.serve(Service::GroupEnable));
  cell.in.service.job = 1;
  cell.ask(Service::JobStart);
  ASSERT_TRUE(cell.until([&] { return cell.out.job.line == 7 && cell.out.path_speed > 99; }));
  cell.in.emergency = true;
  cell.step();
  EXPECT_EQ(cell.out.job.line, 7U);
  EXPECT_NE(std::string(cell.out.job.message).find(":7: emergency stop"), std::string::npos) << cell.out.job.message;
}

TEST(Group, Hold_and_override_from_outside) {
  Cell cell;
  ASSERT_TRUE(cell.serve(Service::GroupEnable));
  cell.in.service.target = {100, 0, 0, 0, 0, 0};
  cell.ask(Service::DirectAbsolute);
  cell.in.speed_override = 20;
  ASSERT_TRUE(cell.until([&] { return cell.out.path_speed > 19; }));
  EXPECT_LT(cell.out.path_speed, 20.1);
  cell.in.hold = true;
  ASSERT_TRUE(cell.until([&] { return cell.out.path_speed == 0; }));
  EXPECT_EQ(cell.out.state, GroupState::Moving);
  cell.in.hold = false;
  cell.in.speed_override = std::nan("");  // nonsense is no speed
  for (int i = 0; i < 10; ++i) {
    cell.step();
  }
  EXPECT_EQ(cell.out.path_speed, 0);
  cell.in.speed_override = 100;
  ASSERT_TRUE(cell.until([&] { return !cell.out.busy; }));
  EXPECT_NEAR(cell.out.command[0], 100, 1e-9);
}

TEST(Group, Stop_ends_the_motion_and_its_request) {
  Cell cell;
  ASSERT_TRUE(cell.serve(Service::GroupEnable));
  cell.in.service.target = {100, 0, 0, 0, 0, 0};
  cell.ask(Service::DirectAbsolute);
  ASSERT_TRUE(cell.until([&] { return cell.out.path_speed > 30; }));
  ASSERT_TRUE(cell.serve(Service::Stop));
  EXPECT_EQ(cell.out.state, GroupState::Standby);
  EXPECT_LT(cell.out.command[0], 99);
}

TEST(Group, A_reset_waits_until_an_error_stop_has_come_to_rest) {
  Cell cell("", 1);
  ASSERT_TRUE(cell.serve(Service::GroupEnable));
  cell.in.service.target = {100, 0, 0, 0, 0, 50};
  cell.ask(Service::DirectAbsolute);
  ASSERT_TRUE(cell.until([&] { return cell.out.path_speed > 90; }));
  cell.in.emergency = true;
  cell.step();
  cell.in.emergency = false;
  cell.ask(Service::GroupReset);
  cell.step();
  EXPECT_EQ(cell.out.state, GroupState::Stopping);
  EXPECT_EQ(cell.out.error, ErrorCode::Emergency);  // still what it stops for
  ASSERT_TRUE(cell.until([&] { return cell.out.done == cell.in.service.number; }));
  EXPECT_EQ(cell.out.speed, AxisNumbers{});
  EXPECT_EQ(cell.out.error, ErrorCode::Ok);
  for (int i = 0; i < 100; ++i) {
    EXPECT_NE(cell.out.state, GroupState::ErrorStop);
    cell.step();
  }
}

TEST(Group, A_waiting_reset_ends_if_there_is_an_emergency_again) {
  Cell cell("", 1);
  ASSERT_TRUE(cell.serve(Service::GroupEnable));
  cell.in.service.target = {100, 0, 0, 0, 0, 50};
  cell.ask(Service::DirectAbsolute);
  ASSERT_TRUE(cell.until([&] { return cell.out.path_speed > 90; }));
  cell.in.emergency = true;
  cell.step();
  cell.in.emergency = false;
  cell.ask(Service::GroupReset);
  cell.step();
  cell.in.emergency = true;
  ASSERT_TRUE(cell.until([&] { return cell.out.done == cell.in.service.number; }));
  EXPECT_FALSE(cell.out.motion_done);
  EXPECT_EQ(cell.out.error, ErrorCode::Emergency);
  EXPECT_EQ(cell.out.state, GroupState::ErrorStop);
}

TEST(Group, What_is_refused_during_an_error_stop_does_not_hide_why_it_stops) {
  Cell cell("", 1);
  ASSERT_TRUE(cell.serve(Service::GroupEnable));
  cell.in.service.target = {100, 0, 0, 0, 0, 50};
  cell.ask(Service::DirectAbsolute);
  ASSERT_TRUE(cell.until([&] { return cell.out.path_speed > 90; }));
  cell.in.emergency = true;
  cell.step();
  EXPECT_FALSE(cell.serve(Service::MoveJoints));
  EXPECT_EQ(cell.out.error, ErrorCode::Emergency);
  ASSERT_TRUE(cell.until([&] { return cell.out.state == GroupState::ErrorStop; }));
  EXPECT_EQ(cell.out.error, ErrorCode::Emergency);
  EXPECT_EQ(cell.out.drives[0].control, 0x02);  // quick stop
}

TEST(Group, Homing_gives_the_axes_their_zero) {
  Cell cell;
  ASSERT_TRUE(cell.serve(Service::GroupEnable));
  cell.in.service.target = {30, 0, 0, 0, 0, 0};
  ASSERT_TRUE(cell.serve(Service::DirectAbsolute));
  cell.ask(Service::GroupHome);
  cell.step();
  EXPECT_EQ(cell.out.state, GroupState::Homing);
  ASSERT_TRUE(cell.until([&] { return cell.out.state == GroupState::Standby; }));
  cell.step();
  EXPECT_NEAR(cell.out.joints[0], 0, 1e-9);
  EXPECT_EQ(cell.out.drives[0].mode, 8);
}

TEST(Load, Everything_that_is_wrong_is_said) {
  Settings settings;
  settings.urdf = "nowhere.urdf";
  settings.jobs = {"nowhere.job"};
  settings.tool_speed = -1;
  settings.emergency_category = StopCategory::Category2;
  std::vector<std::string> errors;
  EXPECT_EQ(Controller::load(settings, errors), nullptr);
  ASSERT_EQ(errors.size(), 4U);
  EXPECT_EQ(errors[0], "property tool_speed: error: it has to be above 0");
  EXPECT_EQ(errors[1], "property emergency_category: error: it has to be 0 or 1, an emergency stop takes power away");
  EXPECT_EQ(errors[2],
            "nowhere.urdf:1:1: error: this robot description (property urdf) cannot be read; names begin at the "
            "folder of the module.xml");
}

TEST(Load, A_pipe_in_place_of_a_file_is_refused_at_once) {
  const std::string pipe = ::testing::TempDir() + "indurop-robot-" + std::to_string(::getpid());
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  Settings settings;
  settings.urdf = pipe;
  std::vector<std::string> errors;
  EXPECT_EQ(Controller::load(settings, errors), nullptr);
  ::unlink(pipe.c_str());
  ASSERT_FALSE(errors.empty());
  EXPECT_EQ(errors[0],
            pipe +
                ":1:1: error: this robot description (property urdf) cannot be read: it is a pipe, not a file; "
                "names begin at the folder of the module.xml");
}

}  // namespace
}  // namespace indurop::robot
