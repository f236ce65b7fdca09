// SPDX-License-Identifier: Apache-2.0
// Schedules that say how long their modules execute: what holds, what does not, and what cannot be said.

#include "configuration.h"

namespace indurop::config {
namespace {

using std::chrono::microseconds;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

const CheckOptions kTimesOnly{.files = false, .adjust = false};

std::string wcet(const char* time) {
  return std::string("<wcet>") + time + "</wcet>";
}

TEST(Times, Are_not_checked_if_no_module_declares_its_execution_time) {
  const Checked sut = check(root(periodic("a.so", "1ms", 1)), kTimesOnly);
  EXPECT_EQ(sut.result.dispatch_share, 0);
  EXPECT_FALSE(sut.result.timings[0].known);
}

TEST(Times, Of_modules_and_platform_are_added) {
  const Checked sut =
      check(root("<spin>off</spin>" + periodic("a.so", "1ms", 1, wcet("200us")) +
                 periodic("b.so", "2ms", 2, wcet("300us")) + sporadic("e.so", "thread", 1, wcet("50us"))),
            kTimesOnly);
  EXPECT_THAT(sut.lines(), IsEmpty());
  // A tick takes 5 us, waking a thread 10.
  EXPECT_EQ(sut.result.timings[0].worst, base::Nanos(microseconds(205)));
  EXPECT_EQ(sut.result.timings[1].worst, base::Nanos(microseconds(515)));
  EXPECT_EQ(sut.result.timings[2].worst, base::Nanos(microseconds(575)));
  EXPECT_DOUBLE_EQ(sut.result.dispatch_share, 0.005);
}

TEST(Times, Spinning_takes_its_part) {
  const Checked sut = check(root(periodic("a.so", "1ms", 1, wcet("200us"))), kTimesOnly);
  EXPECT_EQ(sut.result.timings[0].worst, base::Nanos(microseconds(225)));
}

TEST(Times, A_deadline_that_cannot_be_met_is_an_error_with_the_numbers) {
  const Checked sut = check(root("<spin>off</spin>" + periodic("a.so", "1ms", 1, wcet("600us")) +
                                 periodic("b.so", "4ms", 2, wcet("300us") + "<deadline>900us</deadline>")),
                            kTimesOnly);
  EXPECT_FALSE(sut.result.ok());
  EXPECT_THAT(sut.lines(), ElementsAre(HasSubstr("error: b ends up to 915 us after its release, and its deadline is "
                                                 "900 us: it executes for 300 us")));
}

TEST(Times, Too_much_for_a_core_is_an_error_with_the_share) {
  const Checked sut = check(
      root("<spin>off</spin>" + periodic("a.so", "1ms", 1, wcet("600us")) + periodic("b.so", "1ms", 2, wcet("500us"))),
      kTimesOnly);
  EXPECT_EQ(sut.result.timings[1].worst, base::Nanos(-1));
  EXPECT_THAT(sut.lines(), ElementsAre(HasSubstr("b does not end before its next release: with the modules that run "
                                                 "before it, it needs 110 % of a core")));
}

TEST(Times, Of_several_cores_count_what_waits_for_another_one) {
  const auto lines = [](const std::string& settings) {
    // Without files all may share data.
    return check(root(settings + periodic("a.so", "1ms", 1, wcet("600us") + "<core>0</core>") +
                      periodic("b.so", "1ms", 2, wcet("500us") + "<core>1</core>")),
                 {.files = false})
        .lines();
  };
  EXPECT_THAT(lines("<order>data</order>"), ElementsAre(HasSubstr("error: b does not end before its next release")));
  EXPECT_THAT(lines("<order>total</order>"), ElementsAre(HasSubstr("error: b does not end before its next release")));
}

TEST(Times, With_a_core_that_the_node_chooses_it_is_a_warning) {
  const Checked sut = check(
      root(periodic("a.so", "1ms", 1, wcet("600us")) + periodic("b.so", "1ms", 2, wcet("500us") + "<core>1</core>")),
      {.files = false});
  EXPECT_TRUE(sut.result.ok());
  EXPECT_THAT(sut.lines(), ElementsAre(HasSubstr("as if all modules were on one core")));
}

TEST(Times, Behind_a_module_that_does_not_say_nothing_is_known) {
  const Checked sut = check(root(periodic("a.so", "1ms", 1) + periodic("b.so", "1ms", 2, wcet("900us"))), kTimesOnly);
  EXPECT_THAT(sut.lines(), IsEmpty());
  EXPECT_FALSE(sut.result.timings[1].known);
}

TEST(Times, What_takes_longer_than_its_period_is_refused_behind_any_module) {
  const Checked sut = check(root(periodic("a.so", "1ms", 1) + periodic("b.so", "1ms", 2, wcet("2ms"))), kTimesOnly);
  EXPECT_THAT(sut.lines(), ElementsAre(HasSubstr("error: b executes for 2 ms and has only 1 ms; shorten it")));
}

TEST(Times, That_were_measured_stand_in_for_those_not_declared) {
  const CheckOptions::Times measured{{"a", microseconds(250)}, {"b", microseconds(700)}};
  CheckOptions options = kTimesOnly;
  options.times = &measured;
  const Checked sut =
      check(root("<spin>off</spin>" + periodic("a.so", "1ms", 1) + periodic("b.so", "1ms", 2, wcet("100us"))), options);
  EXPECT_EQ(sut.result.timings[0].worst, base::Nanos(microseconds(255)));
  EXPECT_EQ(sut.result.timings[1].worst, base::Nanos(microseconds(355)));
}

TEST(Times, An_event_that_runs_after_the_base_may_come_with_any_release) {
  const Checked apart = check(root("<spin>off</spin>" + periodic("a.so", "2ms", 1, wcet("800us")) +
                                   periodic("b.so", "2ms", 2, wcet("800us") + "<offset>1ms</offset>")),
                              kTimesOnly);
  EXPECT_EQ(apart.result.timings[1].worst, base::Nanos(microseconds(815)));
  const Checked sut = check(root("<spin>off</spin>" + periodic("a.so", "2ms", 1, wcet("400us")) +
                                 periodic("b.so", "2ms", 2, wcet("400us") + "<offset>1ms</offset>") +
                                 sporadic("e.so", "thread", 1, wcet("50us") + "<position>after-base</position>")),
                            kTimesOnly);
  EXPECT_GE(sut.result.timings[1].worst, base::Nanos(microseconds(465)));
}

}  // namespace
}  // namespace indurop::config
