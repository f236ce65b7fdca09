// SPDX-License-Identifier: Apache-2.0
// Jobs that are left and go on: back on their path after stops of all kinds, within all limits; refused where the robot
// is not near its path any more; single steps forward and back, breakpoints, and jobs that begin in mid-job.
#include <gmock/gmock.h>

#include <random>
#include <vector>

#include "limit_judge.h"

namespace indurop::robot {
namespace {

using testing::HasSubstr;

Vec3 resume_tip(const Cell& cell) {
  return {cell.out.position[0], cell.out.position[1], cell.out.position[2]};
}

std::vector<double> joints(const Cell& cell) {
  return {cell.out.command.begin(), cell.out.command.begin() + 6};
}

constexpr const char* kResumePoints =
    "POINT H = JOINT 0 -20 10 0 100 0\n"
    "POINT A = POSE 500 -250 300 RPY 180 0 180\nPOINT B = POSE 500 -100 200 RPY 180 0 150\n"
    "POINT C = POSE 450 100 300 RPY 170 10 180\nPOINT D = POSE 450 250 350 RPY 180 0 200\n"
    "POINT E = POSE 550 0 450 RPY 180 20 180\n";

std::string random_job(std::mt19937& random, bool zones) {
  const auto one_of = [&](int many) { return std::uniform_int_distribution<int>(0, many - 1)(random); };
  const auto point = [&] { return std::string(1, static_cast<char>('A' + one_of(5))); };
  std::string job = std::string(kResumePoints) + (zones ? "MOVJ H\n" : "MOVJ H STRAIGHT\n");
  for (int i = 0; i < 6; ++i) {
    if (zones && one_of(2) == 0) {
      job += fmt::format("ZONE {} mm\n", one_of(3) * 20);
    }
    if (one_of(3) == 0) {
      job += fmt::format("SPEED {} mm/s\n", 100 + one_of(600));
    }
    switch (one_of(5)) {
      case 0:
        job += "MOVJ " + point() + (zones ? "\n" : " STRAIGHT\n");
        break;
      case 1:
        job += "MOVL A\nMOVC E D\n";
        break;
      case 2:
        job += "MOVS A B C D\n";
        break;
      default:
        job += "MOVL " + point() + "\n";
    }
  }
  return job;
}

void switch_off(Cell& cell) {
  ASSERT_TRUE(cell.serve(Service::GroupDisable));
  for (int i = 0; i < 10; ++i) {
    cell.step();
  }
}

// The robot was switched off by whatever stopped it, and perhaps pushed by hand; back to standby.
void recover(Cell& cell, std::mt19937& random, double pushed_deg) {
  ASSERT_TRUE(
      cell.until([&] { return cell.out.state != GroupState::Moving && cell.out.state != GroupState::Stopping; }));
  cell.in.emergency = false;
  for (int i = 0; i < 100; ++i) {
    cell.step();
  }
  ASSERT_TRUE(cell.serve(Service::GroupReset)) << to_string(cell.out.error);
  switch_off(cell);
  for (std::size_t i = 0; i < 6; ++i) {
    const double deg = std::uniform_real_distribution<double>(-pushed_deg, pushed_deg)(random);
    cell.in.drives[i].position += static_cast<std::int32_t>(deg * 1'320'000 / 360);
  }
  ASSERT_TRUE(cell.serve(Service::GroupEnable)) << to_string(cell.out.error);
}

double away_from_path(const std::vector<Vec3>& path, const Vec3& place) {
  double least = HUGE_VAL;
  for (std::size_t i = 1; i < path.size(); ++i) {
    const Vec3 way = path[i] - path[i - 1];
    const double part = std::clamp((place - path[i - 1]).dot(way) / std::max(way.squaredNorm(), 1e-12), 0.0, 1.0);
    least = std::min(least, (place - path[i - 1] - part * way).squaredNorm());
  }
  return std::sqrt(least);
}

void stop(Cell& cell, std::mt19937& random) {
  switch (std::uniform_int_distribution<int>(0, 3)(random)) {
    case 0:
      cell.ask(Service::JobStop);
      break;
    case 1:
      cell.ask(Service::GroupDisable);
      break;
    case 2:
      cell.in.drives[std::uniform_int_distribution<std::size_t>(0, 5)(random)].status = Cell::kFault;
      break;
    default:
      cell.in.emergency = true;
  }
}

// Behind a stop.
void go_on(Cell& cell, std::mt19937& random, double pushed_deg, Judge& judge) {
  recover(cell, random, pushed_deg);
  for (int k = 0; k < 4; ++k) {
    cell.step();
    static_cast<void>(judge.look(cell, 1));
  }
  ASSERT_TRUE(cell.out.job.can_resume);
  cell.ask(Service::JobResume);
}

// Runs a job that is stopped at random instants, goes on each time, and ends where and how it would have.
void run(unsigned seed, double& most_away, int& stops) {
  std::mt19937 random(seed);
  const bool zones = seed % 2 == 0;
  const std::string job = random_job(random, zones);
  const double period_ms = seed % 3 == 0 ? 4 : 10;
  Cell straight(job, period_ms, 0, true, {}, cell_urdf());
  ASSERT_TRUE(straight.serve(Service::GroupEnable));
  straight.in.service.job = 1;
  straight.ask(Service::JobStart);
  std::vector<Vec3> path;
  ASSERT_TRUE(straight.until(
      [&] {
        path.push_back(resume_tip(straight));
        return straight.out.done == straight.in.service.number;
      },
      40'000));
  if (straight.out.error != ErrorCode::Ok) {
    return;  // not every way is possible
  }
  Settings settings;
  settings.regain_distance = 600;  // at full speed, a drive's fault is that far from the path
  Cell sut(job, period_ms, 0, true, settings, cell_urdf());
  ASSERT_TRUE(sut.serve(Service::GroupEnable));
  Judge judge(period_ms / 1000);
  sut.in.service.job = 1;
  sut.ask(Service::JobStart);
  int left = 3;
  bool returning = false;
  for (int i = 0; i < 100'000 / period_ms; ++i) {
    sut.step();
    ASSERT_EQ(judge.look(sut, sut.in.emergency ? kEmergency : 1), "") << "seed " << seed << "\n" << job;
    if (sut.out.done == sut.in.service.number && sut.out.error == ErrorCode::Ok &&
        sut.out.job.state == JobState::Ended) {
      break;
    }
    returning = returning && sut.out.job.state != JobState::Runs;
    if (i % 8 == 0 && !zones && !returning && sut.out.state == GroupState::Moving) {
      most_away = std::max(most_away, away_from_path(path, resume_tip(sut)));
    }
    const bool now = std::uniform_real_distribution<double>(0, 1)(random) < 0.8 * period_ms / 1000;
    if (left > 0 && now && sut.out.state == GroupState::Moving) {
      --left;
      ++stops;
      stop(sut, random);
      go_on(sut, random, seed % 5 == 0 ? 2 : 0, judge);
      returning = true;
    }
    ASSERT_NE(sut.out.state, GroupState::ErrorStop)
        << "seed " << seed << ": " << to_string(sut.out.error) << " " << sut.out.job.message << "\n"
        << job;
  }
  ASSERT_EQ(sut.out.job.state, JobState::Ended)
      << "seed " << seed << ": " << to_string(sut.out.error) << ", " << sut.out.job.message << ", state "
      << static_cast<int>(sut.out.state) << ", " << sut.out.path_speed << " %\n"
      << job;
  EXPECT_LT((resume_tip(sut) - resume_tip(straight)).norm(), 1e-3) << "seed " << seed;
}

TEST(Resume, Jobs_that_are_stopped_anywhere_go_on_along_their_path_within_all_limits) {
  const char* wanted = std::getenv("INDUROP_ROBOT_JOBS");
  const unsigned jobs = wanted == nullptr ? 20 : static_cast<unsigned>(std::atoi(wanted));
  double most_away = 0;
  int stops = 0;
  for (unsigned seed = 1; seed <= jobs; ++seed) {
    run(seed, most_away, stops);
    if (testing::Test::HasFatalFailure()) {
      return;
    }
  }
  fmt::print("{} stops; at most {:.4f} mm from the path without them\n", stops, most_away);
  EXPECT_LT(most_away, 0.1);
}

constexpr const char* kLines = "MOVJ H\nSPEED 200 mm/s\nMOVL A\nMOVL B\nSET I4 ON\nMOVL C\n";

// In the middle of its second line.
void stop_in_line(Cell& cell) {
  ASSERT_TRUE(cell.serve(Service::GroupEnable));
  cell.in.service.job = 1;
  cell.ask(Service::JobStart);
  ASSERT_TRUE(cell.until([&] { return cell.out.job.line == 10 && cell.out.tool_speed > 150; }));
  cell.in.emergency = true;
}

TEST(Resume, It_goes_back_to_the_path_slowly_and_then_on) {
  Cell cell(kResumePoints + std::string(kLines), 10, 0, true, {}, cell_urdf());
  stop_in_line(cell);
  std::mt19937 random(1);
  recover(cell, random, 3);
  const Vec3 pushed = resume_tip(cell);
  cell.ask(Service::JobResume);
  double fastest = 0;
  ASSERT_TRUE(cell.until([&] {
    fastest = std::max(fastest, cell.out.job.state == JobState::Resumes ? cell.out.tool_speed : 0);
    return cell.out.job.state == JobState::Runs;
  }));
  EXPECT_GT((resume_tip(cell) - pushed).norm(), 1);
  EXPECT_GT(fastest, 10);
  EXPECT_LT(fastest, 200);
  EXPECT_TRUE(cell.until([&] { return cell.out.job.state == JobState::Ended; }));
  EXPECT_EQ(cell.values[0], 1);
}

TEST(Resume, It_is_refused_after_the_robot_was_moved_away_by_hand) {
  Cell cell(kResumePoints + std::string(kLines), 10, 0, true, {}, cell_urdf());
  stop_in_line(cell);
  std::mt19937 random(2);
  recover(cell, random, 0);
  switch_off(cell);
  cell.in.drives[0].position += 1'320'000 / 360 * 25;
  ASSERT_TRUE(cell.serve(Service::GroupEnable));
  EXPECT_FALSE(cell.serve(Service::JobResume));
  EXPECT_EQ(cell.out.error, ErrorCode::Away);
  EXPECT_EQ(cell.out.state, GroupState::Standby);
  EXPECT_THAT(cell.out.job.message,
              HasSubstr("mm (axis 1: 25 deg) from where its job left the path; 100 mm (45 deg) "));
  // Brought back, it goes on.
  switch_off(cell);
  cell.in.drives[0].position -= 1'320'000 / 360 * 24;
  ASSERT_TRUE(cell.serve(Service::GroupEnable));
  EXPECT_TRUE(cell.serve(Service::JobResume)) << to_string(cell.out.error);
  EXPECT_EQ(cell.out.job.state, JobState::Ended);
}

TEST(Resume, There_is_nothing_to_go_on_with_before_a_job_and_after_its_end) {
  Cell cell(kResumePoints + std::string("MOVJ H\n"), 10, 0, true, {}, cell_urdf());
  ASSERT_TRUE(cell.serve(Service::GroupEnable));
  EXPECT_FALSE(cell.serve(Service::JobResume));
  EXPECT_EQ(cell.out.error, ErrorCode::NoResume);
  cell.in.service.job = 1;
  ASSERT_TRUE(cell.serve(Service::JobStart));
  EXPECT_FALSE(cell.serve(Service::JobResume));
  EXPECT_EQ(cell.out.error, ErrorCode::NoResume);
}

TEST(Resume, Another_stop_on_the_way_back_loses_nothing) {
  Cell cell(kResumePoints + std::string(kLines), 10, 0, true, {}, cell_urdf());
  stop_in_line(cell);
  std::mt19937 random(3);
  recover(cell, random, 3);
  cell.ask(Service::JobResume);
  ASSERT_TRUE(cell.until([&] { return cell.out.tool_speed > 10; }));
  cell.in.emergency = true;
  recover(cell, random, 0);
  EXPECT_TRUE(cell.serve(Service::JobResume)) << to_string(cell.out.error);
  EXPECT_EQ(cell.out.job.state, JobState::Ended);
}

// Lines: 7 MOVJ H, 8 SPEED, 9 MOVL A, 10 MOVL B, 11 SET, 12 MOVL C.
// Requested while it brakes, the job is resumed in the first period at standstill. A stop near the end of a motion ends
// where the motion does.
TEST(Resume, A_stop_anywhere_in_a_motion_is_resumed_at_once) {
  bool ended = false;
  for (int stop = 1; stop < 500 && !ended; ++stop) {
    Cell cell("MOVJ P1\nWAIT 0.05s\nSET I4 ON\n");
    ASSERT_TRUE(cell.serve(Service::GroupEnable));
    cell.in.service.job = 1;
    cell.ask(Service::JobStart);
    for (int i = 0; i < stop; ++i) {
      cell.step();
    }
    ended = cell.out.job.state == JobState::Ended;
    cell.ask(Service::JobStop);
    cell.step();
    if (!ended) {
      cell.ask(Service::JobResume);
      ASSERT_TRUE(cell.until([&] { return cell.out.done == cell.in.service.number; }));
      ASSERT_EQ(cell.out.error, ErrorCode::Ok) << stop << ": " << cell.out.job.message;
      EXPECT_EQ(cell.out.job.state, JobState::Ended) << stop;
      EXPECT_NEAR(cell.out.command[0], 20, 1e-6) << stop;
      EXPECT_EQ(cell.values[0], 1) << stop;
    }
  }
  EXPECT_TRUE(ended);
}

TEST(Resume, Single_steps_go_line_by_line_and_back) {
  Cell cell(kResumePoints + std::string(kLines), 10, 0, true, {}, cell_urdf());
  ASSERT_TRUE(cell.serve(Service::GroupEnable));
  cell.in.service.job = 1;
  cell.in.single_step = true;
  ASSERT_TRUE(cell.serve(Service::JobStart));
  std::vector<std::uint32_t> lines;
  std::vector<std::vector<double>> places;
  for (int i = 0; i < 5; ++i) {
    EXPECT_EQ(cell.out.job.state, JobState::Paused);
    lines.push_back(cell.out.job.line);
    places.push_back(joints(cell));
    ASSERT_TRUE(cell.serve(Service::JobResume)) << to_string(cell.out.error);
  }
  EXPECT_THAT(lines, testing::ElementsAre(7, 8, 9, 10, 11));
  EXPECT_EQ(cell.out.job.line, 12U);
  ASSERT_TRUE(cell.serve(Service::JobBack)) << to_string(cell.out.error);
  EXPECT_EQ(cell.out.job.line, 10U);
  EXPECT_THAT(joints(cell), testing::Pointwise(testing::DoubleNear(1e-6), places[3]));
  ASSERT_TRUE(cell.serve(Service::JobBack));
  EXPECT_EQ(cell.out.job.line, 9U);
  EXPECT_THAT(joints(cell), testing::Pointwise(testing::DoubleNear(1e-6), places[2]));
  cell.in.single_step = false;
  EXPECT_TRUE(cell.serve(Service::JobResume));
  EXPECT_EQ(cell.out.job.state, JobState::Ended);
  EXPECT_LT((resume_tip(cell) - Vec3(450, 100, 300)).norm(), 1e-6);
}

// Motions to H in one job and to A in the other, on lines that tell which.
TEST(Resume, The_line_is_reported_with_its_job) {
  Cell cell;
  cell.sut = controller_of(cell_urdf(),
                           std::string(kResumePoints) + "LOOP 2\nMOVJ H\nCALL other\nEND\nMOVJ B\nMOVL NOWHERE\n" +
                               "POINT NOWHERE = POSE 5000 0 0 RPY 180 0 180\n",
                           {}, {{"other", "\n\n\nMOVJ A\nWAIT 0.1s\nMOVJ C\n"}});
  cell.step();
  ASSERT_TRUE(cell.serve(Service::GroupEnable));
  cell.in.service.job = 1;
  cell.ask(Service::JobStart);
  std::vector<std::string> seen;
  ASSERT_TRUE(cell.until([&] {
    const std::string now = fmt::format("{}:{}", cell.out.job.called, cell.out.job.line);
    if (cell.out.job.state != JobState::Idle && (seen.empty() || seen.back() != now)) {
      seen.push_back(now);
    }
    return cell.out.state == GroupState::ErrorStop;
  }));
  EXPECT_THAT(seen, testing::IsSupersetOf({"main:8", "other:4", "other:6", "main:12"}));
  EXPECT_THAT(seen, testing::Not(testing::Contains("main:4")));
  EXPECT_THAT(seen, testing::Not(testing::Contains("other:8")));
  EXPECT_EQ(seen.back(), "main:12");
  EXPECT_STREQ(cell.out.job.name, "main");
}

TEST(Resume, A_breakpoint_pauses_each_time_before_its_line) {
  Cell cell(kResumePoints + std::string("LOOP 3\nMOVJ A\nSET I4 = I4 + 1\nEND\n"), 10, 0, true, {}, cell_urdf());
  ASSERT_TRUE(cell.serve(Service::GroupEnable));
  cell.in.service.job = 1;
  cell.in.breakpoints[3] = {1, 9};
  ASSERT_TRUE(cell.serve(Service::JobStart));
  for (int i = 0; i < 3; ++i) {
    EXPECT_EQ(cell.out.job.state, JobState::Paused);
    EXPECT_EQ(cell.out.job.line, 9U);
    EXPECT_EQ(cell.values[0], i);
    ASSERT_TRUE(cell.serve(Service::JobResume));
  }
  EXPECT_EQ(cell.out.job.state, JobState::Ended);
}

TEST(Resume, A_job_begins_at_a_line_with_the_speed_and_zone_of_the_lines_before) {
  Cell cell(kResumePoints + std::string("MOVJ H\nSPEED 50 mm/s\nMOVL A\nMOVL B\nMOVC E D\n"), 10, 0, true, {},
            cell_urdf());
  ASSERT_TRUE(cell.serve(Service::GroupEnable));
  cell.in.service.job = 1;
  cell.in.service.line = 99;
  EXPECT_FALSE(cell.serve(Service::JobStart));
  EXPECT_EQ(cell.out.error, ErrorCode::Value);
  cell.in.service.line = 11;
  EXPECT_FALSE(cell.serve(Service::JobStart));
  EXPECT_THAT(cell.out.job.message, HasSubstr("main.job:11: a job cannot begin with a circle or a spline"));
  ASSERT_TRUE(cell.serve(Service::GroupReset));
  cell.in.service.line = 0;
  cell.in.service.point = 0;
  cell.in.service.line = 7;
  cell.in.breakpoints[0] = {1, 10};
  ASSERT_TRUE(cell.serve(Service::JobStart));
  cell.in.breakpoints = {};
  cell.in.service.line = 10;
  cell.ask(Service::JobStart);
  double fastest = 0;
  ASSERT_TRUE(cell.until([&] {
    fastest = std::max(fastest, cell.out.tool_speed);
    return cell.out.done == cell.in.service.number;
  }));
  EXPECT_NEAR(fastest, 50, 1);
}

}  // namespace
}  // namespace indurop::robot
