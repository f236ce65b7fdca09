// SPDX-License-Identifier: Apache-2.0
// Process modules that are exchanged while the node runs: another process follows between two runs, each release is
// taken by one of them, and the previous one returns if the new one fails.
#include <fmt/format.h>

#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <random>
#include <string>

#include "core/rt/clock.h"
#include "reload_fixture.h"

namespace indurop::test {
namespace {

using scheduler::ModuleState;
using scheduler::VersionState;

// What rambler.cpp has walked after so many runs of one process: the sum of 3 + n % 5.
std::int64_t walked_after(std::uint64_t runs) {
  std::int64_t walked = 0;
  for (std::uint64_t n = 1; n <= runs; ++n) {
    walked += 3 + static_cast<std::int64_t>(n % 5);
  }
  return walked;
}

class ReloadProcess : public Reload {
 protected:
  // With a long period: a process that a busy machine delays by one overruns, without a lost tick.
  static Module process(const std::string& file = "process.exe", const std::string& argument = "count") {
    return {.file = file,
            .name = "process",
            .type = "process",
            .period = "10ms",
            .priority = 4,
            .more = "<restart max=\"0\"/>" + (argument.empty() ? "" : "<argument>" + argument + "</argument>")};
  }
  // Another version: the program does the same, its file has another digest.
  std::string version(int number, const std::string& of = "process.exe") const {
    const std::string copy = folder().string() + "/version" + std::to_string(number) + ".exe";
    std::filesystem::copy_file(std::filesystem::path(MODULE_DIR) / of, copy);
    std::ofstream(copy, std::ios::app) << number;
    return copy;
  }
  pid_t pid() { return module("process").pid.load(); }
  bool runs_more() { return runs_reach("process", module("process").runs.load() + 10); }
  static bool is_there(pid_t pid) { return ::kill(pid, 0) == 0; }
  // All runs of the module, by whichever process, have continued what the ones before kept.
  void expect_walked_all() {
    EXPECT_TRUE(wait_until([&] {
      const std::uint64_t runs = module("process").runs.load();
      const auto walked = value<std::int64_t>("nt::walked");
      return walked == walked_after(runs) || walked == walked_after(runs + 1);
    })) << value<std::int64_t>("nt::walked")
        << " after " << module("process").runs.load() << " runs";
  }
};

TEST_F(ReloadProcess, Another_process_follows_and_each_run_is_executed_once) {
  constexpr int kTimes = 20;
  Program& sut = start_and_wait({process()});
  ASSERT_TRUE(runs_reach("process", 20));
  for (int i = 0; i < kTimes; ++i) {
    const pid_t before = pid();
    const Outcome done = reload({"process", version(i), "--lossy", "--health", "0s"});
    ASSERT_EQ(done.code, 0) << done.err;
    EXPECT_CONTAINS(done.out, "version " + std::to_string(i + 2) + " runs since tick");
    EXPECT_NE(pid(), before);
    EXPECT_TRUE(runs_more());
    EXPECT_TRUE(wait_until([before] { return !is_there(before); }));
  }
  expect_each_run_once();
  EXPECT_EQ(module("process").faults.load(), 0U);
  EXPECT_EQ(module("process").version.load(), std::uint64_t{kTimes + 1});
  EXPECT_EQ(indurop({"status", "--node", node(), "-o", "json"}).json()["modules"][0]["version"], kTimes + 1);
  sut.signal(SIGTERM);
  EXPECT_EQ(sut.wait(), 0) << sut.err();
}

TEST_F(ReloadProcess, The_previous_process_returns_by_command_and_after_a_fault) {
  start_and_wait({process()});
  ASSERT_TRUE(runs_reach("process", 20));
  const pid_t first = pid();
  for (const bool by_command : {true, false}) {
    Program client({INDUROP_PROGRAM, "reload", "process", version(by_command ? 1 : 2), "--lossy", "--health", "60s",
                    "--node", node()},
                   environment());
    ASSERT_TRUE(wait_until([&] { return module("process").version_state.load() == VersionState::Watched; }));
    const pid_t second = pid();
    EXPECT_NE(second, first);
    EXPECT_TRUE(is_there(first));
    EXPECT_TRUE(runs_more());
    if (by_command) {
      const Outcome back = reload({"process", "--back"});
      EXPECT_EQ(back.code, 0) << back.err;
    } else {
      ASSERT_EQ(::kill(second, SIGKILL), 0);
    }
    EXPECT_EQ(client.wait(), 5) << client.err();
    EXPECT_CONTAINS(client.err(), by_command ? "by command" : "the new one faulted");
    EXPECT_EQ(pid(), first);
    EXPECT_EQ(module("process").faults.load(), by_command ? 0U : 1U);
    EXPECT_EQ(module("process").state.load(), ModuleState::Running);
    EXPECT_TRUE(runs_more());
    EXPECT_TRUE(wait_until([second] { return !is_there(second); }));
  }
  EXPECT_EQ(module("process").restarts.load(), 0U);
}

TEST_F(ReloadProcess, A_new_process_that_cannot_run_changes_nothing) {
  Program& sut = start_and_wait({process("rambler_process.exe", "")});
  ASSERT_TRUE(runs_reach("process", 20));
  const pid_t before = pid();
  const Outcome lossy = reload({"process", version(1, "rambler_by_process.exe")});
  EXPECT_EQ(lossy.code, 4) << lossy.err;
  EXPECT_CONTAINS(lossy.err, "--lossy exchanges it nevertheless");
  EXPECT_CONTAINS(lossy.out, "the other one copies them by functions");
  EXPECT_CONTAINS(reload({"process", folder().string() + "/missing.exe"}).err, "missing.exe");
  EXPECT_CONTAINS(reload({"process", "/bin/true", "--lossy"}).err,
                  "exited with code 0 before it called irp::waitPeriod()");
  EXPECT_EQ(pid(), before);
  EXPECT_TRUE(runs_more());
  sut.signal(SIGTERM);
  EXPECT_EQ(sut.wait(), 0) << sut.err();
}

TEST_F(ReloadProcess, What_a_process_keeps_goes_to_the_next_one_and_back) {
  for (const std::string file : {"rambler_process.exe", "rambler_by_process.exe"}) {
    Program& sut = start_and_wait({process(file, "")});
    ASSERT_TRUE(runs_reach("process", 20));
    for (int i = 0; i < 5; ++i) {
      const Outcome done = reload({"process", version(i, file), "--health", "0s"});
      ASSERT_EQ(done.code, 0) << done.err;
      EXPECT_CONTAINS(done.err, "exchanged, with what it keeps");
      EXPECT_TRUE(runs_more());
    }
    Program client({INDUROP_PROGRAM, "reload", "process", version(5, file), "--health", "60s", "--node", node()},
                   environment());
    ASSERT_TRUE(wait_until([&] { return module("process").version_state.load() == VersionState::Watched; }));
    EXPECT_TRUE(runs_more());
    EXPECT_EQ(reload({"process", "--back"}).code, 0);
    EXPECT_EQ(client.wait(), 5) << client.err();
    EXPECT_TRUE(runs_more());
    expect_walked_all();
    // A busy machine may delay a run, but exchanges leave out none.
    EXPECT_LE(module("process").skipped.load(), run()->lost_ticks.load() + module("process").overruns.load());
    sut.signal(SIGTERM);
    EXPECT_EQ(sut.wait(), 0) << sut.err();
    for (int i = 0; i <= 5; ++i) {
      std::filesystem::remove(folder() / fmt::format("version{}.exe", i));
    }
  }
}

TEST_F(ReloadProcess, What_cannot_be_taken_over_is_lost_if_that_is_allowed) {
  start_and_wait({process("rambler_process.exe", "")});
  ASSERT_TRUE(runs_reach("process", 100));
  int number = 0;
  for (const char* const file : {"rambler_by_process.exe", "rambler_process.exe"}) {
    const Outcome done = reload({"process", version(++number, file), "--lossy", "--health", "0s"});
    EXPECT_EQ(done.code, 0) << done.err;
    EXPECT_CONTAINS(done.err, "exchanged, with initial values");
    EXPECT_CONTAINS(done.out, "lost      all that it keeps");
    EXPECT_TRUE(runs_more());
    EXPECT_LT(value<std::int64_t>("nt::walked"), walked_after(module("process").runs.load()));
  }
}

// Whatever moment it is, one process runs afterwards, and continues with what one of the two has kept.
TEST_F(ReloadProcess, A_new_process_that_is_killed_at_any_moment_leaves_one_that_continues) {
  constexpr int kTimes = 12;
  start_and_wait({process("rambler_process.exe", "")});
  ASSERT_TRUE(runs_reach("process", 20));
  std::mt19937 random(20261128);  // NOLINT(cert-msc32-c,cert-msc51-cpp): each run of the test is to be the same
  for (int i = 0; i < kTimes; ++i) {
    Program client(
        {INDUROP_PROGRAM, "reload", "process", version(i, "rambler_process.exe"), "--health", "60s", "--node", node()},
        environment());
    const auto& slot = run()->process_slots()[0];
    ASSERT_TRUE(wait_until([&] { return slot.successor.load() > 0; }));
    const pid_t successor = slot.successor.load();
    rt::sleep_until(rt::MonoClock::now() +
                    std::chrono::microseconds(std::uniform_int_distribution<int>(0, 40'000)(random)));
    if (successor > 0) {
      ::kill(successor, SIGKILL);
    }
    EXPECT_NE(client.wait(), 0) << client.err();
    EXPECT_TRUE(wait_until([&] { return slot.successor.load() == 0 && pid() > 0 && pid() != successor; }));
    ASSERT_EQ(module("process").state.load(), ModuleState::Running);
    EXPECT_TRUE(runs_more());
    const auto walked = value<std::int64_t>("nt::walked");
    std::uint64_t runs = 0;
    while (walked_after(runs) < walked) {
      ++runs;
    }
    EXPECT_EQ(walked_after(runs), walked);
    EXPECT_LE(runs, module("process").runs.load() + 1);
    EXPECT_GE(runs, 20U);
  }
  EXPECT_EQ(module("process").restarts.load(), 0U);
}

TEST_F(ReloadProcess, A_new_process_brings_variables_that_stay_when_it_returns) {
  start_and_wait({process("rambler_process.exe", "")});
  ASSERT_TRUE(runs_reach("process", 20));
  const std::string gains = version(1, "rambler_gains_process.exe");
  EXPECT_CONTAINS(reload({"process", gains, "--dry-run"}).out, "new       nt::gained, nt::pair, nt::limit");
  EXPECT_EQ(indurop({"get", "nt::gained", "--node", node()}).code, 1) << "nothing has changed";
  const Outcome done = reload({"process", gains, "--health", "0s"});
  ASSERT_EQ(done.code, 0) << done.err;
  EXPECT_CONTAINS(done.out, "new       nt::gained, nt::pair, nt::limit");
  EXPECT_TRUE(runs_more());
  expect_walked_all();
  EXPECT_TRUE(wait_until([&] { return value<std::int64_t>("nt::gained") == 2 * value<std::int64_t>("nt::walked"); }));
  ASSERT_EQ(reload({"process", version(2, "rambler_process.exe"), "--health", "0s"}).code, 0);
  EXPECT_TRUE(runs_more());
  expect_walked_all();
  const auto left = value<std::int64_t>("nt::gained");
  EXPECT_TRUE(runs_more());
  EXPECT_EQ(value<std::int64_t>("nt::gained"), left);
  ASSERT_EQ(reload({"process", version(3, "rambler_gains_process.exe"), "--health", "0s"}).code, 0);
  EXPECT_TRUE(wait_until([&] { return value<std::int64_t>("nt::gained") > left; }));
  expect_walked_all();
}

// Those of the next process are wrong: it ends, and the one that has handed over continues.
TEST_F(ReloadProcess, Bytes_that_the_new_process_rejects_stay_with_the_previous_one) {
  start_and_wait({process("rambler_by_process.exe", "")});
  ASSERT_TRUE(runs_reach("process", 20));
  const pid_t before = pid();
  const Outcome rejected = reload({"process", version(1, "rambler_longer_process.exe"), "--health", "0s"});
  EXPECT_EQ(rejected.code, 1) << rejected.err;
  EXPECT_CONTAINS(rejected.err, "exited with code 1");
  EXPECT_EQ(pid(), before);
  EXPECT_EQ(module("process").version.load(), 1U);
  EXPECT_TRUE(runs_more());
  expect_walked_all();
  EXPECT_EQ(reload({"process", version(2, "rambler_longer_process.exe"), "--lossy", "--health", "0s"}).code, 0);
  EXPECT_NE(pid(), before);
  EXPECT_TRUE(runs_more());
}

// Whatever moment it is, the next one continues with what the other one handed over, or the module is started again.
TEST_F(ReloadProcess, A_process_that_is_killed_while_it_is_followed_leaves_one_that_runs) {
  constexpr int kTimes = 12;
  Module slow = process("rambler_process.exe", "");
  slow.more = "<restart max=\"100\" delay=\"1ms\"/>";
  start_and_wait({slow});
  ASSERT_TRUE(runs_reach("process", 20));
  std::mt19937 random(20261129);  // NOLINT(cert-msc32-c,cert-msc51-cpp): each run of the test is to be the same
  for (int i = 0; i < kTimes; ++i) {
    const pid_t before = pid();
    Program client(
        {INDUROP_PROGRAM, "reload", "process", version(i, "rambler_process.exe"), "--health", "0s", "--node", node()},
        environment());
    const auto& slot = run()->process_slots()[0];
    ASSERT_TRUE(wait_until([&] { return slot.successor.load() > 0 || !client.running(); }));
    rt::sleep_until(rt::MonoClock::now() +
                    std::chrono::microseconds(std::uniform_int_distribution<int>(0, 30'000)(random)));
    ASSERT_EQ(::kill(before, SIGKILL), 0);
    (void)client.wait();
    EXPECT_TRUE(wait_until([&] {
      return slot.successor.load() == 0 && pid() > 0 && pid() != before && alive(pid()) &&
             module("process").state.load() == ModuleState::Running;
    })) << client.err();
    EXPECT_TRUE(runs_more());
    const auto walked = value<std::int64_t>("nt::walked");
    std::uint64_t runs = 0;
    while (walked_after(runs) < walked) {
      ++runs;
    }
    EXPECT_EQ(walked_after(runs), walked);
    EXPECT_LE(runs, module("process").runs.load() + 1);
  }
}

TEST_F(ReloadProcess, A_node_that_is_killed_while_a_process_follows_can_be_started_again) {
  constexpr int kTimes = 6;
  std::mt19937 random(20261130);  // NOLINT(cert-msc32-c,cert-msc51-cpp): each run of the test is to be the same
  for (int i = 0; i < kTimes; ++i) {
    Program& sut = start_and_wait({process("rambler_process.exe", "")});
    ASSERT_TRUE(runs_reach("process", 20));
    const pid_t first = pid();
    Program client(
        {INDUROP_PROGRAM, "reload", "process", version(i, "rambler_process.exe"), "--health", "60s", "--node", node()},
        environment());
    const auto& slot = run()->process_slots()[0];
    ASSERT_TRUE(wait_until([&] { return slot.successor.load() > 0; }));
    const pid_t second = slot.successor.load();
    rt::sleep_until(rt::MonoClock::now() +
                    std::chrono::microseconds(std::uniform_int_distribution<int>(0, 30'000)(random)));
    sut.signal(SIGKILL);
    (void)sut.wait();
    EXPECT_NE(client.wait(), 0);
    Program& again = start_and_wait({process("rambler_process.exe", "")});
    EXPECT_TRUE(runs_more());
    EXPECT_TRUE(wait_until([&] { return !alive(first) && !alive(second); }));
    expect_walked_all();
    again.signal(SIGTERM);
    EXPECT_EQ(again.wait(), 0) << again.err();
  }
}

TEST_F(ReloadProcess, A_node_that_ends_in_the_health_window_ends_both_processes) {
  Program& sut = start_and_wait({process()});
  ASSERT_TRUE(runs_reach("process", 20));
  const pid_t first = pid();
  Program client({INDUROP_PROGRAM, "reload", "process", version(1), "--lossy", "--health", "60s", "--node", node()},
                 environment());
  ASSERT_TRUE(wait_until([&] { return module("process").version_state.load() == VersionState::Watched; }));
  const pid_t second = pid();
  sut.signal(SIGTERM);
  EXPECT_EQ(sut.wait(), 0) << sut.err();
  EXPECT_FALSE(is_there(first));
  EXPECT_FALSE(is_there(second));
  (void)client.wait();
}

}  // namespace
}  // namespace indurop::test
