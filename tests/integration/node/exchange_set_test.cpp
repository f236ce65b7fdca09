// SPDX-License-Identifier: Apache-2.0
// Several modules of a node that are exchanged at one tick, as an agent requests it.

#include "store/operate/exchange_set.h"

#include <csignal>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "node_fixture.h"
#include "scheduler/module_command.h"

namespace indurop::test {
namespace {

using operate::SetReport;
using operate::SetRequest;
using scheduler::CommandResult;
using Act = SetRequest::Act;
using State = SetReport::State;

class SeveralModules : public NodeTest {
 protected:
  void SetUp() override {
    ::setenv("INDUROP_STATE_DIR", (folder() / "state").c_str(), 1);
    // Another file, with another digest, and the same code.
    std::filesystem::copy_file(std::filesystem::path(MODULE_DIR) / "counter.so", copy());
    std::ofstream(copy(), std::ios::app) << "another version";
    start_and_wait(modules());
    ASSERT_TRUE(runs_reach("press", 50));
    auto file = vars::RunFile::open(node(), vars::Mode::ReadWrite, scheduler::kRunMagic, sizeof(scheduler::RunBlock));
    ASSERT_TRUE(file);
    run_.emplace(std::move(file).value());
  }
  void TearDown() override {
    run_.reset();
    NodeTest::TearDown();
    ::unsetenv("INDUROP_STATE_DIR");
  }
  virtual std::vector<Module> modules() {
    return {{.file = "counter.so", .name = "other", .priority = 1},
            {.file = "reload_same.so", .name = "press", .priority = 2}};
  }
  [[nodiscard]] std::string copy() const { return folder() / "counter_copy.so"; }
  static std::string built(const std::string& version) {
    return std::filesystem::path(MODULE_DIR) / ("reload_" + version + ".so");
  }
  scheduler::RunBlock& block() { return *static_cast<scheduler::RunBlock*>(run_->data()); }

  CommandResult request(const SetRequest& what) {
    EXPECT_TRUE(operate::write_set_request(node(), what).ok());
    const auto ticket = scheduler::place_command(block().modules()[0], scheduler::ModuleCommand::Exchange);
    EXPECT_TRUE(ticket);
    EXPECT_TRUE(wait_until([&] { return scheduler::result_of(block().modules()[0], *ticket) != CommandResult::None; }));
    return scheduler::result_of(block().modules()[0], *ticket);
  }
  bool comes_to(State state) {
    return wait_until([&] {
      const auto report = operate::read_set_report(node());
      return report && report->state == state;
    });
  }
  SetReport report() { return operate::read_set_report(node()).value_or(SetReport()); }
  void prepare(const std::string& press) {
    ASSERT_EQ(request({Act::Prepare, "second", {{"other", copy()}, {"press", press}}, 0}), CommandResult::Done);
    ASSERT_TRUE(comes_to(State::Ready)) << report().problem;
  }
  void exchange(std::uint64_t ahead = 500) {
    lost_before_ = block().lost_ticks.load();
    tick_ = block().tick.load() + ahead;
    ASSERT_EQ(request({Act::Exchange, "", {}, tick_}), CommandResult::Done);
  }
  // The machine may lose the tick itself; then it is the next one that is not lost.
  void expect_exchanged_in_the_tick(const char* name) {
    const std::uint64_t lost = block().lost_ticks.load() - lost_before_;
    EXPECT_GE(module(name).version_tick.load(), tick_) << name;
    EXPECT_LE(module(name).version_tick.load(), tick_ + lost) << name;
  }
  // No run of the press was left out: it has counted each of them, but `lost`.
  void expect_all_counted(std::int64_t lost = 0) {
    const auto& record = module("press");
    EXPECT_EQ(record.skipped.load(), block().lost_ticks.load());
    EXPECT_TRUE(wait_until([&] {
      const auto before = static_cast<std::int64_t>(record.runs.load());
      const auto now = static_cast<std::int64_t>(value<std::int32_t>("nt::output"));
      return now + lost == before && record.runs.load() == static_cast<std::uint64_t>(before);
    }));
  }

