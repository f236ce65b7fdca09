// SPDX-License-Identifier: Apache-2.0
// What is reported of a job: the line that is executed, as the place of the tool shows; that a robot which returns to
// its path resumes its job; and which jobs are interrupted and which interrupts wait.
#include <gmock/gmock.h>

#include <string>
#include <string_view>
#include <vector>

#include "interrupt_cell.h"
#include "job_world.h"
#include "limit_judge.h"

namespace indurop::robot {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

constexpr const char* kReportPoints =
    "POINT H = JOINT 0 -20 10 0 100 0\n"
    "POINT A = POSE 500 -250 300 RPY 180 0 180\nPOINT B = POSE 500 -100 200 RPY 180 0 150\n"
    "POINT C = POSE 450 100 300 RPY 170 10 180\nPOINT D = POSE 450 250 350 RPY 180 0 200\n";
const Vec3 kA(500, -250, 300), kB(500, -100, 200), kC(450, 100, 300), kD(450, 250, 350);
// Lines: 6 MOVJ A, 7 SPEED, 8 MOVL B, 9 n = 0, 10 MOVL C, 11 SET, 12 MOVL D.
constexpr const char* kReportLines = "MOVJ A\nSPEED 200 mm/s\nMOVL B\nVAR n\nMOVL C\nSET I4 ON\nMOVL D\n";

class JobReports : public testing::Test {
 protected:
  void start(const std::string& lines) {
    cell = std::make_unique<Cell>(kReportPoints + lines, 10, 0, true, Settings{}, cell_urdf());
    ASSERT_TRUE(cell->serve(Service::GroupEnable));
    cell->in.service.job = 1;
    cell->ask(Service::JobStart);
  }
  // The robot at standstill, switched off and pushed, and on again.
  void push(double deg) {
    ASSERT_TRUE(cell->serve(Service::GroupDisable));
    for (int i = 0; i < 10; ++i) {
      cell->step();
    }
    for (std::size_t i = 0; i < 6; ++i) {
      cell->in.drives[i].position += static_cast<std::int32_t>(deg * 1'320'000 / 360);
    }
    ASSERT_TRUE(cell->serve(Service::GroupEnable)) << to_string(cell->out.error);
  }
  const JobReport& job() const { return cell->out.job; }
  bool at_rest() const { return cell->out.state == GroupState::Standby || cell->out.state == GroupState::ErrorStop; }
  std::unique_ptr<Cell> cell;
};

TEST_F(JobReports, The_line_is_the_one_on_which_the_tool_is) {
  for (const double zone : {0.0, 20.0}) {
    SCOPED_TRACE(zone);
    start(fmt::format("ZONE {}\n", zone) + kReportLines);
    std::vector<std::uint32_t> lines;
    const std::map<std::uint32_t, std::vector<Vec3>> ways{{9, {kA, kB}}, {11, {kB, kC}}, {13, {kC, kD}}};
    Vec3 before = tip(*cell);
    const Vec3 begin = before;
    ASSERT_TRUE(cell->until([&] {
      const Vec3 now = tip(*cell);
      if (job().state != JobState::Runs && job().state != JobState::Waits) {
        return job().state == JobState::Ended;
      }
      if (lines.empty() || lines.back() != job().line) {
        lines.push_back(job().line);
      }
      if ((now - begin).norm() < 1e-9) {
        EXPECT_EQ(job().line, 7U) << "before the first motion";
      } else if ((now - before).norm() > 1e-9 && ways.count(job().line) > 0) {
        EXPECT_LT(away(ways.at(job().line), now), zone + 0.1) << "line " << job().line;
      }
      before = now;
      return false;
    }));
    lines.erase(std::remove(lines.begin(), lines.end(), 12U), lines.end());  // SET: no longer than a period
    EXPECT_THAT(lines, ElementsAre(7, 9, 11, 13));
  }
}

TEST_F(JobReports, A_stop_before_the_first_motion_names_its_line) {
  start(kReportLines);
  ASSERT_TRUE(cell->until([&] { return job().state == JobState::Runs; }));
  cell->in.emergency = true;
  ASSERT_TRUE(cell->until([&] { return cell->out.state == GroupState::ErrorStop; }));
  EXPECT_EQ(job().line, 6U);
  EXPECT_THAT(job().message, HasSubstr(":6: "));
}

TEST_F(JobReports, It_resumes_until_the_robot_is_back_on_its_path) {
  start(kReportLines);
  ASSERT_TRUE(cell->until([&] { return job().line == 8 && cell->out.tool_speed > 150; }));
  cell->ask(Service::JobStop);
  ASSERT_TRUE(cell->until([&] { return at_rest(); }));
  EXPECT_EQ(job().state, JobState::Idle);
  EXPECT_EQ(job().line, 8U);
  push(1);
  EXPECT_TRUE(job().can_resume);
  cell->ask(Service::JobResume);
  int returned = 0;
  ASSERT_TRUE(cell->until([&] {
    const bool moves = cell->out.state == GroupState::Moving;
    EXPECT_EQ(job().state == JobState::Resumes, moves && job().state != JobState::Runs);
    EXPECT_EQ(job().line, 8U);
    EXPECT_EQ(job().can_resume, !moves);
    EXPECT_TRUE(!moves || std::string_view(job().message).empty()) << job().message;
    returned += job().state == JobState::Resumes ? 1 : 0;
    return job().state == JobState::Runs;
  }));
  EXPECT_GT(returned, 20);
  ASSERT_TRUE(cell->until([&] { return job().line != 8; }));
  EXPECT_EQ(job().line, 10U);
}

TEST_F(JobReports, A_stop_on_the_way_back_is_the_state_again) {
  start(kReportLines);
  ASSERT_TRUE(cell->until([&] { return job().line == 8 && cell->out.tool_speed > 150; }));
  for (int stop = 0; stop < 2; ++stop) {
    cell->in.emergency = true;
    ASSERT_TRUE(cell->until([&] { return cell->out.state == GroupState::ErrorStop; }));
    EXPECT_EQ(job().state, JobState::Failed);
    EXPECT_THAT(job().message, HasSubstr("emergency"));
    EXPECT_TRUE(job().can_resume);
    cell->in.emergency = false;
    for (int i = 0; i < 50; ++i) {
      cell->step();
    }
    ASSERT_TRUE(cell->serve(Service::GroupReset));
    push(stop == 0 ? 1 : 0);
    cell->ask(Service::JobResume);
    ASSERT_TRUE(cell->until([&] { return job().state == JobState::Resumes && cell->out.tool_speed > 5; }));
  }
  ASSERT_TRUE(cell->until([&] { return job().state == JobState::Ended; }));
}

std::vector<std::string> interrupted(const JobReport& report) {
  std::vector<std::string> all;
  for (std::size_t i = 0; i < report.interrupted_count; ++i) {
    all.push_back(fmt::format("{}:{}", report.interrupted[i].name, report.interrupted[i].line));
  }
  return all;
}

TEST_F(JobReports, An_interrupted_job_is_named_until_the_robot_returns_to_it) {
  JobMachine sut(kInterruptPoints + "ON I1 CALL other\nMOVJ A\nSPEED 100 mm/s\nMOVL B\nMOVL C\n",
                 {{"other", "SPEED 30%\nMOVL BACK OFFSET 0, 0, 40\nWAIT 0.2s\n"}});
  const JobReport& job = sut.cell.out.job;
  ASSERT_TRUE(sut.until([&] { return job.line == 11 && sut.cell.out.tool_speed > 90; }));
  EXPECT_EQ(job.interrupted_count, 0);
  sut.signal("I1") = 1;
  ASSERT_TRUE(sut.until([&] { return std::string_view(job.called) == "other"; }));
  std::vector<std::string> seen;
  const auto note = [&] {
    const std::string now = fmt::format("{} {}:{}", static_cast<int>(job.state), job.called, job.line);
    if (seen.empty() || seen.back() != now) {
      seen.push_back(now);
    }
  };
  ASSERT_TRUE(sut.until([&] {
    if (job.state == JobState::Resumes) {
      return true;
    }
    note();
    EXPECT_THAT(interrupted(job), ElementsAre("main:11")) << seen.back();
    return false;
  }));
  EXPECT_THAT(seen, ElementsAre("1 other:2", "2 other:3"));
  ASSERT_TRUE(sut.until([&] {
    note();
    EXPECT_EQ(job.interrupted_count, 0);
    return job.state == JobState::Runs && job.line == 12;
  }));
  EXPECT_THAT(seen, ElementsAre("1 other:2", "2 other:3", "6 main:11", "1 main:11", "1 main:12"));
}

// They remain while the job is stopped, and end with it.
TEST_F(JobReports, Interrupts_that_wait_are_named_in_the_order_in_which_they_are_served) {
  JobMachine sut(
      kInterruptPoints + "ON I1 CALL other\nON I2 CALL third\nON I3 CALL second PRIORITY 7\nMOVJ A\nWAIT 1s\n",
      {{"other", "WAIT 1s\n"}, {"second", "WAIT 2s\n"}, {"third", "WAIT 0.1s\n"}});
  const JobReport& job = sut.cell.out.job;
  const auto pending = [&] {
    return std::vector<std::string>(job.pending.begin(), job.pending.begin() + job.pending_count);
  };
  ASSERT_TRUE(sut.until([&] { return job.line == 12; }));
  sut.signal("I3") = 1;
  ASSERT_TRUE(sut.until([&] { return std::string_view(job.called) == "second"; }));
  EXPECT_THAT(pending(), ElementsAre());
  sut.signal("I2") = 1;
  sut.step();
  EXPECT_THAT(pending(), ElementsAre("third"));
  sut.signal("I1") = 1;
  sut.step();
  EXPECT_THAT(pending(), ElementsAre("other", "third"));
  sut.cell.ask(Service::JobStop);
  ASSERT_TRUE(sut.until([&] { return sut.cell.out.state == GroupState::Standby; }));
  EXPECT_EQ(job.state, JobState::Idle);
  EXPECT_THAT(interrupted(job), ElementsAre("main:12"));
  EXPECT_THAT(pending(), ElementsAre("other", "third"));
  sut.cell.ask(Service::JobResume);
  ASSERT_TRUE(sut.until([&] { return std::string_view(job.called) == "other"; }));
  EXPECT_THAT(pending(), ElementsAre("third"));
  EXPECT_THAT(interrupted(job), ElementsAre("main:12"));
  ASSERT_TRUE(sut.until([&] { return sut.ended(); }));
  EXPECT_EQ(job.state, JobState::Ended);
  EXPECT_EQ(job.interrupted_count + job.pending_count, 0);
}

TEST(JobReport, More_interrupts_than_can_be_named_are_counted) {
  std::string main;
  for (int i = 0; i < 12; ++i) {
    main += "ON I1 CALL other\n";
  }
  const ReadJobs read = parse_jobs({{"main.job", main + "WAIT 1s\n"}, {"other.job", "WAIT 1s\n"}});
  ASSERT_TRUE(read.diagnostics.empty()) << base::to_text(read.diagnostics);
  World world(read.book.signals);
  JobRunner sut(read.book);
  sut.start(0);
  sut.step(0.01, world, world);
  world.values["I1"] = 1;
  sut.step(0.01, world, world);
  EXPECT_EQ(sut.report().pending_count, 11);
  EXPECT_STREQ(sut.report().pending.back(), "other");
}

}  // namespace
}  // namespace indurop::robot
