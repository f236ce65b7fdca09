// SPDX-License-Identifier: Apache-2.0
// indurop stop, start and restart of single modules: the others keep their ticks.

#include <csignal>
#include <filesystem>

#include "node_fixture.h"

namespace indurop::test {
namespace {

using scheduler::ModuleState;

class ModuleCommands : public NodeTest {
 protected:
  Outcome command(const std::string& verb, const std::string& module) const {
    return indurop({verb, module, "--node", node()});
  }
  // Its runs stay what they are while another module makes 50 of its own.
  bool rests(const std::string& name, const std::string& other) {
    const auto before = module(name).runs.load();
    return runs_reach(other, module(other).runs.load() + 50) && module(name).runs.load() == before;
  }
  static Module failsafe_module() {
    return {
        .file = "faulty.so", .name = "out", .priority = 2, .more = "<failsafe variable=\"nt::output\">-7</failsafe>"};
  }
};

TEST_F(ModuleCommands, A_stopped_module_leaves_its_place_empty_and_its_failsafe_values) {
  Program& sut = start_and_wait({{.file = "counter.so", .name = "counter"}, failsafe_module()});
  ASSERT_TRUE(runs_reach("out", 20));
  const Outcome stopped = command("stop", "out");
  EXPECT_EQ(stopped.code, 0) << stopped.err;
  EXPECT_CONTAINS(stopped.err, "module 'out' stopped after");
  EXPECT_EQ(module("out").state.load(), ModuleState::Stopped);
  EXPECT_EQ(value<std::int32_t>("nt::output"), -7);
  EXPECT_TRUE(rests("out", "counter"));
  EXPECT_LE(module("out").skipped.load(), run()->lost_ticks.load()) << "in addition to lost periods";
  EXPECT_TRUE(sut.prints("stop called\n"));
  EXPECT_CONTAINS(indurop({"status", "--node", node()}).out, "stopped");

  EXPECT_CONTAINS(command("stop", "out").err, "is stopped already");
  const Outcome started = command("start", "out");
  EXPECT_EQ(started.code, 0) << started.err;
  EXPECT_TRUE(runs_reach("out", module("out").runs.load() + 20));
  EXPECT_CONTAINS(command("start", "out").err, "runs already");
  sut.signal(SIGTERM);
  EXPECT_EQ(sut.wait(), 0) << sut.err();
  EXPECT_EQ(module("counter").overruns.load(), 0U);
}

TEST_F(ModuleCommands, Restart_calls_stop_and_start_once_each) {
  Program& sut = start_and_wait(
      {{.file = "counter.so", .name = "counter"}, {.file = "label.so", .name = "second", .priority = 2}});
  ASSERT_TRUE(runs_reach("counter", 10));
  EXPECT_EQ(command("restart", "counter").code, 0);
  EXPECT_TRUE(sut.prints("counter stops after"));
  const std::string text = sut.out();
  EXPECT_NE(text.find("counter starts with"), text.rfind("counter starts with")) << text;
  EXPECT_TRUE(runs_reach("counter", module("counter").runs.load() + 20));
}

TEST_F(ModuleCommands, Restart_says_that_the_loaded_code_runs_on_when_the_file_is_another_one) {
  const std::filesystem::path built = std::filesystem::path(MODULE_DIR) / "counter.so";
  const std::filesystem::path file = folder() / "copied.so";
  std::filesystem::copy_file(built, file);
  Program& sut = start_and_wait({{.file = file.string(), .name = "counter"}});
  ASSERT_TRUE(runs_reach("counter", 10));
  EXPECT_FALSE(contains(command("restart", "counter").err, "another one"));
  std::filesystem::copy_file(built, folder() / "new.so");
  std::filesystem::rename(folder() / "new.so", file);
  const Outcome restarted = command("restart", "counter");
  EXPECT_EQ(restarted.code, 0) << restarted.err;
  EXPECT_CONTAINS(restarted.err, "with the code that was loaded when the node started: its file is another one now");
  EXPECT_TRUE(runs_reach("counter", module("counter").runs.load() + 20)) << "it runs all the same";
  sut.signal(SIGTERM);
  EXPECT_EQ(sut.wait(), 0);
  EXPECT_CONTAINS(sut.err(), "its file is another one now");
}

TEST_F(ModuleCommands, A_stopped_module_gets_no_second_stop_when_the_node_ends) {
  Program& sut = start_and_wait({{.file = "counter.so", .name = "counter"}, failsafe_module()});
  ASSERT_TRUE(runs_reach("out", 5));
  ASSERT_EQ(command("stop", "out").code, 0);
  sut.signal(SIGTERM);
  EXPECT_EQ(sut.wait(), 0);
  const std::string text = sut.out();
  EXPECT_NE(text.find("stop called"), std::string::npos);
  EXPECT_EQ(text.find("stop called"), text.rfind("stop called"));
}

TEST_F(ModuleCommands, A_module_of_a_band_of_its_own_stops_and_starts) {
  start_and_wait({{.file = "counter.so", .name = "counter"},
                  {.file = "faulty.so", .name = "slow", .period = "5ms", .priority = 2},
                  {.file = "event.so", .name = "event", .operation = "sporadic", .period = "10ms", .priority = 1}});
  ASSERT_TRUE(runs_reach("slow", 5) && runs_reach("event", 5));
  for (const char* name : {"slow", "event"}) {
    EXPECT_EQ(command("stop", name).code, 0);
    EXPECT_TRUE(rests(name, "counter")) << name;
    EXPECT_EQ(command("start", name).code, 0);
    EXPECT_TRUE(runs_reach(name, module(name).runs.load() + 5)) << name;
  }
}

TEST_F(ModuleCommands, A_process_module_ends_and_comes_back) {
  start_and_wait({{.file = "counter.so", .name = "counter"},
                  {.file = "process.exe",
                   .name = "process",
                   .type = "process",
                   .period = "2ms",
                   .priority = 2,
                   .more = "<argument>count</argument>"}});
  ASSERT_TRUE(runs_reach("process", 20));
  const pid_t first = module("process").pid.load();
  const Outcome stopped = command("stop", "process");
  EXPECT_EQ(stopped.code, 0) << stopped.err;
  EXPECT_FALSE(alive(first));
  EXPECT_EQ(module("process").state.load(), ModuleState::Stopped);
  EXPECT_TRUE(rests("process", "counter"));
  EXPECT_EQ(command("start", "process").code, 0);
  EXPECT_TRUE(runs_reach("process", module("process").runs.load() + 20));
  const pid_t second = module("process").pid.load();
  EXPECT_EQ(command("restart", "process").code, 0);
  EXPECT_FALSE(alive(second));
  EXPECT_TRUE(runs_reach("process", module("process").runs.load() + 20));
  EXPECT_EQ(module("process").faults.load(), 0U);
  EXPECT_EQ(module("process").restarts.load(), 0U);
}

TEST_F(ModuleCommands, A_process_that_does_not_listen_is_killed) {
  start_and_wait({{.file = "counter.so", .name = "counter"},
                  {.file = "process.exe",
                   .name = "deaf",
                   .type = "process",
                   .priority = 2,
                   .more = "<argument>deaf</argument><budget>off</budget>"}});
  ASSERT_TRUE(wait_until([&] { return value<std::uint32_t>("nt::process_runs") > 0; }));
  const pid_t pid = module("deaf").pid.load();
  EXPECT_EQ(command("stop", "deaf").code, 0);
  EXPECT_FALSE(alive(pid));
}

TEST_F(ModuleCommands, A_normal_module_ends_and_comes_back) {
  start_and_wait({{.file = "counter.so", .name = "counter"},
                  {.file = "faulty.so", .name = "normal", .operation = "non-real", .more = "<period>5ms</period>"}});
  ASSERT_TRUE(runs_reach("normal", 5));
  EXPECT_EQ(command("stop", "normal").code, 0);
  EXPECT_TRUE(rests("normal", "counter"));
  EXPECT_EQ(command("start", "normal").code, 0);
  EXPECT_TRUE(runs_reach("normal", module("normal").runs.load() + 5));
}

TEST_F(ModuleCommands, A_faulted_module_starts_again) {
  SKIP_CRASHES_UNDER_TSAN();
  Program& sut = start_and_wait(
      {{.file = "counter.so", .name = "counter"},
       {.file = "faulty.so", .name = "bad", .priority = 2, .properties = {{"fault", "segv"}, {"after", "10"}}}});
  ASSERT_TRUE(wait_until([&] { return module("bad").state.load() == ModuleState::Faulted; }));
  const Outcome started = command("start", "bad");
  EXPECT_EQ(started.code, 0) << started.err;
  EXPECT_TRUE(sut.prints("stop called"));
  EXPECT_TRUE(wait_until([&] { return module("bad").faults.load() == 2; })) << "it runs, and faults again";
}

TEST_F(ModuleCommands, A_module_whose_start_fails_stays_out_and_the_cause_is_reported) {
  SKIP_CRASHES_UNDER_TSAN();
  // Throws in stop() too: that is reported, and it is stopped nevertheless.
  start_and_wait(
      {{.file = "counter.so", .name = "counter"},
       {.file = "faulty.so", .name = "bad", .priority = 2, .properties = {{"fault", "throw"}, {"at", "stop"}}}});
  ASSERT_TRUE(runs_reach("bad", 5));
  EXPECT_EQ(command("stop", "bad").code, 0);
  EXPECT_CONTAINS(std::string(module("bad").last_fault), "stop() failed: exception: out of ink");
  EXPECT_EQ(module("bad").state.load(), ModuleState::Stopped);
  EXPECT_TRUE(rests("bad", "counter"));
}

TEST_F(ModuleCommands, Unknown_names_and_absent_nodes_are_reported) {
  Program& sut = start_and_wait({{.file = "counter.so", .name = "counter"}});
  const Outcome wrong = command("stop", "conter");
  EXPECT_EQ(wrong.code, 1);
  EXPECT_CONTAINS(wrong.err, "has no module 'conter'. Did you mean 'counter'?");
  EXPECT_EQ(indurop({"start", "--node", node()}).code, 2);
  EXPECT_EQ(indurop({"stop", "counter@", "--node", node()}).code, 2);
  sut.signal(SIGTERM);
  EXPECT_EQ(sut.wait(), 0);
  const Outcome gone = command("stop", "counter");
  EXPECT_EQ(gone.code, 6);
  EXPECT_CONTAINS(gone.err, "does not run");
}

TEST_F(ModuleCommands, The_node_ends_while_a_command_is_carried_out) {
  SKIP_CRASHES_UNDER_TSAN();
  Program& sut = start_and_wait(
      {{.file = "counter.so", .name = "counter"},
       {.file = "faulty.so", .name = "bad", .priority = 2, .properties = {{"fault", "loop"}, {"at", "stop"}}}});
  ASSERT_TRUE(runs_reach("bad", 5));
  Program stopping({INDUROP_PROGRAM, "stop", "bad", "--node", node()}, environment());
  ASSERT_TRUE(sut.prints("stop called"));
  sut.signal(SIGTERM);
  EXPECT_EQ(sut.wait(), 1) << "stop() never returned, which is a fault";
  EXPECT_EQ(stopping.wait(), 6) << stopping.err();
}

}  // namespace
}  // namespace indurop::test