  std::uint64_t tick_ = 0;
  std::uint64_t lost_before_ = 0;
  std::optional<vars::RunFile> run_;
};

TEST_F(SeveralModules, Are_exchanged_at_the_tick_that_was_said_and_stay) {
  prepare(built("other"));
  EXPECT_EQ(module("press").version.load(), 1U);
  exchange();
  ASSERT_TRUE(comes_to(State::Exchanged)) << report().problem;
  for (const char* name : {"press", "other"}) {
    expect_exchanged_in_the_tick(name);
    EXPECT_EQ(module(name).version.load(), 2U);
    EXPECT_EQ(module(name).version_state.load(), scheduler::VersionState::Watched);
  }
  EXPECT_STREQ(block().deployment, "second");
  EXPECT_EQ(report().modules.size(), 2U);
  ASSERT_EQ(request({Act::Decide, "second", {}, 0}), CommandResult::Done);
  ASSERT_TRUE(comes_to(State::None));
  EXPECT_EQ(module("press").version_state.load(), scheduler::VersionState::Settled);
  EXPECT_EQ(request({Act::Decide, "second", {}, 0}), CommandResult::Done) << "as often as it is said";
  EXPECT_EQ(request({Act::Decide, "", {}, 0}), CommandResult::Refused) << "that is over";
  EXPECT_LT(value<std::int64_t>("nt::walked"), 0);
  expect_all_counted();
  const Outcome same = indurop({"reload", "press", "--node", node()});
  EXPECT_CONTAINS(same.err, "this version runs already");
}

TEST_F(SeveralModules, Go_back_with_state_if_the_one_before_is_decided) {
  prepare(built("other"));
  exchange(100);
  ASSERT_TRUE(comes_to(State::Exchanged)) << report().problem;
  ASSERT_EQ(request({Act::Decide, "", {}, 0}), CommandResult::Done);
  ASSERT_TRUE(comes_to(State::Undone));
  EXPECT_STREQ(block().deployment, "");
  EXPECT_GT(value<std::int64_t>("nt::walked"), 0);
  expect_all_counted();
}

TEST_F(SeveralModules, A_tick_that_has_begun_is_missed_and_nothing_is_exchanged) {
  prepare(built("other"));
  ASSERT_EQ(request({Act::Exchange, "", {}, block().tick.load()}), CommandResult::Done);
  ASSERT_TRUE(comes_to(State::Undone));
  EXPECT_CONTAINS(report().problem, "it missed the tick of the exchange");
  EXPECT_GT(value<std::int64_t>("nt::walked"), 0);
  EXPECT_STREQ(block().deployment, "");
  expect_all_counted();
  prepare(built("other"));  // and again
  exchange();
  EXPECT_TRUE(comes_to(State::Exchanged));
}

TEST_F(SeveralModules, Given_up_before_the_tick_none_is_exchanged) {
  prepare(built("other"));
  exchange(100'000);
  ASSERT_EQ(request({Act::Decide, "", {}, 0}), CommandResult::Done);
  ASSERT_TRUE(comes_to(State::Undone));
  EXPECT_EQ(module("press").version.load(), 1U);
  EXPECT_EQ(module("other").version.load(), 1U);
  expect_all_counted();
}

TEST_F(SeveralModules, A_fault_of_one_takes_all_back) {
  prepare(built("throws"));
  exchange(100);
  ASSERT_TRUE(comes_to(State::Undone));
  EXPECT_CONTAINS(report().problem, "module press: the previous version runs again: the new one faulted");
  EXPECT_EQ(module("other").version_state.load(), scheduler::VersionState::Returned);
  EXPECT_EQ(module("press").state.load(), scheduler::ModuleState::Running);
  EXPECT_STREQ(block().deployment, "");
  expect_all_counted(1);
}

TEST_F(SeveralModules, One_that_cannot_start_prevents_all) {
  ASSERT_EQ(request({Act::Prepare, "second", {{"other", copy()}, {"press", built("bad_start")}}, 0}),
            CommandResult::Done);
  ASSERT_TRUE(comes_to(State::Undone));
  EXPECT_EQ(report().refused, "press");
  EXPECT_CONTAINS(report().problem, "no ink");
  EXPECT_FALSE(report().needs_restart);
  EXPECT_EQ(module("other").version.load(), 1U);
  EXPECT_EQ(request({Act::Exchange, "", {}, 1U << 30U}), CommandResult::Refused);
}

TEST_F(SeveralModules, What_needs_a_restart_is_marked) {
  ASSERT_EQ(request({Act::Compare, "second", {{"press", built("more_access")}}, 0}), CommandResult::Done);
  ASSERT_TRUE(comes_to(State::Undone));
  EXPECT_TRUE(report().needs_restart);
  EXPECT_CONTAINS(report().problem, "it writes variable nt::events");
  EXPECT_EQ(request({Act::Compare, "second", {{"absent", copy()}}, 0}), CommandResult::Refused);
  EXPECT_TRUE(report().needs_restart);
}

TEST_F(SeveralModules, Compared_they_are_discarded) {
  ASSERT_EQ(request({Act::Compare, "second", {{"other", copy()}, {"press", built("less")}}, 0}), CommandResult::Done);
  ASSERT_TRUE(comes_to(State::Compared));
  ASSERT_EQ(report().modules.size(), 2U);
  EXPECT_EQ(report().modules[1].plan.added, std::vector<std::string>{"own"});
  EXPECT_EQ(module("press").version.load(), 1U);
  EXPECT_CONTAINS(indurop({"reload", "press", built("other"), "--health", "0s", "--node", node()}).err, "exchanged");
}

TEST_F(SeveralModules, Another_exchange_waits_for_its_end) {
  prepare(built("other"));
  EXPECT_CONTAINS(indurop({"reload", "press", built("less"), "--node", node()}).err, "a deployment exchanges modules");
  EXPECT_EQ(request({Act::Prepare, "third", {}, 0}), CommandResult::Refused);
  exchange(100);
  ASSERT_TRUE(comes_to(State::Exchanged));
  programs_.back()->signal(SIGTERM);
  EXPECT_EQ(programs_.back()->wait(), 0) << "the node may end at any time: " << programs_.back()->err();
}

class WithAProcess : public SeveralModules {
 protected:
  void SetUp() override {
    SeveralModules::SetUp();
    std::filesystem::copy_file(std::filesystem::path(MODULE_DIR) / "process.exe", next());
    std::ofstream(next(), std::ios::app) << "another version";
    ASSERT_TRUE(wait_until([&] { return module("process").state.load() == scheduler::ModuleState::Running; }));
  }
  std::vector<Module> modules() override {
    std::vector<Module> all = SeveralModules::modules();
    all.push_back({.file = "process.exe",
                   .name = "process",
                   .type = "process",
                   .period = "2ms",
                   .priority = 3,
                   .more = "<restart max=\"0\"/><argument>count</argument>"});
    return all;
  }
  [[nodiscard]] std::string next() const { return folder() / "next.exe"; }
  pid_t pid() { return module("process").pid.load(); }
  void prepare_all(const std::string& process) {
    ASSERT_EQ(
        request({Act::Prepare, "second", {{"other", copy()}, {"press", built("other")}, {"process", process}}, 0}),
        CommandResult::Done);
  }
  void expect_process_runs() {
    EXPECT_EQ(module("process").state.load(), scheduler::ModuleState::Running);
    EXPECT_TRUE(runs_reach("process", module("process").runs.load() + 20));
  }
};

TEST_F(WithAProcess, It_follows_in_the_tick_and_stays) {
  prepare_all(next());
  ASSERT_TRUE(comes_to(State::Ready)) << report().problem;
  const pid_t before = pid();
  exchange();
  ASSERT_TRUE(comes_to(State::Exchanged)) << report().problem;
  EXPECT_NE(pid(), before);
  expect_exchanged_in_the_tick("process");
  expect_exchanged_in_the_tick("press");
  EXPECT_EQ(::kill(before, 0), 0) << "it is ready to return";
  ASSERT_EQ(request({Act::Decide, "second", {}, 0}), CommandResult::Done);
  ASSERT_TRUE(comes_to(State::None));
  EXPECT_EQ(module("process").version_state.load(), scheduler::VersionState::Settled);
  EXPECT_NE(::kill(before, 0), 0);
  expect_process_runs();
  expect_each_run_once();
  expect_all_counted();
}

TEST_F(WithAProcess, It_returns_with_the_others) {
  const pid_t before = pid();
  for (const bool dies : {false, true}) {
    prepare_all(next());
    ASSERT_TRUE(comes_to(State::Ready)) << report().problem;
    exchange(100);
    ASSERT_TRUE(comes_to(State::Exchanged)) << report().problem;
    if (dies) {
      ASSERT_EQ(::kill(pid(), SIGKILL), 0);
    } else {
      ASSERT_EQ(request({Act::Decide, "", {}, 0}), CommandResult::Done);
    }
    ASSERT_TRUE(comes_to(State::Undone));
    EXPECT_EQ(pid(), before);
    EXPECT_STREQ(block().deployment, "");
    EXPECT_GT(value<std::int64_t>("nt::walked"), 0);
    expect_process_runs();
  }
}

TEST_F(WithAProcess, One_that_cannot_run_or_is_given_up_prevents_all) {
  const pid_t before = pid();
  prepare_all("/bin/true");
  ASSERT_TRUE(comes_to(State::Undone));
  EXPECT_CONTAINS(report().problem, "exited with code 0 before it called irp::waitPeriod()");
  EXPECT_EQ(module("press").version.load(), 1U);
  prepare_all(next());
  ASSERT_TRUE(comes_to(State::Ready)) << report().problem;
  exchange(100'000);
  ASSERT_EQ(request({Act::Decide, "", {}, 0}), CommandResult::Done);
  ASSERT_TRUE(comes_to(State::Undone));
  EXPECT_EQ(pid(), before);
  expect_process_runs();
  expect_each_run_once();
  expect_all_counted();
}

class WithBackground : public WithAProcess {
 protected:
  std::vector<Module> modules() override {
    std::vector<Module> all = WithAProcess::modules();
    all.back().operation = "non-real";
    all.back().period = "";
    all.push_back({.file = "rambler.so", .name = "walker", .operation = "non-real", .more = "<period>2ms</period>"});
    return all;
  }
  void prepare_with_background() {
    const std::string walker = folder() / "walker.so";
    std::filesystem::copy_file(std::filesystem::path(MODULE_DIR) / "rambler.so", walker,
                               std::filesystem::copy_options::overwrite_existing);
    std::ofstream(walker, std::ios::app) << "another version";
    ASSERT_EQ(request({Act::Prepare,
                       "second",
                       {{"other", copy()}, {"press", built("other")}, {"process", next()}, {"walker", walker}},
                       0}),
              CommandResult::Done);
    ASSERT_TRUE(comes_to(State::Ready)) << report().problem;
  }
};

TEST_F(WithBackground, All_follow_and_return_with_the_others) {
  for (const bool stays : {false, true}) {
    prepare_with_background();
    const pid_t before = pid();
    exchange(100);
    ASSERT_TRUE(comes_to(State::Exchanged)) << report().problem;
    EXPECT_EQ(module("walker").version_state.load(), scheduler::VersionState::Watched);
    EXPECT_NE(pid(), before);
    EXPECT_TRUE(runs_reach("walker", module("walker").runs.load() + 20));
    ASSERT_EQ(request({Act::Decide, stays ? "second" : "", {}, 0}), CommandResult::Done);
    ASSERT_TRUE(comes_to(stays ? State::None : State::Undone)) << report().problem;
    EXPECT_TRUE(runs_reach("walker", module("walker").runs.load() + 20));
    EXPECT_EQ(module("process").state.load(), scheduler::ModuleState::Running);
    expect_all_counted();
  }
  EXPECT_EQ(module("walker").version.load(), 4U);
  EXPECT_STREQ(block().deployment, "second");
}

TEST_F(WithBackground, A_process_that_ends_takes_all_back) {
  prepare_with_background();
  exchange(100);
  ASSERT_TRUE(comes_to(State::Exchanged)) << report().problem;
  ASSERT_EQ(::kill(pid(), SIGKILL), 0);
  ASSERT_TRUE(comes_to(State::Undone)) << report().problem;
  EXPECT_STREQ(block().deployment, "");
  EXPECT_EQ(module("process").state.load(), scheduler::ModuleState::Running);
  EXPECT_TRUE(runs_reach("walker", module("walker").runs.load() + 20));
  expect_all_counted();
}

}  // namespace
}  // namespace indurop::test
