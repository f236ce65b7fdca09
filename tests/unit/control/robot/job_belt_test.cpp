// SPDX-License-Identifier: Apache-2.0
// Jobs whose points move with a belt or a table: where the tip is by orocos-kdl, seen from where the product really is,
// and what ends such motions. Every set point is judged.
#include <gmock/gmock.h>

#include "control/robot/job/job.h"
#include "job_belt_cell.h"

namespace indurop::robot {
namespace {

using testing::HasSubstr;

constexpr double kNear = 0.3;  // mm

const std::string kPlaces =
    "FRAME conveyor = POSE 450 -150 250 RPY 0 0 90\nFRAME part = POSE 450 -150 250 RPY 0 0 90\n"
    "FRAME table = POSE 400 0 250 RPY 0 0 0\nFRAME cake = POSE 500 0 250 RPY 0 0 0\n"
    "POINT ABOVE = POSE 0 0 80 RPY 180 0 180 IN part\nPOINT PICK = POSE 0 0 20 RPY 180 0 180 IN part\n"
    "POINT NEXT = POSE 60 30 80 RPY 180 0 180 IN part\nPOINT ROUND = POSE 60 0 80 RPY 180 0 180 IN part\n"
    "POINT TOP = POSE 0 0 60 RPY 180 0 180 IN cake\nPOINT EDGE = POSE 0 40 60 RPY 180 0 180 IN cake\n"
    "POINT P2 = POSE 500 100 400 RPY 180 0 180\nPOINT BIN = POSE 400 200 400 RPY 180 0 180\n";
const std::string kBegin = kPlaces + "MOVJ BIN\nWAIT 0.5s\nSET STEP = 1\nTRACK part ON BELT 1 ALONG conveyor\n";

class Job_belts : public JobOnBelt<Belts> {
 protected:
  void begin(const std::string& job, double speed, bool turns = false) {
    belt = [speed](double at) { return speed * at; };
    table = turns;
    origin = frame_of(turns ? Eight{400, 0, 250, 0, 0, 0} : kAlongY);
    object = turns ? frame_of({100, 0, 0, 0, 0, 0}) : KDL::Frame::Identity();
    run_job(job);
  }
};

TEST_F(Job_belts, Pick_a_part_that_moves) {
  begin(kBegin +
            "MOVL ABOVE SPEED 250 mm/s\nSET STEP = 2\nMOVL PICK SPEED 100 mm/s\nSET STEP = 3\nWAIT 0.3s\nSET STEP "
            "= 4\nMOVL ABOVE\nSET STEP = 5\nTRACK OFF\nMOVL BIN\nSET STEP = 6\n",
        40);
  ASSERT_TRUE(until_step(2));
  expect_at({0, 0, 80}, kNear);
  ASSERT_TRUE(until_step(3));
  expect_at({0, 0, 20}, kNear);
  ASSERT_TRUE(until([&] {
    expect_at({0, 0, 20}, kNear);
    return *values["STEP"] == 4;
  }));
  ASSERT_TRUE(until_step(5));
  expect_at({0, 0, 80}, kNear);
  ASSERT_TRUE(until_step(6));
  expect_end();
  EXPECT_NEAR(cell.out.position[1], 200, 1e-3);
}

TEST_F(Job_belts, Lines_with_zones_circles_and_offsets_lie_on_the_part) {
  begin(kBegin +
            "MOVL ABOVE SPEED 250 mm/s\nSET STEP = 2\nZONE 10 mm\nMOVL ABOVE OFFSET 40, 0, 0 SPEED 100 mm/s\nZONE "
            "0\nMOVL ROUND SPEED 100 mm/s\nSET STEP = 3\nMOVC NEXT ABOVE SPEED 100 mm/s\nSET STEP = 4\n",
        30);
  ASSERT_TRUE(until_step(2));
  ASSERT_TRUE(until([&] {
    expect_on_line({0, 0, 80}, {60, 0, 80}, kNear);
    return *values["STEP"] == 3;
  }));
  ASSERT_TRUE(until_step(4));
  expect_at({0, 0, 80}, kNear);
  expect_end();
}

TEST_F(Job_belts, A_table_turns_the_part) {
  begin(kPlaces +
            "MOVJ BIN\nWAIT 0.5s\nSET STEP = 1\nTRACK cake ON TABLE 1 ABOUT table\nMOVL TOP SPEED 250 mm/s\nSET "
            "STEP = 2\nMOVL EDGE SPEED 50 mm/s\nSET STEP = 3\nTRACK OFF\nMOVL BIN\n",
        6, true);
  ASSERT_TRUE(until_step(2));
  expect_at({0, 0, 60}, kNear);
  ASSERT_TRUE(until([&] {
    expect_on_line({0, 0, 60}, {0, 40, 60}, kNear);
    return *values["STEP"] == 3;
  }));
  expect_end();
}

TEST_F(Job_belts, Other_points_stay_where_they_are) {
  begin(kBegin + "MOVL ABOVE SPEED 250 mm/s\nMOVL BIN\nSET STEP = 2\nMOVL ABOVE SPEED 250 mm/s\nSET STEP = 3\n", 20);
  ASSERT_TRUE(until_step(2));
  EXPECT_NEAR(cell.out.position[1], 200, 0.01);  // it already begins to follow the belt again
  ASSERT_TRUE(until_step(3));
  expect_at({0, 0, 80}, kNear);
  expect_end();
}

TEST_F(Job_belts, A_hold_leaves_the_part_and_returns_to_it) {
  begin(kBegin + "MOVL ABOVE SPEED 250 mm/s\nSET STEP = 2\nMOVL NEXT SPEED 20 mm/s\nSET STEP = 3\nTRACK OFF\n", 20);
  ASSERT_TRUE(until_step(2));
  ASSERT_TRUE(until([&, from = time] { return time > from + 0.5; }));
  cell.in.hold = true;
  ASSERT_TRUE(until([&] { return stands(); }));
  cell.in.hold = false;
  ASSERT_TRUE(until_step(3));
  expect_at({60, 30, 80}, kNear);
  expect_end();
}

TEST_F(Job_belts, A_stopped_job_is_not_resumed) {
  begin(kBegin + "MOVL ABOVE SPEED 250 mm/s\nSET STEP = 2\nMOVL NEXT SPEED 20 mm/s\nTRACK OFF\n", 20);
  ASSERT_TRUE(until_step(2));
  cell.ask(Service::JobStop);
  ASSERT_TRUE(until([&] { return cell.out.state == GroupState::Standby; }));
  EXPECT_TRUE(stands());
  EXPECT_FALSE(cell.out.job.can_resume);
  cell.ask(Service::JobStart);
  tracked = false;
  *values["STEP"] = 0;
  ASSERT_TRUE(until_step(2));
  expect_at({0, 0, 80}, kNear);
  expect_end();
}

TEST_F(Job_belts, A_lost_belt_fails_the_job_at_its_line) {
  begin(kBegin + "MOVL ABOVE SPEED 250 mm/s\nSET STEP = 2\nMOVL NEXT SPEED 5 mm/s\nTRACK OFF\n", 20);
  ASSERT_TRUE(until_step(2));
  reported = false;
  ASSERT_TRUE(until([&] { return cell.out.state == GroupState::ErrorStop; }));
  EXPECT_EQ(cell.out.error, ErrorCode::Belt);
  EXPECT_EQ(cell.out.job.state, JobState::Failed);
  EXPECT_THAT(message(), HasSubstr("main.job:"));
  EXPECT_THAT(message(), HasSubstr("belt 1 has no position any more"));
}

TEST_F(Job_belts, Without_a_belt_the_job_can_do_something_else) {
  begin(kPlaces + "MOVJ BIN\nTRY\nTRACK part ON BELT 2 ALONG conveyor\nRECOVER\nSET STEP = 1\nEND\n", 20);
  ASSERT_TRUE(until_step(1));
  EXPECT_THAT(message(), HasSubstr("the belt has no position"));
  expect_end();
}

TEST_F(Job_belts, A_job_cannot_begin_on_the_belt) {
  begin(kBegin + "MOVL ABOVE SPEED 250 mm/s\nTRACK OFF\n", 20);
  cell.ask(Service::JobStop);
  ASSERT_TRUE(until([&] { return cell.out.state == GroupState::Standby && ended(); }));
  cell.in.service.line = 17;
  start_job();
  ASSERT_TRUE(until([&] { return ended(); }));
  EXPECT_THAT(message(), HasSubstr("cannot begin between TRACK and TRACK OFF"));
}

TEST_F(Job_belts, Breakpoints_wait_until_the_tool_has_left) {
  begin(kBegin +
            "MOVL ABOVE SPEED 250 mm/s\nSET STEP = 2\nMOVL NEXT SPEED 50 mm/s\nSET STEP = 3\nTRACK OFF\nSET STEP = "
            "4\n",
        20);
  ASSERT_TRUE(until_step(2));
  cell.in.single_step = true;
  ASSERT_TRUE(until([&] { return cell.out.job.state == JobState::Paused; }));
  EXPECT_EQ(*values["STEP"], 3);
  EXPECT_TRUE(stands());
}

struct Refused {
  const char* name;
  const char* line;
  const char* why;
};
class Job_belt_refuses : public Job_belts, public testing::WithParamInterface<Refused> {};

TEST_P(Job_belt_refuses, What_does_not_move_with_it) {
  begin("TOOL t = POSE 0 0 50 RPY 0 0 0\n" + kBegin + "MOVL ABOVE SPEED 250 mm/s\nTRY\n" + GetParam().line +
            "\nRECOVER\nSET STEP = 2\nEND\n",
        20);
  ASSERT_TRUE(until_step(2));
  EXPECT_THAT(message(), HasSubstr(GetParam().why));
  expect_end();
}

INSTANTIATE_TEST_SUITE_P(All, Job_belt_refuses,
                         testing::Values(Refused{"A_joint_motion", "MOVJ NEXT", "follow a frame that moves"},
                                         Refused{"A_circle_half_on_it", "MOVC P2 NEXT", "with all their points in it"},
                                         Refused{"Here", "MOVL HERE OFFSET 0, 0, 10", "do not move with the frame"},
                                         Refused{"A_condition", "MOVL NEXT UNTIL I4", "UNTIL cannot end"},
                                         Refused{"A_tool", "TOOL t", "tool, load and correction"},
                                         Refused{"Twice", "TRACK part ON BELT 1 ALONG conveyor", "TRACK is on"}),
                         [](const auto& each) { return std::string(each.param.name); });

TEST(Job_belt_lines, Wrong_ones_are_named) {
  const auto errors = [](const std::string& text) {
    return base::to_text(parse_jobs({{"a.job", kPlaces + text}}).diagnostics);
  };
  EXPECT_EQ(errors("TRACK part ON BELT 1 ALONG conveyor\nTRACK OFF\n"), "");
  EXPECT_THAT(errors("TRACK pat ON BELT 1 ALONG conveyor\n"), HasSubstr("there is no frame 'pat'"));
  EXPECT_THAT(errors("TRACK part ON BELT 1 ALONG convey\n"), HasSubstr("there is no frame 'convey'"));
  EXPECT_THAT(errors("TRACK part BELT 1\n"), HasSubstr("expected ON BELT or ON TABLE"));
  EXPECT_THAT(errors("TRACK part ON BELT 3 ALONG conveyor\n"), HasSubstr("belts have numbers from 1 to 2"));
  EXPECT_THAT(errors("TRACK part ON TABLE 1 ALONG conveyor\n"), HasSubstr("expected ABOUT and the frame of the table"));
}

}  // namespace
}  // namespace indurop::robot
