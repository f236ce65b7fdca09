// SPDX-License-Identifier: Apache-2.0
// Motions that a condition ends: how far the tip still goes, compared with the closed form of a stop with limited
// acceleration and jerk, and what happens to them around interrupts, stops and drives.
#include <gmock/gmock.h>

#include <cmath>

#include "group_cell.h"
#include "limit_judge.h"

namespace indurop::robot {
namespace {

using testing::HasSubstr;

constexpr const char* kGantryPoints =
    "POINT A = POSE 200 0 1300 RPY 180 0 0\nPOINT B = POSE 2700 0 1300 RPY 180 0 0\nPOINT C = POSE 200 300 1300 RPY "
    "180 0 0\n";

// The x axis of a gantry: 2 m/s, reached in 0.25 s, its acceleration in 0.1 s.
constexpr double kMostAcceleration = 8;
constexpr double kMostJerk = 80;

// m, from this speed to rest.
double stop_of(double speed) {
  const double time = speed >= kMostAcceleration * kMostAcceleration / kMostJerk
                          ? speed / kMostAcceleration + kMostAcceleration / kMostJerk
                          : 2 * std::sqrt(speed / kMostJerk);
  return speed * time / 2;
}

class Search_motion : public testing::Test {
 protected:
  void start(const std::string& job, double period_ms) {
    cell = std::make_unique<Cell>(kGantryPoints + job, period_ms, 0, true, Settings{}, urdf_of("gantry"));
    ASSERT_TRUE(cell->serve(Service::GroupEnable));
    judge = std::make_unique<Judge>(period_ms / 1000, urdf_of("gantry"));
    seen = cell->periods;
    cell->in.service.job = 1;
    cell->ask(Service::JobStart);
  }
  // Until the condition holds; I4 is on from x on.
  template <class Condition>
  bool follow(double x, const Condition& condition) {
    return cell->until(
        [&] {
          if (seen != cell->periods) {
            seen = cell->periods;
            EXPECT_EQ(judge->look(*cell, 1), "");
          }
          cell->values[0] = cell->out.position[0] >= x ? 1 : 0;
          return condition() || HasFailure();
        },
        20'000);
  }
  void follow_for(double x, int periods) {
    const int last = cell->periods + periods;
    ASSERT_TRUE(follow(x, [&] { return cell->periods >= last; }));
  }
  bool ended() const { return cell->out.done == cell->in.service.number; }
  std::unique_ptr<Cell> cell;
  std::unique_ptr<Judge> judge;
  int seen = 0;  // period
};

TEST_F(Search_motion, Stops_within_the_closed_form_of_a_stop_and_two_periods) {
  for (const double period_ms : {1.0, 4.0, 10.0}) {
    for (const double speed : {0.02, 0.1, 0.4, 0.9}) {
      start("MOVL A\nSEARCH B UNTIL I4 SPEED " + std::to_string(1000 * speed) + " mm/s\nSET OUT = X(FOUND)\n",
            period_ms);
      const double edge = speed < 0.1 ? 250 : 1000;
      ASSERT_TRUE(follow(edge, [&] { return ended(); }));
      EXPECT_EQ(cell->out.error, ErrorCode::Ok) << cell->out.job.message;
      const double way = cell->out.position[0] - cell->values[1];
      const double in_period = speed * period_ms;
      EXPECT_NEAR(cell->values[1], edge, in_period + 1e-3) << speed << " m/s, " << period_ms << " ms";
      EXPECT_LE(way, 1000 * stop_of(speed) * 1.03 + 2 * in_period) << speed << " m/s, " << period_ms << " ms";
      EXPECT_GE(way, 1000 * stop_of(speed) * 0.97 - in_period) << speed << " m/s, " << period_ms << " ms";
    }
  }
}

TEST_F(Search_motion, Goes_on_from_where_it_stands) {
  start(
      "MOVL A\nMOVL B UNTIL I4 SPEED 300 mm/s\nMOVL FOUND\nSET OUT = X(HERE) - X(FOUND)\nMOVL HERE OFFSET 0, 0, 100\n",
      4);
  ASSERT_TRUE(follow(1000, [&] { return ended(); }));
  EXPECT_EQ(cell->out.error, ErrorCode::Ok) << cell->out.job.message;
  EXPECT_NEAR(cell->values[1], 0, 1e-3);
  EXPECT_NEAR(cell->out.position[0], 1000, 2.5);
  EXPECT_NEAR(cell->out.position[2], 1400, 1e-3);
}

TEST_F(Search_motion, Fails_with_its_line_if_there_is_nothing) {
  start("MOVL A\nSEARCH B UNTIL I4\n", 10);
  ASSERT_TRUE(follow(HUGE_VAL, [&] { return ended(); }));
  EXPECT_EQ(cell->out.error, ErrorCode::Line);
  EXPECT_THAT(cell->out.job.message, HasSubstr("main.job:5: the search came to its end and found nothing"));
  EXPECT_NEAR(cell->out.position[0], 2700, 1e-3);
}

TEST_F(Search_motion, Is_continued_after_a_stop_and_still_finds) {
  start("MOVL A\nSEARCH B UNTIL I4 SPEED 300 mm/s\nSET OUT = X(FOUND)\n", 4);
  ASSERT_TRUE(follow(1500, [&] { return cell->out.position[0] > 800; }));
  cell->ask(Service::JobStop);
  ASSERT_TRUE(follow(1500, [&] { return cell->out.state == GroupState::Standby; }));
  ASSERT_TRUE(cell->out.job.can_resume);
  cell->ask(Service::JobResume);
  ASSERT_TRUE(follow(1500, [&] { return ended(); }));
  EXPECT_EQ(cell->out.error, ErrorCode::Ok) << cell->out.job.message;
  EXPECT_NEAR(cell->values[1], 1500, 2);
  EXPECT_LT(cell->out.position[0], 1540);
}

TEST_F(Search_motion, A_stop_while_it_comes_to_rest_does_not_lead_farther) {
  start("MOVL A\nSEARCH B UNTIL I4 SPEED 900 mm/s\nSET OUT = X(FOUND)\n", 4);
  ASSERT_TRUE(follow(1500, [&] { return cell->values[0] > 0; }));
  follow_for(1500, 2);
  cell->ask(Service::JobStop);
  ASSERT_TRUE(follow(1500, [&] { return cell->out.state == GroupState::Standby; }));
  cell->ask(Service::JobResume);
  ASSERT_TRUE(follow(1500, [&] { return ended(); }));
  EXPECT_EQ(cell->out.error, ErrorCode::Ok) << cell->out.job.message;
  EXPECT_NEAR(cell->values[1], 1500, 4);
  EXPECT_LT(cell->out.position[0], 1640);
}

TEST_F(Search_motion, A_pause_at_each_line_lets_it_find) {
  start("MOVL A\nSEARCH B UNTIL I4 SPEED 300 mm/s\nSET OUT = X(FOUND)\n", 4);
  ASSERT_TRUE(follow(1000, [&] { return cell->out.position[0] > 500; }));
  cell->in.single_step = true;
  ASSERT_TRUE(follow(1000, [&] { return cell->out.job.state == JobState::Paused; }));
  EXPECT_EQ(cell->out.job.line, 6U);
  EXPECT_LT(cell->out.position[0], 1030);
}

}  // namespace
}  // namespace indurop::robot
