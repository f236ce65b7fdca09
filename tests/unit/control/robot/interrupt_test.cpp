// SPDX-License-Identifier: Apache-2.0
// Interrupts of jobs (ON c CALL job): their lines and what is wrong with them; when they come and how often; and, at
// random instants of random motions, that the path goes on where it was left, with everything on it, within all limits.
#include <gmock/gmock.h>

#include <random>
#include <vector>

#include "interrupt_cell.h"
#include "job_world.h"

namespace indurop::robot {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

TEST(Interrupt, Errors_are_reported_with_their_place) {
  EXPECT_THAT(interrupt_errors("ON I1 CALL eject\nON I1 OFF AND count > 3 CALL eject\nOFF CALL eject\n"),
              ElementsAre());
  EXPECT_THAT(interrupt_errors("ON I1 CALL ejct\n"),
              ElementsAre("main.job:1:12: error: there is no job 'ejct'; did you mean 'eject'?\n"));
  EXPECT_THAT(interrupt_errors("ON I1 eject\n"),
              ElementsAre(HasSubstr("main.job:1:7: error: expected CALL and the name of a job, found 'eject'")));
  EXPECT_THAT(interrupt_errors("VAR n\nON n CALL eject\n"),
              ElementsAre("main.job:2:4: error: an interrupt monitors shared variables: no variables of the job, no "
                          "places, no TIME and TIPSPEED\n"));
  EXPECT_THAT(interrupt_errors("ON 1 CALL eject\n"),
              ElementsAre(HasSubstr("main.job:1:4: error: an interrupt monitors")));
  EXPECT_THAT(interrupt_errors("ON I1 CALL two\n"),
              ElementsAre("main.job:1:12: error: job 'two' takes 1 value, here are 0\n"));
  EXPECT_THAT(interrupt_errors("OFF eject\n"), ElementsAre(HasSubstr("main.job:1:5: error: expected CALL")));
  EXPECT_THAT(interrupt_errors("ON a+b+c+d+e+f+g+h+i > 1 CALL eject\n"),
              ElementsAre(HasSubstr("main.job:1:4: error: this")));
  std::string many;
  for (int i = 0; i < 129; ++i) {
    many += "ON I1 CALL eject\n";
  }
  EXPECT_THAT(interrupt_errors(many), ElementsAre(HasSubstr("main.job:129:1: error: there are more than 128 ON")));
  EXPECT_THAT(interrupt_errors("POINT A = POSE 500 0 300 RPY 180 0 0\nMOVC BACK A\n"),
              ElementsAre(HasSubstr("there is no point 'BACK'")));
  for (const char* const name : {"BACK", "here", "Found"}) {
    EXPECT_THAT(
        interrupt_errors(fmt::format("POINT {} = POSE 500 0 300 RPY 180 0 0\n", name)),
        ElementsAre(fmt::format("main.job:1:7: error: '{}' is a place that every job knows, so no point can have "
                                "this name\n",
                                name)));
  }
  EXPECT_THAT(interrupt_errors("movj back\nmovj here\nsearch here until i1\nmovj found\n"), ElementsAre());
  EXPECT_THAT(interrupt_errors("POINT A = JOINT 0 0 0 0 0 0\nMOVJ A OFFSET 0, 0, 1\n"),
              ElementsAre(HasSubstr("'A' has joint angles; say it as POSE (indurop robot teach A --pose)")));
}

struct Outcome {
  Ended ended;
  std::map<std::string, double> values;
};

// `each` sets the inputs of a period, of which there are 1000, 10 ms each.
template <class Each>
Outcome run_with(const std::vector<JobFile>& files, const Each& each) {
  ReadJobs read = parse_jobs(files);
  EXPECT_TRUE(read.diagnostics.empty()) << base::to_text(read.diagnostics);
  World world(read.book.signals);
  JobRunner sut(read.book);
  sut.start(0);
  for (int i = 0; i < 1000 && sut.running(); ++i) {
    each(i, world);
    sut.step(0.01, world, world);
  }
  const JobReport report = sut.report();
  return {{report.state, report.line, report.message}, world.values};
}

TEST(Interrupt, It_comes_once_for_each_rising_edge_and_not_while_it_is_off) {
  const Outcome done = run_with({{"main.job", "SET n = 0\nON I1 CALL other\nWAIT 5s\nOFF CALL other\nWAIT 1s\n"},
                                 {"other.job", "SET n = n + 1\n"}},
                                [](int i, World& w) {
                                  // On from the beginning does not count, and it is not watched in the end.
                                  w.values["I1"] = i < 100 || (i >= 200 && i < 300) || i == 310 || i >= 540 ? 1 : 0;
                                });
  EXPECT_EQ(done.ended.state, JobState::Ended) << done.ended.message;
  EXPECT_EQ(done.values.at("n"), 2);
}

TEST(Interrupt, An_edge_in_the_middle_of_serving_is_kept_once) {
  const Outcome done =
      run_with({{"main.job", "SET n = 0\nON I1 CALL other\nWAIT 3s\n"}, {"other.job", "SET n = n + 1\nWAIT 0.5s\n"}},
               [](int i, World& w) { w.values["I1"] = i == 100 || i == 110 || i == 120 ? 1 : 0; });
  EXPECT_EQ(done.ended.state, JobState::Ended) << done.ended.message;
  EXPECT_EQ(done.values.at("n"), 2);
}

TEST(Interrupt, Several_of_one_moment_come_in_the_order_of_their_lines_and_not_inside_of_each_other) {
  const Outcome done = run_with({{"main.job", "ON I2 CALL two\nON I1 CALL one\nWAIT 3s\n"},
                                 {"one.job", "SET n = n * 10 + 1\nWAIT 0.2s\nSET n = n * 10 + 2\n"},
                                 {"two.job", "SET n = n * 10 + 3\nWAIT 0.2s\nSET n = n * 10 + 4\n"}},
                                [](int i, World& w) { w.values["I1"] = w.values["I2"] = i >= 100 ? 1 : 0; });
  EXPECT_EQ(done.ended.state, JobState::Ended) << done.ended.message;
  EXPECT_EQ(done.values.at("n"), 3412);
}

// 2 s of waiting behind the interrupt's second; its speed, variables and loops are its own.
TEST(Interrupt, What_waited_goes_on_waiting_and_nothing_else_changes) {
  int ended_at = 0;
  const Outcome done = run_with({{"main.job", "VAR k = 7\nON I1 CALL other\nLOOP 2\nWAIT 1s\nEND\nSET n = k\n"},
                                 {"other.job", "VAR k = 1\nLOOP 3\nWAIT 0.5s\nk = k + 1\nEND\nSET m = k\n"}},
                                [&](int i, World& w) {
                                  w.values["I1"] = i == 50 ? 1 : 0;
                                  ended_at = i;
                                });
  EXPECT_EQ(done.ended.state, JobState::Ended) << done.ended.message;
  EXPECT_EQ(done.values.at("n"), 7);
  EXPECT_EQ(done.values.at("m"), 4);
  EXPECT_NEAR(ended_at, 350, 10);
}

TEST(Interrupt, It_is_refused_where_jobs_call_each_other_too_deep) {
  const Outcome done =
      run_with({{"main.job", "PARAM n\nIF n = 0\nON I1 CALL other\nEND\nIF n < 7\nCALL main n + 1\nEND\nWAIT 2s\n"},
                {"other.job", "SET m = 1\n"}},
               [](int i, World& w) { w.values["I1"] = i == 50 ? 1 : 0; });
  EXPECT_EQ(done.ended.state, JobState::Failed);
  EXPECT_THAT(done.ended.message, HasSubstr("main.job:8: an interrupt came here, but jobs call each other too deep"));
}

TEST(Interrupt, BACK_is_known_to_what_ON_has_called_only) {
  const Outcome done = run_with({{"main.job", "MOVJ BACK\n"}}, [](int, World&) {});
  EXPECT_EQ(done.ended.state, JobState::Failed);
  EXPECT_THAT(done.ended.message, HasSubstr("main.job:1: BACK is where an interrupt left the path"));
}

// ---- With the arm

constexpr const char* kServe = "SET busy ON\nSPEED 40%\nTOOL pen\nMOVJ H\nTOOL FLANGE\nMOVJ BACK\nSET busy OFF\n";

TEST(Interrupt, Anywhere_on_a_path_it_is_left_and_taken_up_within_all_limits) {
  const char* wanted = std::getenv("INDUROP_ROBOT_JOBS");
  const unsigned jobs = wanted == nullptr ? 12 : static_cast<unsigned>(std::atoi(wanted));
  int served = 0;
  int stops = 0;
  double farthest = 0;
  for (unsigned seed = 1; seed <= jobs; ++seed) {
    std::mt19937 random(seed);
    const std::string job = random_job("ON I1 CALL other\n", random);
    JobMachine calm(job, {{"other", kServe}});
    std::vector<Vec3> path;
    for (int i = 0; i < 20'000 && !calm.ended(); ++i) {
      calm.step();
      path.push_back(tip(calm.cell));
    }
    if (calm.cell.out.error != ErrorCode::Ok) {
      continue;  // not every way is possible
    }
    JobMachine sut(job, {{"other", kServe}});
    const auto happens = [&](double per_second) {
      return std::uniform_real_distribution<double>(0, 1)(random) < per_second * 0.01;
    };
    int emergencies = seed % 2 == 0 ? 2 : 0;
    bool returning = false;
    double before = 0;
    for (int i = 0; i < 40'000 && !sut.ended(); ++i) {
      sut.signal("I1") = happens(0.7) ? 1 : 0;
      sut.step();
      ASSERT_EQ(sut.broken, "") << "seed " << seed << "\n" << job;
      ASSERT_NE(sut.cell.out.state, GroupState::ErrorStop) << sut.cell.out.job.message << " seed " << seed << "\n"
                                                           << job;
      served += sut.signal("busy") > before ? 1 : 0;
      before = sut.signal("busy");
      returning = returning && sut.cell.out.job.state != JobState::Runs;
      if (before == 0 && !returning && i % 4 == 0) {
        farthest = std::max(farthest, away(path, tip(sut.cell)));
      }
      if (emergencies > 0 && sut.cell.out.state == GroupState::Moving && sut.cell.out.job.line != 0 && happens(0.5)) {
        --emergencies;
        ++stops;
        go_on(sut);
        returning = true;
        if (HasFatalFailure()) {
          return;
        }
      }
    }
    ASSERT_EQ(sut.cell.out.job.state, JobState::Ended) << sut.cell.out.job.message << " seed " << seed << "\n" << job;
    EXPECT_LT((tip(sut.cell) - tip(calm.cell)).norm(), 1e-3) << "seed " << seed;
    EXPECT_EQ(sut.set, calm.set) << "seed " << seed << "\n" << job;
  }
  fmt::print("{} interrupts and {} emergency stops; at most {:.4f} mm from the path without them\n", served, stops,
             farthest);
  EXPECT_GT(served, static_cast<int>(jobs));
  EXPECT_LT(farthest, 0.2);  // arcs are cut short between places 10 ms apart
}

// Where the path was left the tip is on it; the offset is seen from there.
TEST(Interrupt, The_tool_is_drawn_back_from_where_the_path_was_left) {
  struct Case {
    const char* line;
    Vec3 by;  // mm in the base: the tool looks down, turned about z
  };
  for (const Case& each :
       {Case{"MOVL BACK OFFSET TOOL 0, 0, -50\n", {0, 0, 50}}, Case{"MOVL BACK OFFSET 20, 0, 30\n", {20, 0, 30}},
        Case{"TOOL pen\nMOVL BACK OFFSET TOOL 0, 0, -50\nTOOL FLANGE\n", {0, 0, 50}},
        Case{"MOVJ BACK OFFSET 0, 0, 40\n", {0, 0, 40}}}) {
    JobMachine sut(kInterruptPoints + "ON I1 CALL other\nMOVJ A\nSPEED 100 mm/s\nMOVL B\nSET out = 1\n",
                   {{"other", "SET busy ON\nWAIT 0.1s\nSPEED 30%\n" + std::string(each.line) +
                                  "SET busy = 2\nWAIT 0.2s\nMOVL BACK\nSET busy OFF\n"}});
    ASSERT_TRUE(sut.until([&] { return sut.cell.out.job.line == 11 && sut.cell.out.tool_speed > 90; }));
    sut.signal("I1") = 1;
    ASSERT_TRUE(sut.until([&] { return sut.signal("busy") == 1; }));
    const Vec3 left = tip(sut.cell);
    ASSERT_TRUE(sut.until([&] { return sut.signal("busy") == 2; })) << sut.cell.out.job.message;
    EXPECT_LT((tip(sut.cell) - left - each.by).norm(), 1e-6) << each.line;
    ASSERT_TRUE(sut.until([&] { return sut.ended(); }));
    EXPECT_EQ(sut.cell.out.job.state, JobState::Ended) << sut.cell.out.job.message;
    EXPECT_EQ(sut.broken, "");
  }
}

// Behind it, the report names the interrupted job again.
TEST(Interrupt, A_job_that_was_interrupted_is_the_one_that_is_reported) {
  JobMachine sut(kInterruptPoints + "ON I1 CALL other\nMOVJ A\nSPEED 100 mm/s\nMOVL B\n", {{"other", "WAIT 0.1s\n"}});
  ASSERT_TRUE(sut.until([&] { return sut.cell.out.job.line == 11 && sut.cell.out.tool_speed > 90; }));
  sut.signal("I1") = 1;
  ASSERT_TRUE(sut.until([&] { return std::string_view(sut.cell.out.job.called) == "other"; }));
  ASSERT_TRUE(
      sut.until([&] { return std::string_view(sut.cell.out.job.called) == "main" && sut.cell.out.tool_speed > 90; }));
  ASSERT_TRUE(sut.until([&] { return sut.ended(); }));
  EXPECT_EQ(sut.cell.out.job.state, JobState::Ended);
  EXPECT_STREQ(sut.cell.out.job.called, "main");
  EXPECT_EQ(sut.cell.out.job.line, 11U);
}

TEST(Interrupt, One_that_ends_far_from_the_path_stops_the_job_with_what_to_do) {
  JobMachine sut(kInterruptPoints + "ON I1 CALL other\nMOVJ A\nSPEED 100 mm/s\nMOVL B\nSET out = 1\n",
                 {{"other", "SET busy ON\nMOVJ D\n"}});
  ASSERT_TRUE(sut.until([&] { return sut.cell.out.job.line == 11 && sut.cell.out.tool_speed > 90; }));
  sut.signal("I1") = 1;
  ASSERT_TRUE(sut.until([&] { return sut.cell.out.state == GroupState::ErrorStop; }));
  EXPECT_EQ(sut.cell.out.error, ErrorCode::Away);
  EXPECT_THAT(sut.cell.out.job.message, HasSubstr("other.job:2: this job was called by ON and has ended too far"));
  EXPECT_FALSE(sut.cell.out.job.can_resume);
  EXPECT_EQ(sut.broken, "");
}

TEST(Interrupt, A_hold_lets_it_wait) {
  JobMachine sut(kInterruptPoints + "ON I1 CALL other\nMOVJ A\nSPEED 100 mm/s\nMOVL B\nSET out = 1\n",
                 {{"other", kServe}});
  ASSERT_TRUE(sut.until([&] { return sut.cell.out.job.line == 11 && sut.cell.out.tool_speed > 90; }));
  sut.cell.in.hold = true;
  ASSERT_TRUE(sut.until([&] { return sut.cell.out.tool_speed < 1e-9; }));
  sut.signal("I1") = 1;
  for (int i = 0; i < 100; ++i) {
    sut.step();
    ASSERT_EQ(sut.signal("busy"), 0);
    ASSERT_LT(sut.cell.out.tool_speed, 1e-9);
  }
  sut.cell.in.hold = false;
  ASSERT_TRUE(sut.until([&] { return sut.signal("busy") == 1; }));
  ASSERT_TRUE(sut.until([&] { return sut.ended(); }));
  EXPECT_EQ(sut.cell.out.job.state, JobState::Ended) << sut.cell.out.job.message;
}

}  // namespace
}  // namespace indurop::robot
