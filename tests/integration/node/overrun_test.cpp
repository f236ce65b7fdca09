// SPDX-License-Identifier: Apache-2.0
// What happens when a module is not done by its next release, policy by policy, and what is said about it.

#include <csignal>

#include "node_fixture.h"

namespace indurop::test {
namespace {

using scheduler::ModuleState;

Module slow(const std::string& policy, const std::string& period = "1ms", const std::string& busy_us = "1500") {
  return {
      .file = "faulty.so",
      .name = "slow",
      .period = period,
      .priority = 2,
      .properties = {{"busy_us", busy_us}, {"every", "4"}},
      .more = "<overrun>" + policy + "</overrun><budget>off</budget><failsafe variable=\"nt::output\">-7</failsafe>"};
}
const Module kOverrunCounter = {.file = "counter.so", .name = "counter", .priority = 1};
// Makes the basic period shorter, so that the slow module gets a band of its own.
const Module kFast = {.file = "counter.so", .name = "fast", .period = "500us", .priority = 1};

class Overrun : public NodeTest {
 protected:
  void stop(Program& program) {
    program.signal(SIGTERM);
    EXPECT_EQ(program.wait(), 0);
  }
};

TEST_F(Overrun, Skip_leaves_out_releases_and_goes_on) {
  for (const auto& other : {kOverrunCounter, kFast}) {
    Program& sut = start_and_wait({other, slow("skip", "1ms", "2500")});
    EXPECT_TRUE(wait_until([&] { return module("slow").overruns.load() > 5 && module("slow").skipped.load() > 5; }));
    EXPECT_TRUE(runs_reach("slow", module("slow").runs.load() + 10));
    stop(sut);
    EXPECT_TRUE(sut.says("module slow: "));
    EXPECT_CONTAINS(sut.err(), "overrun");
  }
}

TEST_F(Overrun, Catch_up_makes_good_what_was_missed) {
  for (const auto& other : {kOverrunCounter, kFast}) {
    Program& sut = start_and_wait({other, slow("catch-up")});
    ASSERT_TRUE(wait_until([&] { return module("slow").overruns.load() > 20; }));
    stop(sut);
    const auto& record = module("slow");
    // Each overrun but those still open at the end was made good or counted as skipped.
    EXPECT_GE(record.runs.load() + record.skipped.load() + 20, record.overruns.load());
    const auto due = run()->tick.load() * static_cast<std::uint64_t>(run()->basic_period_ns) / 1'000'000U;
    EXPECT_GE(record.runs.load() + record.skipped.load() + 20, due);
  }
}

TEST_F(Overrun, Stop_module_shuts_it_out_and_writes_its_failsafe_values) {
  for (const auto& other : {kOverrunCounter, kFast}) {
    Program& sut = start_and_wait({other, slow("stop-module")});
    ASSERT_TRUE(wait_until([&] { return module("slow").state.load() == ModuleState::Faulted; }));
    EXPECT_TRUE(runs_reach(other.name, module(other.name).runs.load() + 50));
    EXPECT_EQ(module("slow").overruns.load(), 1U);
    EXPECT_TRUE(sut.says("policy stop-module"));
    EXPECT_TRUE(wait_until([&] { return value<std::int32_t>("nt::output") == -7; }))
        << value<std::int32_t>("nt::output");
    sut.signal(SIGTERM);
    EXPECT_EQ(sut.wait(), 1) << "a module faulted";
  }
}

TEST_F(Overrun, Stop_node_ends_the_run) {
  for (const auto& other : {kOverrunCounter, kFast}) {
    const auto sut = run_to_end({other, slow("stop-node")});
    EXPECT_EQ(sut.code, 1);
    EXPECT_CONTAINS(sut.err, "module slow: overrun (policy stop-node)");
    EXPECT_CONTAINS(sut.out, "counter stops after");
  }
}

TEST_F(Overrun, Record_names_module_tick_slot_and_predecessor) {
  Program& sut = start_and_wait({kOverrunCounter, slow("skip")});
  ASSERT_TRUE(wait_until([&] { return module("slow").overruns.load() > 3; }));
  const auto shown = indurop({"overruns", "-o", "json"});
  stop(sut);
  ASSERT_EQ(shown.code, 0);
  const auto& entry = *run()->at<scheduler::OverrunEntry>(run()->overrun_log_offset);
  EXPECT_EQ(entry.module, 1U);
  EXPECT_EQ(entry.previous, 0);
  EXPECT_EQ(entry.slot, entry.tick % run()->slot_count);
  EXPECT_GT(entry.own_ns, 1'000'000);
  EXPECT_EQ(entry.started, 1U);
  EXPECT_CONTAINS(shown.out, "slow");
}

TEST_F(Overrun, Budget_ends_a_module_that_takes_too_long) {
  Module bad = slow("skip", "1ms", "30000");
  bad.more = "<budget>3ms</budget><failsafe variable=\"nt::output\">-7</failsafe>";
  Program& sut = start_and_wait({kOverrunCounter, bad});
  ASSERT_TRUE(wait_until([&] { return module("slow").state.load() == ModuleState::Faulted; }));
  EXPECT_TRUE(sut.says("did not return within"));
  EXPECT_TRUE(runs_reach("counter", module("counter").runs.load() + 50));
  EXPECT_EQ(value<std::int32_t>("nt::output"), -7);
}

TEST_F(Overrun, Of_a_process_module_is_skipped_and_counted) {
  Program& sut = start_and_wait(
      {kOverrunCounter,
       {.file = "writer.exe", .name = "process", .type = "process", .period = "1ms", .priority = 2},
       {.file = "faulty.so", .name = "before", .period = "5ms", .priority = 1, .properties = {{"busy_us", "2500"}}}});
  EXPECT_TRUE(wait_until([&] { return module("process").overruns.load() > 3; }));
  EXPECT_GE(module("process").skipped.load() + 1, module("process").overruns.load());
  EXPECT_TRUE(runs_reach("process", module("process").runs.load() + 10));
  stop(sut);
}

}  // namespace
}  // namespace indurop::test
