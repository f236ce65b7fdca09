// SPDX-License-Identifier: Apache-2.0
// Questions of jobs (ASK): their lines and what is wrong with them, which answers are taken and which are rejected, and
// what a question does while its job is interrupted, stopped and resumed.
#include <gmock/gmock.h>

#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "group_cell.h"
#include "job_world.h"

namespace indurop::robot {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Pair;

std::string ask_errors(const std::string& text) {
  return base::to_text(parse_jobs({{"a.job", text}}).diagnostics);
}

TEST(Ask, Mistakes_are_named_where_they_are) {
  const std::pair<const char*, const char*> cases[] = {
      {"ASK\n", "a.job:1:4: error: expected '=', found the end of the line; ASK n = \"How many parts?\" 1 TO 40"},
      {"ASK n \"text\" 1 TO 2\n", "a.job:1:7: error: expected '=', found '\"text\"'"},
      {"ASK n = \"text\"\n",
       "a.job:1:15: error: expected the answers, CHOICE \"yes\", \"no\", or their range, 1 TO 40"},
      {"ASK n = 1 TO\n", "a.job:1:11: error: expected CHOICE, or the smallest answer"},
      {"ASK n = \"text\" 5\n", "a.job:1:17: error: expected TO and the largest answer, found the end of the line"},
      {"ASK n = \"text\" 5 TO 4\n", "a.job:1:16: error: no number is in this range; the smaller one comes first"},
      {"ASK n = \"text\" 1 TO 4 STEP 0\n", "a.job:1:28: error: answers are apart by more than 0; STEP 0.1"},
      {"ASK n = \"text\" CHOICE\n", "a.job:1:22: error: expected an answer in quotes, found the end of the line"},
      {"ASK n = \"text\" CHOICE \"a\", 4\n", "a.job:1:28: error: expected an answer in quotes, found '4'"},
      {"ASK n = \"text\" CHOICE \"a\", \"a\"\n", "a.job:1:28: error: there is already an answer 'a'"},
      {"ASK n = \"text\" CHOICE \"\"\n", "a.job:1:23: error: an answer has 1 to 31 bytes"},
      {"ASK n = \"text\" CHOICE \"a\", \"b\", \"c\", \"d\", \"e\", \"f\", \"g\", \"h\"\n",
       "a.job:1:58: error: more than 7 answers; ask for a number, 1 TO 20"},
      {"VAR n[3]\nASK n = \"text\" 1 TO 4\n", "a.job:2:5: error: 'n' is an array; ask for a variable"},
      {"ASK 7 = \"text\" 1 TO 4\n", "a.job:1:5: error: expected the name of a variable"},
      {"ASK n = \"text\" 1 TO 4 ELSE\nEND\n", "a.job:1:23: error: ELSE follows a time, TIMEOUT 30s ELSE; an ASK"},
      {"ASK n = \"text\" 1 TO 4 TIMEOUT 1s ELSE\n", "a.job:1:1: error: ASK ... ELSE without END"},
      {"ASK n = \"text\" 1 TO 4 TIMEOUT\n", "a.job:1:30: error: expected a time"},
      {"ASK n = \"text\" 1 TO 4 yes\n", "a.job:1:23: error: unexpected 'yes'; one statement per line"},
      {"SWITCH 1\nCASE 1\nEND\nAKS n = 4\n", "a.job:4:1: error: unknown statement 'AKS'; known are"},
  };
  for (const auto& [text, wanted] : cases) {
    EXPECT_THAT(ask_errors(text), HasSubstr(wanted)) << text;
  }
  EXPECT_EQ(ask_errors("ASK \"Ready?\" CHOICE \"go on\"\nask n = \"n\", 1, \" of \", I4 choice \"a\" timeout 2s\n"
                       "ASK n = \"n\" 0 TO I4 * 2 STEP 0.5 TIMEOUT 200 ms ELSE\nn = 3\nEND\nSET O = n\n"),
            "");
}

// A job without a robot.
struct Asking {
  explicit Asking(const std::vector<JobFile>& files)
      : read(parse_jobs(files)), world(read.book.signals), sut(read.book) {
    EXPECT_TRUE(read.diagnostics.empty()) << base::to_text(read.diagnostics);
    sut.start(0);
  }
  explicit Asking(const std::string& text) : Asking({{"a.job", text}}) {}

