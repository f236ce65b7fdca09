// SPDX-License-Identifier: Apache-2.0
// Random jobs that ask, with random answers: right, wrong and late ones, while the job is stopped, held, interrupted
// and exchanged. A small model of a dialogue says for each answer whether it is taken, and what the job then writes.
// INDUROP_ROBOT_JOBS says how many jobs, INDUROP_ROBOT_SEED from which one on.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "group_cell.h"
#include "job_world.h"
#include "robot_fixture.h"

namespace indurop::robot {
namespace {

constexpr double kPeriod = 0.01;  // s
constexpr double kLate = 500;     // what the job writes after a time-out

class Chance {
 public:
  explicit Chance(unsigned seed) : random_(seed) {}
  int below(int many) { return std::uniform_int_distribution<int>(0, many - 1)(random_); }
  bool once_in(int many) { return below(many) == 0; }

 private:
  std::mt19937 random_;
};

// A question, with each of its answers written out.
struct Expected {
  std::string text;
  std::vector<double> answers;
  double timeout = 0;  // s; 0: none
  std::uint32_t number = 0;
  double asked = 0;  // s for which it was open
  bool is_answered = false;
};

Expected choice_question(Chance& chance, const std::string& text, std::string& job) {
  Expected one{text, {}};
  job += fmt::format("ASK n = \"{}\" CHOICE", text);
  const int count = 1 + chance.below(7);
  for (int i = 1; i <= count; ++i) {
    job += fmt::format("{} \"answer {}\"", i > 1 ? "," : "", i);
    one.answers.push_back(i);
  }
  return one;
}

Expected number_question(Chance& chance, const std::string& text, std::string& job) {
  Expected one{text, {}};
  const int quarters = 1 + chance.below(8);  // the step
  const int from = chance.below(40) - 20;
  const int count = 1 + chance.below(9);
  const double step = quarters / 4.0;
  const double beyond = chance.once_in(2) ? step / 2 : 0;  // the end need not be an answer
  job += fmt::format("ASK n = \"{}\" {} TO {}", text, from, from + (count - 1) * step + beyond);
  job += quarters == 4 && chance.once_in(2) ? "" : fmt::format(" STEP {}", step);
  for (int i = 0; i < count; ++i) {
    one.answers.push_back(from + i * step);
  }
  return one;
}

class Dialogue {
 public:
  explicit Dialogue(unsigned seed) : chance_(seed) {
    std::string job = "SET OUT = 0\nSET SUM = 0\nSET IRQ = 0\nON IRQ CALL inner\n";
    const int count = 2 + chance_.below(6);
    for (int i = 0; i < count; ++i) {
      const std::string text = fmt::format("q{}", i);
      if (chance_.once_in(2)) {
        job += chance_.once_in(2) ? "MOVJ P1\n" : "MOVJ P2 SPEED 50%\n";
      }
      Expected one = chance_.once_in(2) ? choice_question(chance_, text, job) : number_question(chance_, text, job);
      if (chance_.once_in(2)) {
        one.timeout = (10 + chance_.below(100)) * kPeriod;
        job += fmt::format(" TIMEOUT {}s ELSE\n  n = {}\nEND", one.timeout, kLate);
      }
      job += fmt::format("\nSET OUT = {} + n\n", 1000 * (i + 1));
      questions_.push_back(std::move(one));
    }
    text_ = std::move(job);
  }

