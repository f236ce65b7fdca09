// SPDX-License-Identifier: Apache-2.0
// The flow of jobs: SWITCH, EXIT, RAISE, the ELSE of a WAIT, results of jobs and the time that a job has run.
#include <gmock/gmock.h>

#include <string>
#include <utility>
#include <vector>

#include "job_world.h"

namespace indurop::robot {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Pair;

class Job_flow : public testing::Test {
 protected:
  Ended run(const std::vector<JobFile>& files, const std::map<std::string, double>& values = {}) {
    ReadJobs read = parse_jobs(files);
    EXPECT_TRUE(read.diagnostics.empty()) << base::to_text(read.diagnostics);
    book = std::move(read.book);
    World world(book.signals);
    world.values = values;
    const Ended ended = robot::run(book, world);
    written = world.written;
    return ended;
  }
  Ended run(const std::string& text, const std::map<std::string, double>& values = {}) {
    return run({{"a.job", text}}, values);
  }
  static std::string errors(const std::string& text) {
    return base::to_text(parse_jobs({{"a.job", text}}).diagnostics);
  }
  JobBook book;
  std::vector<std::pair<std::string, double>> written;
};

TEST_F(Job_flow, Switch_takes_the_first_case_that_matches) {
  const std::string text =
      "SWITCH part\nCASE 1\n  SET O = 10\nCASE 2, 3\n  SET O = 20\nCASE 3, part + 1\n  SET O = 30\nDEFAULT\n"
      "  SET O = 40\nEND\nSET DONE ON\n";
  for (const auto& [part, wanted] : std::vector<std::pair<double, double>>{{1, 10}, {2, 20}, {3, 20}, {4, 40}}) {
    EXPECT_EQ(run(text, {{"part", part}}).state, JobState::Ended);
    EXPECT_THAT(written, ElementsAre(Pair("O", wanted), Pair("DONE", 1))) << part;
  }
  run("VAR n = 7\nSWITCH n\nCASE 1\n  SET O ON\nEND\nSET DONE ON\n");
  EXPECT_THAT(written, ElementsAre(Pair("DONE", 1))) << "no case matches";
}

TEST_F(Job_flow, Exit_leaves_the_innermost_loop_of_any_kind) {
  run("LOOP\n  FOR i = 1 TO 9\n    WHILE ON\n      EXIT\n    END\n    IF i = 3\n      EXIT\n    END\n    SET O = i\n  "
      "END\n"
      "  EXIT\nEND\nLOOP 2\n  SET P ON\nEND\n");
  EXPECT_THAT(written, ElementsAre(Pair("O", 1), Pair("O", 2), Pair("P", 1), Pair("P", 1)));
}

TEST_F(Job_flow, A_wait_that_is_in_vain_takes_its_else) {
  const std::string text = "WAIT I4 TIMEOUT 0.1s ELSE\n  SET O = 1\nEND\nSET O = 2\n";
  EXPECT_EQ(run(text).state, JobState::Ended);
  EXPECT_THAT(written, ElementsAre(Pair("O", 1), Pair("O", 2)));
  EXPECT_EQ(run(text, {{"I4", 1}}).state, JobState::Ended);
  EXPECT_THAT(written, ElementsAre(Pair("O", 2)));
}

TEST_F(Job_flow, Raise_goes_to_the_nearest_recover_with_its_number) {
  EXPECT_EQ(run({{"a.job", "TRY\n  CALL b 12\nRECOVER\n  SET O = ERROR\n  RAISE ERROR + 1\nEND\n"},
                 {"b.job", "PARAM n\nRAISE n\n"}})
                .message,
            "a.job:5: error 13 was raised");
  EXPECT_THAT(written, ElementsAre(Pair("O", 12)));
}

TEST_F(Job_flow, Messages_are_texts_and_numbers) {
  EXPECT_EQ(run("VAR n = 2\nMESSAGE \"part # \", n + 1, \" of \", 1.5 * n, \": press I4\"\n").message,
            "part # 3 of 3: press I4");
  EXPECT_EQ(run("RAISE 12, \"no part at \", 0.5\n").message, "a.job:1: no part at 0.5");
  EXPECT_EQ(run("MESSAGE \"" + std::string(300, 'x') + "\", 1\n").message, std::string(159, 'x'));
  EXPECT_THAT(errors("MESSAGE\n"), HasSubstr("a.job:1:8: error: expected a text in quotes, or a number"));
  EXPECT_THAT(errors("MESSAGE \"open\n"), HasSubstr("a.job:1:9: error: expected a text in quotes"));
}

TEST_F(Job_flow, A_job_returns_a_value) {
  EXPECT_EQ(run({{"a.job", "VAR n = CALL larger 3, 4\nSET O = n\nn = CALL larger n * 2, -1\nSET O = n\n"},
                 {"larger.job", "PARAM a, b\nIF a > b\n  RETURN a\nEND\nRETURN b\n"}})
                .state,
            JobState::Ended);
  EXPECT_THAT(written, ElementsAre(Pair("O", 4), Pair("O", 8)));
  run({{"a.job",
        "PARAM n\nVAR f = 1\nIF n > 0\n  f = CALL a n - 1\n  f = f * n\nEND\nIF n = 0\nSET O = f\nEND\n"
        "RETURN f\n"}});
  EXPECT_THAT(written, ElementsAre(Pair("O", 1))) << "also of a job that calls itself";
}

TEST_F(Job_flow, A_result_that_is_missing_is_an_error_of_the_called_job) {
  EXPECT_EQ(run({{"a.job", "VAR n = CALL b 0\n"}, {"b.job", "PARAM x\nIF x > 1\n  RETURN x\nEND\n"}}).message,
            "b.job:2: this job ends without the value that its caller waits for; end it with RETURN and it");
  EXPECT_EQ(run({{"a.job", "TRY\nVAR n = CALL b 0\nRECOVER\nSET O ON\nEND\n"},
                 {"b.job", "PARAM x\nIF x > 1\n  RETURN x\nEND\n"}})
                .state,
            JobState::Ended);
  EXPECT_THAT(written, ElementsAre(Pair("O", 1)));
  EXPECT_THAT(base::to_text(parse_jobs({{"a.job", "VAR n = CALL b\n"}, {"b.job", "RETURN\n"}}).diagnostics),
              HasSubstr("a.job:1:14: error: job 'b' gives no value; end it with RETURN and the value"));
}

TEST_F(Job_flow, Time_is_that_of_the_job) {
  run("VAR begun = TIME\nWAIT 0.5s\nSET O = ROUND(1000 * (TIME - begun))\n");
  EXPECT_THAT(written, ElementsAre(Pair("O", 500)));
}

TEST_F(Job_flow, Mistakes_are_named_where_they_are) {
  const std::pair<const char*, const char*> cases[] = {
      {"CASE 1\n", "a.job:1:1: error: CASE without SWITCH"},
      {"DEFAULT\n", "a.job:1:1: error: DEFAULT comes once, after the CASEs of a SWITCH"},
      {"SWITCH 1\nDEFAULT\nEND\n", "a.job:2:1: error: DEFAULT comes once"},
      {"SWITCH 1\nCASE 1\nDEFAULT\nCASE 2\nEND\n", "a.job:4:1: error: CASE after DEFAULT"},
      {"SWITCH 1\nSET O ON\nCASE 1\nEND\n", "a.job:3:1: error: a statement between SWITCH and the first CASE"},
      {"SWITCH 1\nCASE\nEND\n", "a.job:2:5: error: expected a value"},
      {"SWITCH 1\nCASE 1\n", "a.job:1:1: error: SWITCH without END"},
      {"IF I4\nEXIT\nEND\n", "a.job:2:1: error: EXIT without LOOP, WHILE or FOR"},
      {"WAIT I4 ELSE\nEND\n", "a.job:1:9: error: ELSE follows a time"},
      {"WAIT I4 TIMEOUT 1s ELSE\n", "a.job:1:1: error: WAIT ... ELSE without END"},
      {"RAISE\n", "a.job:1:6: error: expected the number of the error"},
      {"ON TIME > 3 CALL a\n", "a.job:1:4: error: an interrupt monitors shared variables"},
  };
  for (const auto& [text, wanted] : cases) {
    EXPECT_THAT(errors(text), HasSubstr(wanted)) << text;
  }
}

}  // namespace
}  // namespace indurop::robot
