// SPDX-License-Identifier: Apache-2.0
// What a job runner consists of: the stack of called jobs, outputs on the path, interrupts, pauses.
#include <gmock/gmock.h>

#include "job_world.h"

namespace indurop::robot {
namespace {

using testing::ElementsAre;
using testing::Pair;

JobBook book_of(const std::vector<JobFile>& files) {
  ReadJobs read = parse_jobs(files);
  EXPECT_TRUE(read.diagnostics.empty()) << base::to_text(read.diagnostics);
  return std::move(read.book);
}

TEST(CallStack, Returns_to_the_step_where_a_job_was_left_with_its_variables) {
  const JobBook book = book_of({{"main.job", "CALL two\nWAIT 1s\n"}, {"two.job", "WAIT 1s\n"}});
  CallStack sut(book);
  sut.reset(0);
  sut.variables()[0] = 7;
  sut.advance();
  sut.call(1, {3});
  EXPECT_EQ(sut.job(), 1);
  EXPECT_EQ(sut.depth(), 1);
  EXPECT_EQ(sut.index(), 0);
  EXPECT_EQ(sut.variables()[0], 3);
  EXPECT_EQ(sut.step_at(0)->op, Op::WaitTime);
  sut.leave();
  EXPECT_EQ(sut.step(), nullptr);
  sut.return_to(0);
  EXPECT_EQ(sut.job(), 0);
  EXPECT_EQ(sut.index(), 1);
  EXPECT_EQ(sut.variables()[0], 7);
}

TEST(CallStack, Is_full_when_as_many_jobs_call_each_other_as_fit) {
  const JobBook book = book_of({{"main.job", "CALL main\n"}});
  CallStack sut(book);
  sut.reset(0);
  int called = 0;
  for (; !sut.is_full() && called < 100; ++called) {
    sut.call(0, {});
  }
  EXPECT_EQ(called, CallStack::kMaxJobs - 1);
}

TEST(CallStack, A_loop_runs_as_often_as_it_says_and_once_if_a_jump_enters_it) {
  const JobBook book = book_of({{"main.job", "LOOP 3\n  WAIT 1s\nEND\n"}});
  const auto& steps = book.jobs[0].steps;
  ASSERT_EQ(steps.size(), 3U);
  const auto passes = [&](CallStack& sut) {
    int count = 0;
    while (sut.step() != nullptr && count < 100) {
      if (sut.step()->op == Op::End) {
        sut.end_loop(steps[2]);
      } else {
        count += sut.step()->op == Op::WaitTime ? 1 : 0;
        if (sut.step()->op == Op::Loop) {
          sut.begin_loop(steps[0]);
        }
        sut.advance();
      }
    }
    return count;
  };
  CallStack sut(book);
  sut.reset(0);
  EXPECT_EQ(passes(sut), 3);
  sut.reset(0);
  sut.jump(1);
  EXPECT_EQ(passes(sut), 1);
}

class Path_outputs : public testing::Test {
 protected:
  void step(const PathPlace& place, bool settled = false) { sut.step(0.1, place, settled, world, pulses); }
  const std::vector<std::string> names{"a", "b"};
  World world{names};
  Pulses pulses;
  PathOutputs sut;
};

TEST_F(Path_outputs, Are_set_at_their_distance_or_time) {
  sut.add({0, 1, 1, false, false, 0.2, 0});  // 0.2 m before the end
  sut.add({1, 2, 1, true, true, 0.25, 0});   // 0.25 s after the beginning
  step({1, 0, 1, 9});
  step({1, 0.5, 0.5, 9});
  step({1, 0.7, 0.3, 9});
  EXPECT_THAT(world.written, ElementsAre());
  step({1, 0.75, 0.25, 9});
  EXPECT_THAT(world.written, ElementsAre(Pair("b", 2)));
  step({1, 0.8, 0.2, 9});
  EXPECT_THAT(world.written, ElementsAre(Pair("b", 2), Pair("a", 1)));
  EXPECT_FALSE(sut.any());
}

TEST_F(Path_outputs, Are_set_after_their_motion_in_any_case) {
  sut.add({0, 1, 1, false, false, 0.2, 0});
  sut.add({1, 2, 2, false, false, 0.2, 0});
  step({1, 0, 1, 9});
  step({2, 0, 1, 9});
  EXPECT_THAT(world.written, ElementsAre(Pair("a", 1)));
  step({}, true);
  EXPECT_THAT(world.written, ElementsAre(Pair("a", 1), Pair("b", 2)));
}

TEST_F(Path_outputs, Of_a_motion_that_is_not_possible_and_of_later_ones_are_discarded) {
  sut.add({0, 1, 1, false, false, 0.2, 0});
  sut.add({1, 2, 2, false, false, 0.2, 0});
  sut.discard_from(2);
  step({}, true);
  EXPECT_THAT(world.written, ElementsAre(Pair("a", 1)));
}

TEST_F(Path_outputs, Are_rejected_when_too_many_wait) {
  int added = 0;
  while (added < 100 && sut.add({0, 1, 1, false, false, 0.2, 0})) {
    ++added;
  }
  EXPECT_EQ(added, 16);
  EXPECT_TRUE(sut.is_full());
  sut.clear();
  EXPECT_FALSE(sut.any());
}

TEST(Interrupts, Come_when_their_condition_becomes_true_and_are_served_in_the_order_of_the_book) {
  const JobBook book = book_of({{"main.job", "ON a CALL one\nON b CALL two\n"}, {"one.job", ""}, {"two.job", ""}});
  World world(book.signals);
  world.values["a"] = 1;
  Interrupts sut(book);
  sut.arm(0, world);
  sut.arm(1, world);
  sut.monitor(world);
  EXPECT_FALSE(sut.any_due()) << "it was true when it was armed";
  world.values["a"] = 0;
  world.values["b"] = 1;
  sut.monitor(world);
  world.values["a"] = 1;
  world.values["b"] = 0;
  sut.monitor(world);
  ASSERT_TRUE(sut.any_due());
  sut.begin_leaving();
  EXPECT_TRUE(sut.is(Interrupts::Phase::Leaving));
  EXPECT_EQ(sut.begin(), book.interrupts[0].job);
  sut.begin_return();
  sut.end();
  sut.monitor(world);
  ASSERT_TRUE(sut.any_due()) << "the other one came meanwhile";
  sut.begin_leaving();
  EXPECT_EQ(sut.begin(), book.interrupts[1].job);
  sut.end();
  EXPECT_FALSE(sut.any_due());
}

TEST(Interrupts, That_are_disarmed_do_not_come) {
  const JobBook book = book_of({{"main.job", "ON a CALL one\n"}, {"one.job", ""}});
  World world(book.signals);
  Interrupts sut(book);
  sut.arm(0, world);
  sut.disarm(book.interrupts[0].job);
  world.values["a"] = 1;
  sut.monitor(world);
  EXPECT_FALSE(sut.any_due());
}

TEST(LineBreakpoints, Come_before_the_first_step_of_each_line_and_not_twice_before_the_same) {
  const JobBook book = book_of({{"main.job", "WAIT 1s\nWAIT 2s\n"}});
  CallStack jobs(book);
  jobs.reset(0);
  LineBreakpoints sut;
  EXPECT_FALSE(sut.before(jobs));
  sut.set(true, {});
  EXPECT_TRUE(sut.before(jobs));
  sut.pass();
  EXPECT_FALSE(sut.before(jobs));
  sut.note(jobs);
  sut.note_end();
  jobs.advance();
  EXPECT_TRUE(sut.before(jobs));
}

TEST(LineBreakpoints, Come_before_lines_with_a_breakpoint_only) {
  const JobBook book = book_of({{"main.job", "WAIT 1s\nWAIT 2s\n"}});
  CallStack jobs(book);
  jobs.reset(0);
  LineBreakpoints sut;
  Breakpoints lines{};
  lines[0].job = 1;
  lines[0].line = 2;
  sut.set(false, lines);
  EXPECT_FALSE(sut.before(jobs));
  jobs.advance();
  EXPECT_TRUE(sut.before(jobs));
}

}  // namespace
}  // namespace indurop::robot
