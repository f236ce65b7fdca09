// SPDX-License-Identifier: Apache-2.0
// What jobs set on the way: where the tip is then, measured in the drives' set points.
#include <gmock/gmock.h>

#include "control/robot/job/job.h"
#include "group_cell.h"

namespace indurop::robot {
namespace {

using testing::HasSubstr;

constexpr const char* kPoints =
    "POINT H = JOINT 0 -20 10 0 100 0\nPOINT A = POSE 500 -250 300 RPY 180 0 180\n"
    "POINT B = POSE 500 250 300 RPY 180 0 180\nPOINT C = POSE 500 250 450 RPY 180 0 180\n";

struct Set {
  double value = 0;
  Vec3 place = Vec3::Zero();
  double speed = 0;  // mm/s
  double time = 0;   // s
};

// Where the tip was when I4 changed, and the time of the end at last.
std::vector<Set> sets_of(const std::string& job, double period_ms = 10) {
  Cell cell(kPoints + job, period_ms, 0, true, {}, cell_urdf());
  std::vector<Set> sets;
  EXPECT_TRUE(cell.serve(Service::GroupEnable));
  cell.in.service.job = 1;
  cell.ask(Service::JobStart);
  double before = 0;
  int i = 0;
  EXPECT_TRUE(cell.until(
      [&] {
        const Vec3 tip(cell.out.position[0], cell.out.position[1], cell.out.position[2]);
        if (cell.values[0] != before || cell.out.done == cell.in.service.number) {
          before = cell.values[0];
          sets.push_back({before, tip, cell.out.tool_speed, ++i * period_ms / 1000});
        }
        ++i;
        return cell.out.done == cell.in.service.number;
      },
      20'000))
      << job;
  EXPECT_EQ(cell.out.error, ErrorCode::Ok) << cell.out.job.message;
  return sets;
}

TEST(Path_output, Is_set_at_its_distance_within_what_the_tip_goes_in_two_periods) {
  for (const double period_ms : {1.0, 10.0}) {
    const auto sets = sets_of(
        "MOVJ H\nMOVL A\nSPEED 400 mm/s\nMOVL B\nSET I4 = 1 AFTER 100 mm\nSET I4 = 2 BEFORE 50 mm\n", period_ms);
    ASSERT_EQ(sets.size(), 3U);
    EXPECT_NEAR(sets[0].place.y(), -150, 2 * 0.4 * period_ms + 0.01);
    EXPECT_NEAR(sets[1].place.y(), 200, 2 * 0.4 * period_ms + 0.01);
    EXPECT_GT(sets[0].speed, 390);
  }
}

TEST(Path_output, Does_not_stop_the_motion_nor_the_blend_behind_it) {
  const auto sets = sets_of("MOVJ H\nMOVL A\nSPEED 200 mm/s\nZONE 30 mm\nMOVL B\nSET I4 ON BEFORE 40 mm\nMOVL C\n");
  ASSERT_EQ(sets.size(), 2U);
  EXPECT_NEAR(sets[0].place.y(), 210, 5);
  EXPECT_GT(sets[0].speed, 190);
}

TEST(Path_output, Is_set_at_its_time_also_of_joint_motions) {
  const auto sets = sets_of("MOVJ A\nSET I4 = 1 AFTER 0.1s\nSET I4 = 2 BEFORE 200 ms\n");
  ASSERT_EQ(sets.size(), 3U);
  EXPECT_NEAR(sets[2].time - sets[1].time, 0.2, 0.04);
}

TEST(Path_output, Of_each_time_in_a_loop_it_is_one) {
  const auto sets = sets_of("MOVJ A\nLOOP 3\nMOVL B\nSET I4 = 1 BEFORE 100 mm\nMOVL A\nSET I4 = 0 AFTER 30 mm\nEND\n");
  ASSERT_EQ(sets.size(), 7U);
  for (std::size_t i = 0; i < 6; ++i) {
    EXPECT_NEAR(sets[i].place.y(), i % 2 == 0 ? 150 : 220, 20) << i;
  }
}

TEST(Path_output, Of_a_motion_that_is_stopped_it_is_set_when_the_job_goes_on) {
  Cell cell(kPoints + std::string("MOVJ A\nSPEED 200 mm/s\nMOVL B\nSET I4 ON BEFORE 100 mm\n"), 10, 0, true, {},
            cell_urdf());
  ASSERT_TRUE(cell.serve(Service::GroupEnable));
  cell.in.service.job = 1;
  cell.ask(Service::JobStart);
  ASSERT_TRUE(cell.until([&] { return cell.out.job.line == 7 && cell.out.position[1] > 0; }));
  ASSERT_TRUE(cell.serve(Service::JobStop));
  EXPECT_EQ(cell.values[0], 0);
  cell.ask(Service::JobResume);
  ASSERT_TRUE(cell.until([&] { return cell.values[0] == 1; }));
  EXPECT_NEAR(cell.out.position[1], 150, 5);
  EXPECT_TRUE(cell.until([&] { return cell.out.job.state == JobState::Ended; }));
}

TEST(Path_output, A_pulse_ends_on_its_own_while_the_robot_moves) {
  const auto sets = sets_of("MOVJ A\nSPEED 200 mm/s\nMOVL B\nPULSE I4 0.3s AFTER 100 mm\n");
  ASSERT_EQ(sets.size(), 3U);
  EXPECT_NEAR(sets[0].place.y(), -150, 5);
  EXPECT_EQ(sets[1].value, 0);
  EXPECT_NEAR(sets[1].time - sets[0].time, 0.3, 0.011);
  EXPECT_GT(sets[1].speed, 190);
}

TEST(Path_output, A_pulse_ends_whatever_became_of_its_job) {
  for (const bool emergency : {false, true}) {
    Cell cell(kPoints + std::string("PULSE I4 500 ms\nMOVJ A\nLOOP\nMOVL B\nMOVL A\nEND\n"), 10, 0, true, {},
              cell_urdf());
    ASSERT_TRUE(cell.serve(Service::GroupEnable));
    cell.in.service.job = 1;
    cell.ask(Service::JobStart);
    ASSERT_TRUE(cell.until([&] { return cell.values[0] == 1; }));
    if (emergency) {
      cell.in.emergency = true;
    } else {
      cell.ask(Service::JobStop);
    }
    int periods = 0;
    ASSERT_TRUE(cell.until([&] { return ++periods > 0 && cell.values[0] == 0; }));
    EXPECT_NEAR(periods, 50, 2);
  }
}

TEST(Path_output, A_pulse_begins_again_and_SET_replaces_it) {
  // 0.2 s of a pulse of 0.3 s, then another 0.3 s: one edge up, one down, 0.5 s between them.
  auto sets = sets_of("PULSE I4 0.3s\nWAIT 0.2s\nPULSE I4 0.3s\nWAIT 1s\n");
  ASSERT_EQ(sets.size(), 3U);
  EXPECT_NEAR(sets[1].time - sets[0].time, 0.5, 0.02);
  sets = sets_of("PULSE I4 0.3s\nSET I4 = 5\nWAIT 1s\nSET I4 = 6\nWAIT 0.1s\n");
  ASSERT_EQ(sets.size(), 3U);
  EXPECT_EQ(sets[0].value, 5);
  EXPECT_EQ(sets[1].value, 6);
}

TEST(Path_output, Mistakes_are_named_where_they_are) {
  const std::pair<const char*, const char*> cases[] = {
      {"SET I4 ON BEFORE 5 mm\n", "a.job:1:1: error: BEFORE and AFTER are about the motion in the line above"},
      {"MOVJ P\nSET I4 ON AFTER 5 mm\n",
       "a.job:2:17: error: the way of a MOVJ or MOVE FREE has no distance; give a time"},
      {"MOVL P\nSET I4 = I5 AFTER 5 mm\n", "a.job:2:1: error: what is set on the way is computed before"},
      {"MOVL P\nSET I4 ON AFTER 5\n", "a.job:2:18: error: expected s or ms, found the end of the line"},
      {"PULSE I4\n", "a.job:1:9: error: expected a time, 0.5s or 200 ms, found the end of the line"},
      {"PULSE I4 0 s\n", "a.job:1:10: error: a pulse is longer than 0 s"},
      {"MOVL P\nSET I4 ON BEFORE 50 mm\nSET I4 ON BEFORE\n", "a.job:3:17: error: expected a time, 0.5s or 200 ms"},
      {"MOVL P\nSET I4 ON BEFORE -5 mm\n", "a.job:2:18: error: a distance is from 0 mm"},
  };
  for (const auto& [text, wanted] : cases) {
    const std::string job = std::string(text) + "POINT P = POSE 0 0 0 RPY 0 0 0\n";
    EXPECT_THAT(base::to_text(parse_jobs({{"a.job", job}}).diagnostics), HasSubstr(wanted)) << text;
  }
}

}  // namespace
}  // namespace indurop::robot