  void step(int periods = 1) {
    for (int i = 0; i < periods; ++i) {
      sut.step(0.01, world, world);
    }
  }
  QuestionReport open() {
    QuestionReport report;
    if (const OpenQuestion* question = sut.open_question()) {
      question->report(report);
    }
    return report;
  }
  ErrorCode answer(std::uint32_t number, double value) {
    OpenQuestion* const question = sut.open_question();
    return question == nullptr ? ErrorCode::State : question->answer(number, value, why);
  }
  ReadJobs read;
  World world;
  JobRunner sut;
  char why[120] = "";
};

TEST(Ask, A_choice_gives_its_number) {
  Asking job(
      "VAR part = 4\nASK tray = \"Tray of part \", part, \"?\" CHOICE \"left\", \"right\", \"none\"\nSET O = tray\n");
  job.step();
  const QuestionReport asked = job.open();
  EXPECT_EQ(asked.number, 1U);
  EXPECT_STREQ(asked.text, "Tray of part 4?");
  EXPECT_EQ(asked.count, 3U);
  EXPECT_STREQ(asked.choices[2], "none");
  EXPECT_STREQ(asked.choices[3], "");
  EXPECT_EQ(asked.lower, 1);
  EXPECT_EQ(asked.upper, 3);
  EXPECT_EQ(asked.left, 0);
  for (const double wrong : {0.0, 4.0, 1.5, -1.0, std::numeric_limits<double>::quiet_NaN(), HUGE_VAL}) {
    EXPECT_EQ(job.answer(1, wrong), ErrorCode::Value) << wrong;
  }
  EXPECT_EQ(job.answer(2, 1), ErrorCode::State);
  EXPECT_STREQ(job.why, "question 2 is not open, question 1 is");
  EXPECT_EQ(job.answer(0, 1), ErrorCode::State);
  job.step(100);
  EXPECT_EQ(job.open().number, 1U) << "what was rejected changes nothing";
  EXPECT_EQ(job.sut.state(), JobState::Waits);
  EXPECT_EQ(job.answer(1, 2), ErrorCode::Ok);
  EXPECT_EQ(job.open().number, 0U);
  EXPECT_EQ(job.answer(1, 3), ErrorCode::State) << "it was answered";
  job.step();
  EXPECT_THAT(job.world.written, ElementsAre(Pair("O", 2)));
}

TEST(Ask, A_number_is_in_its_range_and_on_its_steps) {
  struct Range {
    const char* text;
    std::vector<double> good, wrong;
  };
  const Range ranges[] = {
      {"1 TO 40", {1, 17, 40, 1 + 1e-12}, {0, 41, 1.5, 40.001}},
      {"-2 TO 0.25 STEP 0.25", {-2, -0.75, 0, 0.25}, {0.3, -2.25, 0.5}},
      {"0 TO 0.3 STEP 0.1", {0, 0.1, 0.3}, {0.05, 0.4}},
      {"3 TO 3", {3}, {2, 4}},
      {"I4 TO 2 * I4 STEP 2", {5, 7, 9}, {4, 6, 10, 11}},
  };
  for (const Range& range : ranges) {
    for (const double good : range.good) {
      Asking job(std::string("ASK n = \"n\" ") + range.text + "\nSET O = n\n");
      job.world.values["I4"] = 5;
      job.step();
      for (const double wrong : range.wrong) {
        EXPECT_EQ(job.answer(1, wrong), ErrorCode::Value) << range.text << ": " << wrong;
        EXPECT_THAT(job.why, HasSubstr("question 1 takes "));
      }
      EXPECT_EQ(job.answer(1, good), ErrorCode::Ok) << range.text << ": " << good << job.why;
      job.step();
      ASSERT_EQ(job.world.written.size(), 1U);
      EXPECT_NEAR(job.world.written[0].second, good, 1e-11);
    }
  }
}

TEST(Ask, A_range_without_a_number_is_an_error_of_its_line) {
  Asking job("ASK n = \"n\" 1 TO I4\n");
  job.step();
  EXPECT_STREQ(job.sut.report().message,
               "a.job:1:13: no number is in the range of this question; check its ends before, with IF");
  Asking other("TRY\nASK n = \"n\", 1 / I4 1 TO 2\nRECOVER\nSET O = ERROR\nEND\nASK \"on\" CHOICE \"ok\"\n");
  other.step(3);
  EXPECT_THAT(other.world.written, ElementsAre(Pair("O", 15)));
  EXPECT_EQ(other.open().number, 1U) << "the one without a text was not asked";
}

TEST(Ask, Time_outs_are_those_of_a_wait) {
  Asking in_vain("ASK n = \"n\" 1 TO 2 TIMEOUT 0.1s\n");
  in_vain.step(4);
  EXPECT_NEAR(in_vain.open().left, 0.07, 1e-9);
  in_vain.step(20);
  EXPECT_EQ(in_vain.sut.state(), JobState::Failed);
  EXPECT_STREQ(in_vain.sut.report().message, "a.job:1: the question was not answered in time");
  EXPECT_EQ(in_vain.open().number, 0U);

  const std::string text = "VAR n = 7\nASK n = \"n\" 1 TO 2 TIMEOUT 0.1s ELSE\n  SET O = n\nEND\nSET P = n\n";
  Asking late(text);
  late.step(20);
  EXPECT_THAT(late.world.written, ElementsAre(Pair("O", 7), Pair("P", 7)));
  EXPECT_EQ(late.answer(1, 2), ErrorCode::State);
  Asking soon(text);
  soon.step(5);
  EXPECT_EQ(soon.answer(1, 2), ErrorCode::Ok);
  soon.step(20);
  EXPECT_THAT(soon.world.written, ElementsAre(Pair("P", 2)));
  Asking guarded("TRY\nASK n = \"n\" 1 TO 2 TIMEOUT 0.1s\nRECOVER\nASK m = \"m\" 1 TO 2\nSET O = m\nEND\n");
  guarded.step(20);
  EXPECT_EQ(guarded.open().number, 2U);
  EXPECT_EQ(guarded.answer(2, 1), ErrorCode::Ok);
  guarded.step();
  EXPECT_THAT(guarded.world.written, ElementsAre(Pair("O", 1)));
}

TEST(Ask, It_is_asked_at_standstill_and_not_before) {
  Asking job("ASK n = \"n\" 1 TO 2\n");
  job.world.at_rest = false;
  job.step(5);
  EXPECT_EQ(job.open().number, 0U);
  job.world.at_rest = true;
  job.step();
  EXPECT_EQ(job.open().number, 1U);
}

TEST(Ask, An_interrupt_closes_it_and_asks_its_own) {
  Asking job({{"a.job", "ON I1 CALL b\nASK n = \"outer\" 1 TO 9 TIMEOUT 10s\nSET O = n\n"},
              {"b.job", "ASK n = \"inner\" 1 TO 9\nSET P = n\nWAIT 0.1s\n"}});
  job.step(10);
  EXPECT_STREQ(job.open().text, "outer");
  const double left = job.open().left;
  job.world.values["I1"] = 1;
  job.step(2);
  EXPECT_STREQ(job.open().text, "inner");
  EXPECT_EQ(job.open().number, 2U);
  EXPECT_EQ(job.answer(1, 4), ErrorCode::State);
  EXPECT_EQ(job.answer(2, 8), ErrorCode::Ok);
  job.step(5);
  EXPECT_EQ(job.open().number, 0U) << "the interrupt goes on";
  job.step(20);
  EXPECT_STREQ(job.open().text, "outer");
  EXPECT_EQ(job.open().number, 1U);
  EXPECT_GT(job.open().left, left - 0.2) << "its time passes only while it is asked";
  EXPECT_EQ(job.answer(1, 4), ErrorCode::Ok);
  job.step();
  EXPECT_THAT(job.world.written, ElementsAre(Pair("P", 8), Pair("O", 4)));
}

// A robot that asks; what it writes is in values[0].
class Ask_robot : public testing::Test {
 protected:
  void begin(const std::string& job) {
    cell = std::make_unique<Cell>(job);
    ASSERT_TRUE(cell->serve(Service::GroupEnable));
    cell->in.service.job = 1;
    cell->ask(Service::JobStart);
  }
  const QuestionReport& question() const { return cell->out.job.question; }
  bool until_asked() {
    return cell->until([&] { return question().number != 0; });
  }
  // The result of the answer.
  ErrorCode answer(std::uint32_t number, double value) {
    cell->in.answer = {question().acknowledged + 1, number, value};
    cell->step();
    EXPECT_EQ(question().acknowledged, cell->in.answer.number);
    return question().error;
  }
  bool until_ended() {
    return cell->until([&] { return cell->out.done == cell->in.service.number; });
  }
  std::unique_ptr<Cell> cell;
};

TEST_F(Ask_robot, Stands_while_it_asks) {
  begin("MOVJ P1\nASK n = \"n\" 1 TO 9\nSET O = n\nMOVL P2\n");
  EXPECT_EQ(answer(1, 4), ErrorCode::State) << "it moves";
  EXPECT_STREQ(question().reason, "no question is open");
  ASSERT_TRUE(until_asked());
  EXPECT_NEAR(cell->out.command[0], 20, 1e-9);
  for (int i = 0; i < 100; ++i) {
    cell->step();
    EXPECT_EQ(cell->out.tool_speed, 0);
    EXPECT_EQ(cell->out.state, GroupState::Moving);
  }
  EXPECT_EQ(answer(1, 10), ErrorCode::Value);
  EXPECT_STREQ(question().reason, "question 1 takes 1 to 9 in steps of 1, not 10");
  EXPECT_EQ(answer(1, 4), ErrorCode::Ok);
  EXPECT_STREQ(question().reason, "");
  ASSERT_TRUE(until_ended());
  EXPECT_EQ(cell->out.error, ErrorCode::Ok);
  EXPECT_EQ(cell->values[0], 4);
}

TEST_F(Ask_robot, Takes_an_answer_once_and_none_from_before_it_started) {
  cell = std::make_unique<Cell>("ASK n = \"n\" 1 TO 9\nSET O = n\nASK n = \"n\" 1 TO 9\nSET O = n\n");
  EXPECT_EQ(question().acknowledged, 0U);
  Cell before("ASK n = \"n\" 1 TO 9\n");
  before.in.answer = {5, 1, 3};
  before.sut = controller_of(cell_urdf(), "ASK n = \"n\" 1 TO 9\n");
  before.step();
  EXPECT_EQ(before.out.job.question.acknowledged, 5U);
  EXPECT_EQ(before.out.job.question.error, ErrorCode::Aborted);
  ASSERT_TRUE(cell->serve(Service::GroupEnable));
  cell->in.service.job = 1;
  cell->ask(Service::JobStart);
  ASSERT_TRUE(until_asked());
  EXPECT_EQ(answer(1, 4), ErrorCode::Ok);
  ASSERT_TRUE(until_asked());
  for (int i = 0; i < 50; ++i) {
    cell->step();
  }
  EXPECT_EQ(question().number, 2U) << "the same answer does not count for the next question";
  EXPECT_EQ(answer(1, 5), ErrorCode::State);
  EXPECT_STREQ(question().reason, "question 1 is not open, question 2 is");
  cell->in.answer.known = false;
  cell->in.answer.number += 1;
  cell->in.answer.question = 2;
  cell->step();
  EXPECT_EQ(question().number, 2U) << "it is not known whether this answer is a new one";
}

TEST_F(Ask_robot, Asks_again_after_every_kind_of_stop) {
  const std::function<void(Cell&)> stops[] = {
      [](Cell& c) { c.ask(Service::JobStop); },
      [](Cell& c) { c.ask(Service::Stop); },
      [](Cell& c) { c.ask(Service::GroupDisable); },
      [](Cell& c) { c.in.emergency = true; },
      [](Cell& c) { c.in.drives[2].status = Cell::kFault; },
  };
  for (const auto& stop : stops) {
    begin("MOVJ P1\nASK n = \"n\" 1 TO 9 TIMEOUT 10s\nSET O = n\nMOVL P2\n");
    ASSERT_TRUE(until_asked());
    for (int i = 0; i < 10; ++i) {
      cell->step();
    }
    const double left = question().left;
    stop(*cell);
    ASSERT_TRUE(cell->until([&] { return question().number == 0; }));
    EXPECT_EQ(answer(1, 4), ErrorCode::State);
    EXPECT_STREQ(question().reason, "no question is open");
    ASSERT_TRUE(
        cell->until([&] { return cell->out.state != GroupState::Moving && cell->out.state != GroupState::Stopping; }));
    cell->in.emergency = false;
    for (int i = 0; i < 200; ++i) {
      cell->step();
    }
    ASSERT_TRUE(cell->serve(Service::GroupReset));
    if (cell->out.state == GroupState::Disabled) {
      ASSERT_TRUE(cell->serve(Service::GroupEnable));
    }
    cell->ask(Service::JobResume);
    ASSERT_TRUE(until_asked());
    EXPECT_EQ(question().number, 1U) << "it is the same question";
    EXPECT_GT(question().left, left - 0.05);
    EXPECT_EQ(answer(1, 6), ErrorCode::Ok);
    ASSERT_TRUE(until_ended());
    EXPECT_EQ(cell->out.error, ErrorCode::Ok) << cell->out.job.message;
    EXPECT_EQ(cell->values[0], 6);
  }
}

TEST_F(Ask_robot, Another_job_and_a_step_back_ask_another_question) {
  begin("MOVJ P1\nASK n = \"n\" 1 TO 9\nSET O = n\n");
  ASSERT_TRUE(until_asked());
  cell->in.single_step = true;
  ASSERT_TRUE(until_ended());
  EXPECT_EQ(cell->out.job.state, JobState::Paused);
  EXPECT_EQ(answer(1, 3), ErrorCode::State) << "it pauses";
  ASSERT_TRUE(cell->serve(Service::JobBack)) << to_string(cell->out.error);
  cell->in.single_step = false;
  cell->ask(Service::JobResume);
  ASSERT_TRUE(until_asked());
  EXPECT_EQ(question().number, 2U);
  ASSERT_TRUE(cell->serve(Service::JobStop));
  cell->ask(Service::JobStart);
  ASSERT_TRUE(until_asked());
  EXPECT_EQ(question().number, 3U);
  EXPECT_EQ(answer(3, 3), ErrorCode::Ok);
  ASSERT_TRUE(until_ended());
  EXPECT_EQ(cell->values[0], 3);
}

TEST_F(Ask_robot, Is_held_and_answered_meanwhile) {
  begin("ASK n = \"n\" 1 TO 9\nSET O = n\nMOVJ P1\n");
  ASSERT_TRUE(until_asked());
  cell->in.hold = true;
  for (int i = 0; i < 10; ++i) {
    cell->step();
  }
  EXPECT_EQ(answer(1, 9), ErrorCode::Ok);
  for (int i = 0; i < 50; ++i) {
    cell->step();
  }
  EXPECT_EQ(cell->values[0], 9);
  EXPECT_NEAR(cell->out.command[0], 0, 1e-9) << "it is still held";
  cell->in.hold = false;
  ASSERT_TRUE(until_ended());
  EXPECT_NEAR(cell->out.command[0], 20, 1e-9);
}

TEST_F(Ask_robot, Survives_an_exchange_of_the_controller) {
  begin("MOVJ P1\nASK n = \"which \", 7 CHOICE \"left\", \"right\" TIMEOUT 20s\nSET O = n\n");
  ASSERT_TRUE(until_asked());
  for (int i = 0; i < 10; ++i) {
    ASSERT_TRUE(cell->exchange());
    cell->step();
    EXPECT_EQ(question().number, 1U);
    EXPECT_STREQ(question().text, "which 7");
    EXPECT_STREQ(question().choices[1], "right");
    EXPECT_NEAR(question().left, 20 - 0.01 * (i + 1), 0.011);
  }
  EXPECT_EQ(answer(1, 3), ErrorCode::Value);
  ASSERT_TRUE(cell->exchange());
  cell->step();
  EXPECT_EQ(question().error, ErrorCode::Value);
  EXPECT_THAT(question().reason, HasSubstr("question 1 takes 1 to 2"));
  EXPECT_EQ(answer(1, 2), ErrorCode::Ok);
  ASSERT_TRUE(cell->exchange());
  ASSERT_TRUE(until_ended());
  EXPECT_EQ(cell->values[0], 2);
}

}  // namespace
}  // namespace indurop::robot
