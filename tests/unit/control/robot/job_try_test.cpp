// SPDX-License-Identifier: Apache-2.0
// TRY and RECOVER: errors of a job's own lines and motions go on behind RECOVER, from rest, with the error's number;
// what a program cannot mend does not.
#include <gmock/gmock.h>

#include "job_world.h"
#include "limit_judge.h"

namespace indurop::robot {
namespace {

using testing::HasSubstr;

std::string errors_of_try(const std::string& text) {
  return base::to_text(parse_jobs({{"main.job", text}}).diagnostics);
}

TEST(Try, Errors_are_reported_with_their_place) {
  EXPECT_EQ(errors_of_try("TRY\nWAIT 1s\nRECOVER\nWAIT 2s\nEND\n"), "");
  EXPECT_EQ(errors_of_try("RECOVER\n"), "main.job:1:1: error: RECOVER without TRY\n");
  EXPECT_EQ(errors_of_try("IF ON\nRECOVER\nEND\n"), "main.job:2:1: error: RECOVER without TRY\n");
  EXPECT_EQ(errors_of_try("TRY\nRECOVER\nRECOVER\nEND\n"), "main.job:3:1: error: RECOVER without TRY\n");
  EXPECT_EQ(errors_of_try("\nTRY\nWAIT 1s\nEND\n"), "main.job:2:1: error: TRY without RECOVER\n");
  EXPECT_EQ(errors_of_try("TRY\nRECOVER\n"), "main.job:1:1: error: TRY without END\n");
}

struct TryOutcome {
  Ended ended;
  std::map<std::string, double> values;
};

TryOutcome outcome_of(const std::vector<JobFile>& files) {
  ReadJobs read = parse_jobs(files);
  EXPECT_TRUE(read.diagnostics.empty()) << base::to_text(read.diagnostics);
  World world(read.book.signals);
  const Ended ended = run(read.book, world);
  return {ended, world.values};
}

TEST(Try, A_wait_in_vain_and_a_value_that_is_none_go_on_behind_RECOVER) {
  for (const char* line : {"WAIT I1 TIMEOUT 0.1s", "VAR k = 1 / I1", "SET O1 = 1 / I9"}) {
    const TryOutcome done = outcome_of(
        {{"main.job", std::string("TRY\n") + line + "\nSET n = 1\nRECOVER\nSET m = ERROR\nEND\nSET z = 1\n"}});
    EXPECT_EQ(done.ended.state, JobState::Ended) << line;
    EXPECT_EQ(done.values.count("n"), 0U) << line;
    EXPECT_EQ(done.values.at("m"), static_cast<double>(ErrorCode::Line)) << line;
    EXPECT_EQ(done.values.at("z"), 1) << line;
    EXPECT_THAT(done.ended.message, HasSubstr("main.job:2:")) << line;
  }
}

TEST(Try, Without_an_error_RECOVER_is_passed_over) {
  const TryOutcome done = outcome_of({{"main.job", "TRY\nSET n = 1\nRECOVER\nSET m = 1\nEND\nSET z = 1\n"}});
  EXPECT_EQ(done.ended.state, JobState::Ended);
  EXPECT_EQ(done.values.count("m"), 0U);
  EXPECT_EQ(done.values.at("z"), 1);
}

TEST(Try, The_innermost_one_counts_also_around_calls_and_loops_and_not_in_its_own_RECOVER) {
  const TryOutcome inner = outcome_of(
      {{"main.job",
        "TRY\nLOOP 3\nTRY\nSET a = a + 1\nCALL bad\nRECOVER\nSET n = n + 1\nEND\nEND\nRECOVER\nSET m = 1\nEND\n"},
       {"bad.job", "LOOP\nLOOP\nSET b = 1 / I9\nEND\nEND\n"}});
  EXPECT_EQ(inner.ended.state, JobState::Ended) << inner.ended.message;
  EXPECT_EQ(inner.values.at("a"), 3);
  EXPECT_EQ(inner.values.at("n"), 3);
  EXPECT_EQ(inner.values.count("m"), 0U);
  const TryOutcome again =
      outcome_of({{"main.job", "TRY\nTRY\nSET a = 1 / I9\nRECOVER\nSET a = 1 / I9\nEND\nRECOVER\nSET m = 1\nEND\n"}});
  EXPECT_EQ(again.ended.state, JobState::Ended) << again.ended.message;
  EXPECT_EQ(again.values.at("m"), 1);
  const TryOutcome out = outcome_of({{"main.job", "TRY\nRECOVER\nSET m = 1\nEND\nSET a = 1 / I9\n"}});
  EXPECT_EQ(out.ended.state, JobState::Failed);
  const TryOutcome recovering = outcome_of({{"main.job", "TRY\nSET a = 1 / I9\nRECOVER\nSET a = 1 / I9\nEND\n"}});
  EXPECT_EQ(recovering.ended.state, JobState::Failed);
}

// P3 of the cell is 3 m away.
constexpr const char* kReach =
    "POINT A = POSE 500 -250 300 RPY 180 0 180\nPOINT B = POSE 500 -100 200 RPY 180 0 150\n"
    "TRY\nMOVJ A\nSPEED 200 mm/s\nMOVL B\nSET O1 ON BEFORE 20 mm\nMOVL P3\nSET O2 ON AFTER 1 mm\nMOVL A\n"
    "RECOVER\nSET O3 = ERROR\nMOVJ P1\nEND\n";

TEST(Try, A_place_out_of_reach_is_not_gone_to_and_the_way_before_it_is_ended) {
  Cell cell(kReach);
  ASSERT_TRUE(cell.serve(Service::GroupEnable));
  const auto& names = cell.sut->signals();
  const auto value = [&](const char* name) {
    return cell.values[std::find(names.begin(), names.end(), name) - names.begin()];
  };
  Judge judge(0.01);
  cell.in.service.job = 1;
  cell.ask(Service::JobStart);
  double x = 0;
  double y = 0;
  ASSERT_TRUE(cell.until([&] {
    EXPECT_EQ(judge.look(cell, 1), "");
    x = value("O3") == 0 ? cell.out.position[0] : x;
    y = value("O3") == 0 ? cell.out.position[1] : y;
    return cell.out.done == cell.in.service.number;
  }));
  EXPECT_EQ(cell.out.error, ErrorCode::Ok) << cell.out.job.message;
  EXPECT_EQ(cell.out.job.state, JobState::Ended);
  EXPECT_NEAR(x, 500, 1e-6);
  EXPECT_NEAR(y, -100, 1e-6);
  EXPECT_EQ(value("O1"), 1);
  EXPECT_EQ(value("O2"), 0);
  EXPECT_EQ(value("O3"), static_cast<double>(ErrorCode::Unreachable));
  EXPECT_NEAR(cell.out.command[0], 20, 1e-6);
  EXPECT_THAT(cell.out.job.message, HasSubstr("main.job:11: the target is out of reach"));
}

TEST(Try, Emergency_stops_and_drives_are_not_for_a_program_to_mend) {
  for (const bool emergency : {true, false}) {
    Cell cell(kReach);
    ASSERT_TRUE(cell.serve(Service::GroupEnable));
    cell.in.service.job = 1;
    cell.ask(Service::JobStart);
    ASSERT_TRUE(cell.until([&] { return cell.out.tool_speed > 100; }));
    cell.in.emergency = emergency;
    cell.in.drives[2].status = emergency ? cell.in.drives[2].status : Cell::kFault;
    ASSERT_TRUE(cell.until([&] { return cell.out.state == GroupState::ErrorStop; }));
    EXPECT_EQ(cell.out.error, emergency ? ErrorCode::Emergency : ErrorCode::Drive);
    EXPECT_EQ(cell.out.job.state, JobState::Failed);
  }
}

}  // namespace
}  // namespace indurop::robot
