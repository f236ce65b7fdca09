// SPDX-License-Identifier: Apache-2.0
// Variables, expressions and blocks of jobs.
#include <gmock/gmock.h>

#include <string>
#include <utility>
#include <vector>

#include "job_world.h"

namespace indurop::robot {
namespace {

using testing::HasSubstr;

std::string errors_of_line(const std::vector<JobFile>& files) {
  return base::to_text(parse_jobs(files).diagnostics);
}
std::string errors_of_line(const std::string& text) {
  return errors_of_line({{"a.job", text}});
}

double result_of(const std::string& expression, double i4 = 0) {
  const auto [book, errors] = parse_jobs({{"a.job", "VAR n = 7\nVAR half = 0.5\nSET OUT = " + expression + "\n"}});
  EXPECT_TRUE(errors.empty()) << base::to_text(errors);
  World world(book.signals);
  world.values["I4"] = i4;
  EXPECT_EQ(run(book, world).state, JobState::Ended) << expression;
  return world.values["OUT"];
}

TEST(JobLanguage, Expressions_bind_as_everywhere) {
  EXPECT_EQ(result_of("2 + 3 * 4"), 14);
  EXPECT_EQ(result_of("(2 + 3) * 4"), 20);
  EXPECT_EQ(result_of("10 - 2 - 3"), 5);
  EXPECT_EQ(result_of("n -1"), 6);
  EXPECT_EQ(result_of("n-1 * 3"), 4);
  EXPECT_EQ(result_of("-n + 1"), -6);
  EXPECT_EQ(result_of("- (n + 1) * -2"), 16);
  EXPECT_EQ(result_of("n MOD 4 / half"), 6);
  EXPECT_EQ(result_of("n = 7 AND half < 1"), 1);
  EXPECT_EQ(result_of("NOT n = 7 OR I4"), 0);
  EXPECT_EQ(result_of("NOT n = 7 OR I4", 1), 1);
  EXPECT_EQ(result_of("I4 OFF AND n"), 1);
  EXPECT_EQ(result_of("I4 >= 5 AND NOT I4 > 6", 6), 1);
  EXPECT_EQ(result_of("ON"), 1);
}

TEST(JobLanguage, Blocks_and_calls_with_values) {
  const auto [book, errors] = parse_jobs({{"main.job",
                                           "VAR sum = 0\n"
                                           "FOR i = 1 TO 3\n"
                                           "  FOR k = 10 TO 0 STEP -5\n"
                                           "    CALL add i * 100 + k, 2\n"
                                           "  END\n"
                                           "END\n"
                                           "WHILE sum < 4\n"
                                           "  sum = sum + 1.5\n"
                                           "END\n"
                                           "SET sum_of_main = sum\n"
                                           "IF total = 0\n  SET way = 1\nELSEIF total = 3690\n  SET way = 2\n"
                                           "ELSE\n  SET way = 3\nEND\n"},
                                          {"add.job",
                                           "PARAM x, times\n"
                                           "IF x = 310\n  RETURN\nEND\n"
                                           "VAR sum = total + x * times  # not the sum of main\n"
                                           "SET total = sum\n"}});
  ASSERT_TRUE(errors.empty()) << base::to_text(errors);
  World world(book.signals);
  EXPECT_EQ(run(book, world).state, JobState::Ended);
  EXPECT_EQ(world.values["total"], 2 * (110 + 105 + 100 + 210 + 205 + 200 + 305 + 300));
  EXPECT_EQ(world.values["sum_of_main"], 4.5);
  EXPECT_EQ(world.values["way"], 3);
}

TEST(JobLanguage, Expressions_without_inputs_are_computed_ahead_of_the_motion) {
  const auto [book, errors] = parse_jobs(
      {{"a.job",
        "POINT A = JOINT 0 0 0 0 0 0\nFOR i = 1 TO 5\nMOVJ A\nIF i > 1\nMOVJ A\nEND\nEND\nIF I4\nMOVJ A\nEND\n"}});
  ASSERT_TRUE(errors.empty()) << base::to_text(errors);
  World world(book.signals);
  world.at_rest = false;
  world.values["I4"] = 1;
  JobRunner sut(book);
  sut.start(0);
  for (int i = 0; i < 10; ++i) {
    sut.step(0.001, world, world);
  }
  EXPECT_EQ(world.moves, 9) << "I4 is read at standstill";
  world.at_rest = true;
  sut.step(0.001, world, world);
  EXPECT_EQ(world.moves, 10);
}

TEST(JobLanguage, A_wait_takes_any_condition) {
  const auto [book, errors] = parse_jobs({{"a.job", "VAR n = 2\nWAIT I4 > n AND NOT I5 TIMEOUT 1s\nSET O1 ON\n"}});
  ASSERT_TRUE(errors.empty()) << base::to_text(errors);
  World world(book.signals);
  world.values["I4"] = 3;
  world.values["I5"] = 1;
  JobRunner sut(book);
  sut.start(0);
  sut.step(0.01, world, world);
  EXPECT_EQ(sut.report().state, JobState::Waits);
  world.values["I5"] = 0;
  sut.step(0.01, world, world);
  EXPECT_EQ(world.values["O1"], 1);
}

TEST(JobLanguage, What_has_no_value_ends_the_job_with_its_line) {
  for (const char* text : {"VAR n = 0\nSET O1 = 3 / n\n", "VAR n = 0\nVAR m = n MOD n\n",
                           "VAR n = 0\nIF 1 / n > 2\nEND\n", "VAR n = 0\nWAIT (1 / n)\n"}) {
    const auto [book, errors] = parse_jobs({{"a.job", text}});
    ASSERT_TRUE(errors.empty()) << base::to_text(errors);
    World world(book.signals);
    const Ended report = run(book, world);
    EXPECT_EQ(report.state, JobState::Failed) << text;
    EXPECT_EQ(report.line, 2U) << text;
    EXPECT_TRUE(world.written.empty());
  }
}

TEST(JobLanguage, A_job_that_calls_itself_for_ever_ends_with_its_line) {
  const auto [book, errors] = parse_jobs({{"a.job", "PARAM n\n\nCALL a n + 1\n"}});
  ASSERT_TRUE(errors.empty()) << base::to_text(errors);
  World world(book.signals);
  const Ended report = run(book, world);
  EXPECT_EQ(report.state, JobState::Failed);
  EXPECT_THAT(report.message, HasSubstr("a.job:3: jobs call each other too deep"));
}

TEST(JobLanguage, Mistakes_are_named_where_they_are) {
  const std::pair<const char*, const char*> cases[] = {
      {"n = 3\n", "a.job:1:1: error: this job has no variable 'n'; declare it, VAR n = 0"},
      {"VAR n = n + 1\nVAR n\n", "a.job:2:5: error: there is already a variable 'n'"},
      {"VAR a.b = 1\n", "a.job:1:5: error: expected the name of a variable"},
      {"VAR and = 1\n", "a.job:1:5: error: expected the name of a variable"},
      {"SET O1 = (2 + 3\n", "a.job:1:16: error: expected ')'"},
      {"SET O1 = 2 +\n", "a.job:1:13: error: expected a number, found the end of the line"},
      {"SET O1 = 2 3\n", "a.job:1:12: error: unexpected '3'"},
      {"IF I4\nSET O1\n", "a.job:1:1: error: IF without END"},
      {"ELSE\n", "a.job:1:1: error: ELSE without IF"},
      {"IF I4\nELSE\nELSE\nEND\n", "a.job:3:1: error: ELSE without IF"},
      {"WHILE I4\nELSEIF I5\nEND\n", "a.job:2:1: error: ELSEIF without IF"},
      {"END\n", "a.job:1:1: error: END without LOOP, IF, WHILE, FOR, SWITCH or TRY"},
      {"FOR i = 1\nEND\n", "a.job:1:10: error: expected TO and the last value"},
      {"FOR i = 1 TO 2 STEP 0\nEND\n", "a.job:1:16: error: a FOR with STEP 0 would never end"},
      {"SET O1\nPARAM x\n", "a.job:2:1: error: PARAM comes first in a job, once"},
      {"CALL a 1\n", "a.job:1:6: error: job 'a' takes 0 values, here is 1"},
      {"CALL a 1 2\n", "a.job:1:10: error: expected ',' and another value, found '2'"},
  };
  for (const auto& [text, wanted] : cases) {
    EXPECT_THAT(errors_of_line(text), HasSubstr(wanted)) << text;
  }
  std::string long_one = "SET O1 = 1";
  for (int i = 0; i < 60; ++i) {
    long_one += " + 1";
  }
  EXPECT_THAT(errors_of_line(long_one), HasSubstr("this expression is too long"));
  EXPECT_THAT(errors_of_line("SET O1 = " + std::string(40, '(') + "1" + std::string(40, ')')),
              HasSubstr("more than 10 brackets"));
}

}  // namespace
}  // namespace indurop::robot
