// SPDX-License-Identifier: Apache-2.0
// indurop reload --config with processes and modules in the background that are added, end and come back.
#include <sys/stat.h>

#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <random>

#include "core/rt/clock.h"
#include "other_schedule_fixture.h"

namespace indurop::test {
namespace {

using scheduler::ModuleState;

class AddedProcesses : public OtherSchedule {
 protected:
  static Module process(const std::string& argument = "count", const std::string& more = "") {
    return {.file = "process.exe",
            .name = "process",
            .type = "process",
            .period = "10ms",
            .priority = 4,
            .more = "<restart max=\"0\" escalate=\"stop-node\"/><argument>" + argument + "</argument>" + more};
  }
  Module sleeper() const {
    const std::string file = folder() / "sleeper.sh";
    std::ofstream(file) << "#!/bin/sh\nexec sleep 1000\n";
    ::chmod(file.c_str(), 0755);
    return {.file = file, .name = "sleeper", .type = "process", .operation = "non-real"};
  }
  static Module background() {
    return {.file = "faulty.so", .name = "background", .operation = "non-real", .more = "<period>2ms</period>"};
  }
  Outcome back() const { return indurop({"reload", "--back", "--node", node()}); }
  pid_t pid_of(const std::string& name) { return module(name).pid.load(); }
  static bool is_there(pid_t pid) { return ::kill(pid, 0) == 0; }
  bool is_stopped(const std::string& name) {
    return wait_until([&] { return module(name).state.load() == ModuleState::Stopped; });
  }
};

TEST_F(AddedProcesses, A_process_waits_for_the_first_tick_and_loses_none) {
  Program& sut = start_and_wait({kCounter, kWalker});
  ASSERT_TRUE(runs_reach("walker", 20));
  const Outcome done = change({kCounter, kWalker, process()});
  ASSERT_EQ(done.code, 0) << done.out << done.err;
  EXPECT_CONTAINS(done.out, "added       process");
  EXPECT_TRUE(goes_on("process"));
  const auto& added = module("process");
  EXPECT_EQ(added.skipped.load(), 0U) << "it was ready";
  EXPECT_EQ(added.version.load(), 1U);
  EXPECT_EQ(added.faults.load(), 0U);
  expect_each_run_once();
  const pid_t pid = pid_of("process");
  ASSERT_EQ(back().code, 0);
  EXPECT_TRUE(is_stopped("process"));
  EXPECT_TRUE(wait_until([pid] { return !is_there(pid); }));
  const std::uint64_t runs = added.runs.load();
  ASSERT_EQ(change({kCounter, kWalker, process()}).code, 0);
  EXPECT_TRUE(runs_reach("process", runs + 20));
  EXPECT_NE(pid_of("process"), pid);
  EXPECT_EQ(added.version.load(), 1U) << "it is the same file";
  expect_no_tick_of_counter_is_lost();
  const pid_t second = pid_of("process");
  sut.signal(SIGTERM);
  EXPECT_EQ(sut.wait(), 0) << sut.err();
  EXPECT_FALSE(is_there(second));
}

TEST_F(AddedProcesses, One_that_the_node_started_with_ends_and_comes_back_with_another_file) {
  start_and_wait({kCounter, process()});
  ASSERT_TRUE(runs_reach("process", 20));
  const pid_t first = pid_of("process");
  ASSERT_EQ(change({kCounter}).code, 0);
  EXPECT_TRUE(is_stopped("process"));
  EXPECT_TRUE(wait_until([first] { return !is_there(first); }));
  const std::uint64_t runs = module("process").runs.load();
  Module other = process();
  other.file = folder() / "other.exe";
  std::filesystem::copy_file(std::filesystem::path(MODULE_DIR) / "process.exe", other.file);
  std::ofstream(other.file, std::ios::app) << "another version";
  const Outcome done = change({kCounter, other});
  ASSERT_EQ(done.code, 0) << done.out << done.err;
  EXPECT_TRUE(runs_reach("process", runs + 20));
  EXPECT_EQ(std::filesystem::read_symlink("/proc/" + std::to_string(pid_of("process")) + "/exe"), other.file);
  EXPECT_EQ(module("process").version.load(), 2U);
  // Its file is compared from now on, like that of a thread.
  const Outcome former = change({kCounter, process()});
  EXPECT_EQ(former.code, 4) << former.out << former.err;
  EXPECT_CONTAINS(former.out + former.err, "module process runs another version than");
  expect_no_tick_of_counter_is_lost();
}

TEST_F(AddedProcesses, A_thread_that_comes_back_with_another_file_is_another_version_too) {
  start_and_wait({kCounter, kWalker});
  ASSERT_TRUE(runs_reach("walker", 20));
  ASSERT_EQ(change({kCounter}).code, 0);
  EXPECT_TRUE(is_stopped("walker"));
  Module other = kWalker;
  other.file = folder() / "other.so";
  std::filesystem::copy_file(std::filesystem::path(MODULE_DIR) / "walker.so", other.file);
  std::ofstream(other.file, std::ios::app) << "another version";
  ASSERT_EQ(change({kCounter, other}).code, 0);
  EXPECT_TRUE(goes_on("walker"));
  EXPECT_EQ(module("walker").version.load(), 2U);
  EXPECT_EQ(change({kCounter, every(other, "4ms")}).code, 0) << "it is the file that runs";
  EXPECT_EQ(change({kCounter, kWalker}).code, 4);
}

// The node would end at its first death, if it was one of its processes already.
TEST_F(AddedProcesses, One_that_does_not_start_changes_nothing) {
  Program& sut = start_and_wait({kCounter, kWalker});
  ASSERT_TRUE(runs_reach("walker", 20));
  const Module bad = process("exit", "<argument>3</argument>");
  const Outcome done = change({kCounter, every(kWalker, "4ms"), bad});
  EXPECT_EQ(done.code, 1) << done.out << done.err;
  EXPECT_CONTAINS(done.err, "module process: exited with code 3 before it called irp::waitPeriod()");
  EXPECT_TRUE(is_stopped("process"));
  EXPECT_EQ(run()->schedule.load(), 1U);
  EXPECT_EQ(module("walker").period_ns.load(), 2'000'000);
  EXPECT_TRUE(goes_on("walker"));
  expect_no_tick_of_counter_is_lost();
  sut.signal(SIGTERM);
  EXPECT_EQ(sut.wait(), 0) << sut.err();
}

TEST_F(AddedProcesses, From_its_first_tick_on_it_is_a_process_like_the_others) {
  Program& sut = start_and_wait({kCounter});
  ASSERT_EQ(change({kCounter, process("die", "<argument>10</argument>")}).code, 0);
  EXPECT_EQ(sut.wait(), 1) << "it escalates";
  EXPECT_CONTAINS(sut.err(), "process module process died 1 times");
}

// Whatever moment it is, the node runs by one of the two schedules afterwards, and the process is in it or does not
// run.
TEST_F(AddedProcesses, One_that_is_killed_at_any_moment_leaves_one_of_the_schedules) {
  constexpr int kTimes = 25;
  start_and_wait({kCounter, kWalker});
  ASSERT_TRUE(runs_reach("walker", 20));
  Module added = process();
  added.more = "<restart delay=\"10ms\" max=\"1000\"/><argument>count</argument>";
  std::vector<std::string> adds = words({kCounter, kWalker, added});
  adds.insert(adds.begin(), INDUROP_PROGRAM);
  std::mt19937 random(20261128);  // NOLINT(cert-msc32-c,cert-msc51-cpp): each run of the test is to be the same
  int took_over = 0;
  for (int i = 0; i < kTimes; ++i) {
    Program client(adds, environment());
    ASSERT_TRUE(wait_until([&] {
      return run()->module_count == 3U && pid_of("process") > 0 &&
             module("process").state.load() != ModuleState::Stopped;
    }));
    rt::sleep_until(rt::MonoClock::now() + std::chrono::microseconds(random() % (1000U << (i % 9))));
    if (const pid_t pid = pid_of("process"); pid > 0) {
      (void)::kill(pid, SIGKILL);
    }
    const int code = client.wait();
    if (code == 0) {
      ++took_over;
      EXPECT_TRUE(goes_on("process"));
      ASSERT_EQ(back().code, 0);
    } else {
      EXPECT_EQ(code, 1) << client.err();
      EXPECT_CONTAINS(client.err(), "module process: ended by signal 9 (Killed)");
    }
    EXPECT_TRUE(is_stopped("process"));
    EXPECT_EQ(run()->schedule.load(), 1U + 2U * static_cast<unsigned>(took_over));
  }
  EXPECT_GT(took_over, 0);
  EXPECT_LT(took_over, kTimes);
  EXPECT_TRUE(goes_on("walker"));
  expect_no_tick_of_counter_is_lost();
}

TEST_F(AddedProcesses, Modules_in_the_background_begin_with_the_schedule_and_end_with_it) {
  Program& sut = start_and_wait({kCounter, kWalker});
  ASSERT_TRUE(runs_reach("walker", 20));
  for (int i = 0; i < 2; ++i) {
    const Outcome done = change({kCounter, kWalker, background(), sleeper()});
    ASSERT_EQ(done.code, 0) << done.out << done.err;
    EXPECT_CONTAINS(done.out, "added       sleeper");
    EXPECT_TRUE(goes_on("background"));
    EXPECT_TRUE(wait_until([&] { return module("sleeper").state.load() == ModuleState::Running; }));
    const pid_t pid = pid_of("sleeper");
    EXPECT_TRUE(is_there(pid));
    const Outcome before = back();
    ASSERT_EQ(before.code, 0) << before.out << before.err;
    EXPECT_CONTAINS(before.out, "ended       background");
    EXPECT_TRUE(is_stopped("background"));
    EXPECT_TRUE(is_stopped("sleeper"));
    EXPECT_TRUE(wait_until([pid] { return !is_there(pid); }));
  }
  EXPECT_TRUE(sut.prints("stop called"));
  expect_no_tick_of_counter_is_lost();
}

TEST_F(AddedProcesses, Modules_in_the_background_that_ended_come_back) {
  start_and_wait({kCounter, background(), sleeper()});
  ASSERT_TRUE(runs_reach("background", 20));
  const pid_t pid = pid_of("sleeper");
  ASSERT_EQ(change({kCounter}).code, 0);
  EXPECT_TRUE(is_stopped("background"));
  EXPECT_TRUE(wait_until([pid] { return !is_there(pid); }));
  const Outcome returned = back();
  ASSERT_EQ(returned.code, 0) << returned.out << returned.err;
  EXPECT_CONTAINS(returned.out, "added       sleeper");
  EXPECT_TRUE(goes_on("background"));
  EXPECT_TRUE(wait_until([&] { return pid_of("sleeper") > 0 && pid_of("sleeper") != pid; }));
}

TEST_F(AddedProcesses, A_dry_run_launches_nothing) {
  start_and_wait({kCounter});
  const Outcome said = change({kCounter, process(), sleeper(), background()}, {"--dry-run"});
  EXPECT_EQ(said.code, 0) << said.out << said.err;
  EXPECT_CONTAINS(said.err, "would take over, modules: 1 kept, 3 added");
  EXPECT_EQ(run()->module_count, 1U);
  EXPECT_EQ(run()->schedule.load(), 1U);
}

// The module in its place has given the output another value by then.
TEST_F(AddedProcesses, Fail_safe_values_of_a_module_that_ends_are_not_those_of_its_follower) {
  const std::string failsafe = "<failsafe variable=\"nt::output\">-5</failsafe>";
  start_and_wait({kCounter, {.file = "faulty.so", .name = "second", .priority = 2, .more = failsafe}});
  ASSERT_TRUE(runs_reach("second", 20));
  ASSERT_EQ(change({kCounter, {.file = "faulty.so", .name = "third", .priority = 2}}).code, 0);
  std::int32_t least = 1;
  EXPECT_TRUE(wait_until([&] {
    least = std::min(least, value<std::int32_t>("nt::output"));
    return module("second").state.load() == ModuleState::Stopped && module("third").runs.load() > 100;
  }));
  EXPECT_GE(least, 1) << "it was written for the module that ended";
  ASSERT_EQ(change({kCounter}).code, 0);
  EXPECT_TRUE(is_stopped("third"));
  const auto last = value<std::int32_t>("nt::output");
  EXPECT_GT(last, 100) << "it has no such value";
  // One that never runs writes none.
  const Outcome bad = change(
      {kCounter,
       {.file = "faulty.so", .name = "second", .priority = 2, .more = failsafe},
       {.file = "faulty.so", .name = "fourth", .priority = 3, .properties = {{"fault", "throw"}, {"at", "start"}}}});
  EXPECT_EQ(bad.code, 1) << bad.err;
  EXPECT_TRUE(is_stopped("second"));
  EXPECT_EQ(value<std::int32_t>("nt::output"), last);
  // And without a follower it ends with its value.
  ASSERT_EQ(change({kCounter, {.file = "faulty.so", .name = "second", .priority = 2, .more = failsafe}}).code, 0);
  ASSERT_TRUE(goes_on("second"));
  ASSERT_EQ(change({kCounter}).code, 0);
  EXPECT_TRUE(wait_until([&] { return value<std::int32_t>("nt::output") == -5; }));
}

}  // namespace
}  // namespace indurop::test