  // Runs it to its end.
  void run() {
    Cell cell(text_, kPeriod * 1000, 0, true, {}, "", {{"inner", "ASK m = \"inner\" 1 TO 3\nSET SUM = SUM + m\n"}});
    ASSERT_TRUE(cell.serve(Service::GroupEnable));
    cell.in.service.job = 1;
    cell.ask(Service::JobStart);
    for (int i = 0; i < 60'000 && cell.out.job.state != JobState::Ended; ++i) {
      disturb(cell);
      const bool answers = !disturbed_ && chance_.once_in(12);
      const ErrorCode expected = answers ? answer(cell) : ErrorCode::Ok;
      if (chance_.once_in(50)) {
        ASSERT_TRUE(cell.exchange());
      }
      cell.step();
      if (answers) {
        ASSERT_EQ(cell.out.job.question.error, expected) << cell.out.job.question.reason << ", period " << i << "\n"
                                                         << text_;
        if (expected == ErrorCode::Ok) {
          ++taken;
        } else {
          ++rejected;
        }
      }
      check(cell);
      ASSERT_FALSE(testing::Test::HasFailure()) << "period " << i << "\n" << text_;
    }
    ASSERT_EQ(cell.out.job.state, JobState::Ended) << cell.out.job.message << "\n" << text_;
    EXPECT_EQ(written_, questions_.size());
    EXPECT_EQ(cell.values[kSum], sum_);
  }
  int taken = 0, rejected = 0, late = 0, stopped = 0;

 private:
  // In the order in which the job names them.
  static constexpr std::size_t kOut = 0, kSum = 1, kIrq = 2;

  // Stops and resumes; nothing else happens in such a period, so that it is clear what was first.
  void disturb(Cell& cell) {
    const bool runs = cell.out.job.state == JobState::Runs || cell.out.job.state == JobState::Waits ||
                      cell.out.job.state == JobState::Resumes;
    const bool serves = cell.out.done != cell.in.service.number;
    disturbed_ = true;
    if (!serves && cell.out.state == GroupState::ErrorStop) {
      cell.in.emergency = false;
      cell.ask(Service::GroupReset);
    } else if (!serves && cell.out.state == GroupState::Disabled) {
      cell.ask(Service::GroupEnable);
    } else if (!serves && cell.out.state == GroupState::Standby && cell.out.job.can_resume && chance_.once_in(20)) {
      cell.ask(Service::JobResume);
    } else if (cell.out.state == GroupState::Moving && runs && chance_.once_in(150)) {
      ++stopped;
      if (chance_.once_in(3)) {
        cell.in.emergency = true;
      } else {
        cell.ask(chance_.once_in(2) ? Service::JobStop : Service::GroupDisable);
      }
    } else if (chance_.once_in(100)) {
      cell.in.hold = !cell.in.hold;
    } else if (chance_.once_in(60)) {
      cell.values[kIrq] = cell.values[kIrq] == 0 ? 1 : 0;
    } else {
      disturbed_ = false;
    }
  }

  // Answers something, and says what becomes of it.
  ErrorCode answer(Cell& cell) {
    const double wrong[] = {0, -1000, 0.1, 77, std::numeric_limits<double>::quiet_NaN(), -HUGE_VAL};
    const bool is_open = open_ != nullptr;
    const std::vector<double>& good = is_open ? open_->answers : questions_.front().answers;
    const double value = chance_.once_in(2)
                             ? good[static_cast<std::size_t>(chance_.below(static_cast<int>(good.size())))]
                             : wrong[chance_.below(6)];
    const std::uint32_t number = chance_.once_in(3)
                                     ? static_cast<std::uint32_t>(chance_.below(static_cast<int>(last_) + 3))
                                     : (is_open ? open_->number : last_);
    cell.in.answer = {cell.out.job.question.acknowledged + 1, number, value};
    if (!is_open || number != open_->number) {
      return ErrorCode::State;
    }
    if (std::find(good.begin(), good.end(), value) == good.end()) {
      return ErrorCode::Value;
    }
    if (open_ == &inner_) {
      sum_ += value;
    } else {
      expected_out_ = 1000 * static_cast<double>(written_ + 1) + value;
    }
    open_->is_answered = open_ != &inner_;
    open_->number = 0;  // the next one of this text is another question
    return ErrorCode::Ok;
  }

