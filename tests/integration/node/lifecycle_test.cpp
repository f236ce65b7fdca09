// SPDX-License-Identifier: Apache-2.0
// Names of nodes, signals in every phase, how long a run lasts, and the program's own errors.

#include <fcntl.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <fstream>
#include <functional>
#include <nlohmann/json.hpp>

#include "core/rt/clock.h"
#include "node_fixture.h"
#include "store/vars/store.h"

namespace indurop::test {
namespace {

using scheduler::NodeState;

const std::vector<Module> kCounter = {{.file = "counter.so", .name = "counter"}};

class Lifecycle : public NodeTest {
 protected:
  // `prepare` is called in the process that becomes the node.
  Program& start_prepared(const std::vector<Module>& modules, std::function<bool()> prepare) {
    Environment environment = this->environment();
    environment.prepare = std::move(prepare);
    return start_file(write("module.xml", xml(modules)), {}, environment);
  }
};

class Signals : public NodeTest, public ::testing::WithParamInterface<std::pair<int, int>> {
 protected:
  static int number() { return GetParam().first; }
  static int code() { return GetParam().second; }
};
INSTANTIATE_TEST_SUITE_P(Node, Signals, ::testing::Values(std::pair{SIGINT, 130}, std::pair{SIGTERM, 0}),
                         [](const auto& test) { return test.param.first == SIGINT ? "SIGINT" : "SIGTERM"; });

TEST_P(Signals, While_running) {
  Program& sut = start_and_wait(kCounter);
  ASSERT_TRUE(runs_reach("counter", 5));
  sut.signal(number());
  EXPECT_EQ(sut.wait(), code());
  EXPECT_CONTAINS(sut.out(), "counter stops after");
  EXPECT_EQ(run()->state.load(), NodeState::Stopped);
}

TEST_P(Signals, While_start_hangs) {
  SKIP_CRASHES_UNDER_TSAN();
  Program& sut =
      start({{.file = "counter.so", .name = "good", .priority = 1},
             {.file = "faulty.so", .name = "bad", .priority = 2, .properties = {{"fault", "loop"}, {"at", "start"}}}});
  ASSERT_TRUE(sut.prints("counter starts with"));
  sut.signal(number());
  EXPECT_EQ(sut.wait(), code() == 0 ? 1 : code()) << "a module faulted";
  EXPECT_TRUE(sut.says("start() failed: did not return within"));
  EXPECT_CONTAINS(sut.out(), "counter stops after 0 runs");
}

TEST_P(Signals, While_a_process_is_awaited) {
  Program& sut = start({{.file = "counter.so", .name = "counter"},
                        {.file = "process.exe",
                         .name = "never",
                         .type = "process",
                         .priority = 2,
                         .more = "<argument>never</argument>"}});
  ASSERT_TRUE(wait_until([&] {
    const auto* block = run();
    return block != nullptr && block->module_count == 2 && block->modules()[1].pid.load() > 0;
  }));
  const pid_t child = module("never").pid.load();
  sut.signal(number());
  EXPECT_EQ(sut.wait(), code());
  EXPECT_FALSE(alive(child));
}

TEST_P(Signals, At_any_instant_end_the_node) {
  for (int i = 0; i < 12; ++i) {
    Program& sut = start({{.file = "counter.so", .name = "counter"},
                          {.file = "process.exe", .name = "process", .type = "process", .priority = 2}});
    // Before main() has begun, a signal does what it always does.
    ASSERT_TRUE(wait_until([&] {
      const auto* block = run();
      return block != nullptr && block->node_pid.load() == sut.pid();
    }));
    std::this_thread::sleep_for(std::chrono::microseconds(i * 3000));
    sut.signal(number());
    EXPECT_EQ(sut.wait(), code()) << "signal " << i;
    EXPECT_THAT(sut.err(), ::testing::Not(::testing::HasSubstr("error")));
  }
}

TEST_P(Signals, A_second_one_while_stopping_changes_nothing) {
  Program& sut = start_and_wait(kCounter);
  sut.signal(number());
  sut.signal(number());
  EXPECT_EQ(sut.wait(), code());
}

TEST_F(Lifecycle, Sighup_stops_in_good_order) {
  Program& sut = start_and_wait(kCounter);
  sut.signal(SIGHUP);
  EXPECT_EQ(sut.wait(), 0);
  EXPECT_CONTAINS(sut.out(), "counter stops after");
}

TEST_F(Lifecycle, Sighup_is_ignored_as_nohup_wants_it) {
  Program& sut = start_prepared(kCounter, [] { return std::signal(SIGHUP, SIG_IGN) != SIG_ERR; });
  ASSERT_TRUE(wait_until_running(sut));
  sut.signal(SIGHUP);
  EXPECT_TRUE(runs_reach("counter", module("counter").runs.load() + 100));
  EXPECT_TRUE(sut.running());
  sut.signal(SIGTERM);
  EXPECT_EQ(sut.wait(), 0);
}

// Started by a program that ignores how its own children end.
TEST_F(Lifecycle, Ends_of_processes_are_noticed_although_sigchld_was_ignored) {
  Program& sut = start_prepared({{.file = "process.exe",
                                  .name = "dies",
                                  .type = "process",
                                  .more = "<argument>die</argument><argument>100</argument>"
                                          "<restart delay=\"50ms\" max=\"100\" window=\"1min\"/>"}},
                                [] { return std::signal(SIGCHLD, SIG_IGN) != SIG_ERR; });
  ASSERT_TRUE(wait_until_running(sut));
  EXPECT_TRUE(wait_until([&] { return module("dies").restarts.load() >= 2; }));
  sut.signal(SIGTERM);
  EXPECT_EQ(sut.wait(), 0);
  EXPECT_THAT(sut.err(), ::testing::Not(::testing::HasSubstr("was killed")));
}

TEST_F(Lifecycle, Second_node_of_one_name_is_refused) {
  Program& first = start_and_wait(kCounter);
  const auto sut = run_to_end(kCounter);
  EXPECT_EQ(sut.code, 1);
  EXPECT_CONTAINS(sut.err, "a node of this name is already running (pid " + std::to_string(first.pid()) + ")");
  EXPECT_CONTAINS(sut.err, "indurop stop --node " + node());
  EXPECT_TRUE(runs_reach("counter", module("counter").runs.load() + 20)) << "the first one does not notice";
  first.signal(SIGTERM);
  EXPECT_EQ(first.wait(), 0);
}

TEST_F(Lifecycle, Nodes_of_different_names_run_side_by_side) {
  Program& first = start_and_wait(kCounter);
  const std::string other = node() + "b";
  Program& second = start_file(write("b.xml", xml(kCounter)), {"--node", other, "--duration", "50ms"});
  EXPECT_EQ(second.wait(), 0);
  EXPECT_CONTAINS(second.out(), "counter stops after");
  EXPECT_EQ(indurop({"clean", "--node", other}).code, 0);
  EXPECT_TRUE(runs_reach("counter", module("counter").runs.load() + 20));
  first.signal(SIGTERM);
  EXPECT_EQ(first.wait(), 0);
}

TEST_F(Lifecycle, Duration_gives_every_basic_period_to_its_module) {
  const auto sut = run_to_end(kCounter, {"--duration", "100ms", "--report", folder() / "r.json"});
  EXPECT_EQ(sut.code, 0);
  const auto report = nlohmann::json::parse(std::ifstream(folder() / "r.json"));
  EXPECT_EQ(report["ticks"], 100);
  const auto& m = report["modules"][0];
  EXPECT_EQ(m["runs"].get<int>() + m["skipped"].get<int>(), 100);
  for (const char* quantity : {"jitter_ns", "exec_ns"}) {
    for (const char* key : {"min", "mean", "p50", "p99", "p99_9", "max"}) {
      EXPECT_TRUE(m[quantity].contains(key)) << quantity << ' ' << key;
    }
  }
  for (const char* key : {"node", "basic_period_ns", "macro_period_ns", "lost_ticks", "rt"}) {
    EXPECT_TRUE(report.contains(key)) << key;
  }
}

TEST_F(Lifecycle, Indurop_run_stop_and_status) {
  Program sut({INDUROP_PROGRAM, "run", write("module.xml", xml(kCounter)), "--node", node()}, environment());
  ASSERT_TRUE(wait_until_running(sut));
  EXPECT_EQ(indurop({"status", "-o", "json"}).code, 0);
  EXPECT_EQ(indurop({"stop"}).code, 0);
  EXPECT_EQ(sut.wait(), 0);
  EXPECT_EQ(indurop({"status", "-o", "json"}).code, 6);
}

TEST_F(Lifecycle, Orderly_stop_resets_values_and_keeps_the_retained) {
  Program& first = start_and_wait(kCounter);
  ASSERT_TRUE(runs_reach("counter", 10));
  first.signal(SIGTERM);
  ASSERT_EQ(first.wait(), 0);
  const auto kept = value<std::uint32_t>("nt::kept");
  EXPECT_EQ(value<std::uint32_t>("nt::counted"), kept);
  Program& second = start(kCounter);
  EXPECT_TRUE(second.prints("counter starts with counted 0, kept " + std::to_string(kept)));
}

TEST_F(Lifecycle, Usage_errors_exit_with_2) {
  const std::string file = write("module.xml", xml(kCounter));
  for (const auto& arguments : std::vector<std::vector<std::string>>{{"--frobnicate"},
                                                                     {"--node", "a/b"},
                                                                     {"--node", ""},
                                                                     {"--duration", "soon"},
                                                                     {"--spin", "fast"},
                                                                     {"--core", "9999"}}) {
    const auto sut = start_file(file, arguments).finish();
    EXPECT_EQ(sut.code, 2) << arguments.front();
    EXPECT_THAT(sut.err + sut.out, ::testing::Not(::testing::IsEmpty()));
  }
}

TEST_F(Lifecycle, What_ended_well_a_day_ago_is_removed_when_a_node_starts) {
  const std::string other = node() + "-2";
  const auto start_other = [&] {
    const auto sut = start_file((folder() / "module.xml").string(), {"--node", other, "--duration", "10ms"}).finish();
    EXPECT_EQ(sut.code, 0) << sut.err;
    EXPECT_TRUE(vars::remove_node(other).ok());
  };
  ASSERT_EQ(run_to_end(kCounter, {"--duration", "10ms"}).code, 0);
  start_other();
  EXPECT_FALSE(files_left().empty()) << "it ended just now";
  const auto long_ago = rt::MonoClock::now() - std::chrono::hours(25);
  vars::Store::attach(node(), vars::Mode::ReadWrite)->beat(long_ago);
  start_other();
  EXPECT_TRUE(files_left().empty());
  Program& killed = start_and_wait(kCounter);
  killed.kill();
  vars::Store::attach(node(), vars::Mode::ReadWrite)->beat(long_ago);
  start_other();
  EXPECT_FALSE(files_left().empty()) << "what crashed keeps its values";
}

// Its log lies on a full disk, or what read it has ended, or there is none.
TEST_F(Lifecycle, Output_that_cannot_be_written_does_not_end_a_running_node) {
  const auto full = [] {
    const int file = ::open("/dev/full", O_WRONLY);
    return ::dup2(file, STDOUT_FILENO) >= 0 && ::dup2(file, STDERR_FILENO) >= 0;
  };
  const auto not_read = [] {
    int ends[2];
    return ::pipe(ends) == 0 && ::close(ends[0]) == 0 && ::dup2(ends[1], STDOUT_FILENO) >= 0 &&
           ::dup2(ends[1], STDERR_FILENO) >= 0;
  };
  const auto closed = [] { return ::close(STDIN_FILENO) + ::close(STDOUT_FILENO) + ::close(STDERR_FILENO) == 0; };
  for (const std::function<bool()>& prepare : std::vector<std::function<bool()>>{full, not_read, closed}) {
    Program& sut = start_prepared({{.file = "flood.so", .name = "flood", .period = "10ms"}}, prepare);
    ASSERT_TRUE(wait_until_running(sut));
    EXPECT_TRUE(runs_reach("flood", 20));
    EXPECT_EQ(indurop({"status", "--node", node()}).code, 0);
    sut.signal(SIGTERM);
    EXPECT_EQ(sut.wait(), 0);
  }
}

// As behind a terminal that was stopped with Ctrl-S: processes are started again and a stop is obeyed nevertheless.
TEST_F(Lifecycle, Output_that_is_not_read_holds_nothing_up) {
  Program& sut = start_prepared({{.file = "counter.so", .name = "counter"},
                                 {.file = "process.exe",
                                  .name = "dies",
                                  .type = "process",
                                  .priority = 2,
                                  .more = "<argument>die</argument><argument>5</argument>"
                                          "<restart delay=\"1ms\" max=\"100000\" window=\"1min\"/>"}},
                                [] {
                                  int ends[2];  // the reading end stays open
                                  return ::pipe(ends) == 0 && ::fcntl(ends[1], F_SETPIPE_SZ, 4096) >= 0 &&
                                         ::dup2(ends[1], STDOUT_FILENO) >= 0 && ::dup2(ends[1], STDERR_FILENO) >= 0;
                                });
  ASSERT_TRUE(wait_until_running(sut));
  EXPECT_TRUE(wait_until([&] { return module("dies").restarts.load() >= 100; })) << module("dies").restarts.load();
  EXPECT_TRUE(runs_reach("counter", module("counter").runs.load() + 100));
  sut.signal(SIGTERM);
  EXPECT_EQ(sut.wait(), 0);
}

}  // namespace
}  // namespace indurop::test