  void check(const Cell& cell) {
    const QuestionReport& asked = cell.out.job.question;
    open_ = nullptr;
    if (cell.values[kOut] != out_) {
      out_ = cell.values[kOut];
      ASSERT_LT(written_, questions_.size());
      const Expected& answered = questions_[written_];
      if (out_ == 1000 * static_cast<double>(written_ + 1) + kLate) {
        EXPECT_GT(answered.timeout, 0) << "it does not time out";
        EXPECT_FALSE(answered.is_answered);
        EXPECT_NEAR(answered.asked, answered.timeout, 1.5 * kPeriod * (1 + stopped + interrupted_));
        ++late;
      } else {
        EXPECT_EQ(out_, expected_out_);
      }
      ++written_;
    }
    if (asked.number == 0) {
      return;
    }
    EXPECT_EQ(cell.out.tool_speed, 0) << "it moves while it asks";
    EXPECT_EQ(cell.out.job.state, JobState::Waits);
    const bool inner = std::string(asked.text) == inner_.text;
    ASSERT_TRUE(inner || written_ < questions_.size());
    Expected& expected = inner ? inner_ : questions_[written_];
    EXPECT_EQ(asked.text, expected.text);
    EXPECT_FALSE(expected.is_answered);
    if (expected.number == 0) {
      expected.number = ++last_;
      interrupted_ += inner ? 1 : 0;
    }
    EXPECT_EQ(asked.number, expected.number);
    expected.asked += kPeriod;
    open_ = &expected;
  }

  Chance chance_;
  std::string text_;
  std::vector<Expected> questions_;
  Expected inner_{"inner", {1, 2, 3}};
  Expected* open_ = nullptr;  // in the last period
  std::uint32_t last_ = 0;    // number of the last question
  std::size_t written_ = 0;   // number of questions whose result was written
  double out_ = 0, expected_out_ = 0, sum_ = 0;
  int interrupted_ = 0;
  bool disturbed_ = false;
};

TEST(Questions, An_answer_to_an_earlier_start_meets_none_of_the_next_one) {
  const ReadJobs read = parse_jobs({{"a.job", "LOOP 2\nASK n = \"n\" 1 TO 9\nSET O = n\nEND\n"}});
  World world(read.book.signals);
  JobRunner before(read.book, []() noexcept { return 7U; });
  JobRunner after(read.book, []() noexcept { return 4'294'967'295U; });
  QuestionReport asked;
  for (JobRunner* const sut : {&before, &after}) {
    sut->start(0);
    sut->step(kPeriod, world, world);
    ASSERT_NE(sut->open_question(), nullptr);
    sut->open_question()->report(asked);
    EXPECT_EQ(asked.number, sut == &before ? 7U : 4'294'967'295U);
  }
  char why[120] = "";
  EXPECT_EQ(after.open_question()->answer(7, 3, why), ErrorCode::State);
  EXPECT_EQ(after.open_question()->answer(asked.number, 3, why), ErrorCode::Ok);
  after.step(kPeriod, world, world);
  ASSERT_NE(after.open_question(), nullptr);
  after.open_question()->report(asked);
  EXPECT_EQ(asked.number, 1U) << "0 is no number";
}

TEST(Random_questions, Are_answered_as_the_model_says) {
  const int first = number_of("INDUROP_ROBOT_SEED", 1);
  const int jobs = number_of("INDUROP_ROBOT_JOBS", 20);
  int taken = 0;
  int rejected = 0;
  int late = 0;
  int stopped = 0;
  for (int i = 0; i < jobs && !HasFailure(); ++i) {
    Dialogue dialogue(static_cast<unsigned>(first + i));
    SCOPED_TRACE(fmt::format("seed {}", first + i));
    dialogue.run();
    taken += dialogue.taken;
    rejected += dialogue.rejected;
    late += dialogue.late;
    stopped += dialogue.stopped;
  }
  fmt::print("{} answers taken, {} rejected, {} questions timed out, {} stops\n", taken, rejected, late, stopped);
  EXPECT_GT(taken, 0);
  EXPECT_GT(rejected, 0);
}

}  // namespace
}  // namespace indurop::robot
