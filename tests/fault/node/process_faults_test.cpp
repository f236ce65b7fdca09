// SPDX-License-Identifier: Apache-2.0
// Process modules that end, hang, die or are killed: named, restarted within their limits, and no other module is
// affected.

#include <csignal>
#include <string>

#include "node_fixture.h"

namespace indurop::test {
namespace {

using scheduler::ModuleState;

const Module kGood = {.file = "counter.so", .name = "good"};

std::string arguments(const std::vector<std::string>& list) {
  std::string text;
  for (const std::string& argument : list) {
    text += "<argument>" + argument + "</argument>";
  }
  return text;
}

Module process(const std::vector<std::string>& how, const std::string& more = "") {
  return {.file = "process.exe",
          .name = "bad",
          .type = "process",
          .period = "2ms",
          .priority = 2,
          .more = arguments(how) + more};
}

class ProcessFaults : public NodeTest {
 protected:
  bool bad_is(ModuleState state) {
    const auto& record = module("bad");
    return wait_until([&] { return record.state.load() == state; });
  }
  bool good_goes_on() { return runs_reach("good", module("good").runs.load() + 50); }
};

TEST_F(ProcessFaults, Exit_code_is_named_and_after_its_restarts_it_stays_away) {
  Program& sut = start_and_wait({kGood, process({"exit", "3"}, "<restart delay=\"5ms\" max=\"2\"/>")});
  EXPECT_TRUE(bad_is(ModuleState::Faulted));
  EXPECT_EQ(module("bad").restarts.load(), 2U);
  EXPECT_EQ(module("bad").faults.load(), 3U);
  EXPECT_EQ(module("bad").runs.load(), 0U);
  EXPECT_TRUE(sut.says("exited with code 3 before it called irp::waitPeriod()"));
  EXPECT_TRUE(sut.says("module bad: stays stopped, it was restarted 2 times within 60 s"));
  EXPECT_TRUE(good_goes_on());
  sut.signal(SIGTERM);
  EXPECT_EQ(sut.wait(), 1);
}

TEST_F(ProcessFaults, Exit_without_an_error_is_one_for_a_periodic_module) {
  Program& sut = start_and_wait({kGood, process({"exit", "0"}, "<restart delay=\"5ms\" max=\"0\"/>")});
  EXPECT_TRUE(bad_is(ModuleState::Faulted));
  EXPECT_TRUE(sut.says("exited with code 0"));
}

TEST_F(ProcessFaults, Non_real_time_module_may_finish) {
  Program& sut = start_and_wait({kGood,
                                 {.file = "process.exe",
                                  .name = "bad",
                                  .type = "process",
                                  .operation = "non-real",
                                  .more = arguments({"exit", "0"})}});
  EXPECT_TRUE(bad_is(ModuleState::Exited));
  EXPECT_EQ(module("bad").faults.load(), 0U);
  sut.signal(SIGTERM);
  EXPECT_EQ(sut.wait(), 0);
}

TEST_F(ProcessFaults, Escalation_stops_the_node) {
  const auto sut =
      run_to_end({kGood, process({"exit", "3"}, "<restart delay=\"5ms\" max=\"1\" escalate=\"stop-node\"/>")});
  EXPECT_EQ(sut.code, 1);
  EXPECT_CONTAINS(sut.err, "process module bad died 2 times within 60 s (escalate stop-node)");
}

TEST_F(ProcessFaults, Restarts_outside_the_window_are_forgotten) {
  Program& sut = start_and_wait({kGood, process({"die", "5"}, "<restart delay=\"60ms\" max=\"1\" window=\"20ms\"/>")});
  EXPECT_TRUE(wait_until([&] { return module("bad").restarts.load() >= 4; }));
  EXPECT_TRUE(sut.running());
  sut.signal(SIGINT);
  EXPECT_EQ(sut.wait(), 130);
}

TEST_F(ProcessFaults, One_that_dies_again_and_again_comes_back_each_time) {
  Program& sut = start_and_wait({kGood, process({"die", "50"},
                                                "<restart delay=\"1ms\" max=\"1000\"/>"
                                                "<failsafe variable=\"nt::output\">-7</failsafe>")});
  EXPECT_TRUE(wait_until([&] { return module("bad").restarts.load() >= 3; }));
  EXPECT_TRUE(sut.says("module bad faulted at tick"));
  EXPECT_TRUE(sut.says("ended by signal 9 (Killed)"));
  EXPECT_EQ(value<std::int32_t>("nt::output"), -7);
  EXPECT_GE(value<std::uint32_t>("nt::process_runs"), 150U);
  EXPECT_TRUE(good_goes_on());
}

TEST_F(ProcessFaults, One_that_never_enrols_does_not_hold_up_the_others) {
  Program& sut = start_and_wait({kGood, process({"never"})});
  EXPECT_TRUE(good_goes_on());
  EXPECT_EQ(module("bad").state.load(), ModuleState::Starting);
  EXPECT_EQ(module("bad").runs.load(), 0U);
  const pid_t pid = module("bad").pid.load();
  sut.signal(SIGTERM);
  EXPECT_EQ(sut.wait(), 0);
  EXPECT_FALSE(alive(pid));
}

TEST_F(ProcessFaults, One_that_ignores_everything_is_killed_at_the_end) {
  Program& sut = start_and_wait({kGood, process({"deaf"}, "<budget>off</budget>")});
  EXPECT_TRUE(wait_until([&] { return module("bad").overruns.load() > 0; }));
  const pid_t pid = module("bad").pid.load();
  sut.signal(SIGTERM);
  EXPECT_EQ(sut.wait(), 0);
  EXPECT_TRUE(sut.says("module bad did not end within 2 s and was killed"));
  EXPECT_FALSE(alive(pid));
}

TEST_F(ProcessFaults, Endless_loop_is_ended_by_the_budget) {
  Program& sut =
      start_and_wait({kGood, process({"loop", "5"}, "<budget>20ms</budget><restart delay=\"5ms\" max=\"1\"/>")});
  EXPECT_TRUE(bad_is(ModuleState::Faulted));
  EXPECT_TRUE(sut.says("killed: one run took longer than its budget of 20000 us"));
  EXPECT_EQ(module("bad").faults.load(), 2U);
  EXPECT_TRUE(good_goes_on());
}

TEST_F(ProcessFaults, Storm_of_kills_never_shows_torn_values) {
  Program& sut = start_and_wait({{.file = "writer.exe",
                                  .name = "bad",
                                  .type = "process",
                                  .priority = 2,
                                  .more = "<budget>off</budget><restart delay=\"0\" max=\"1000000\"/>"},
                                 {.file = "verify.so", .name = "good", .priority = 1}});
  constexpr std::uint64_t kKills = 60;
  for (std::uint64_t kill = 1; kill <= kKills; ++kill) {
    const auto written = value<std::uint64_t>("nt::newest");
    ASSERT_TRUE(wait_until([&] { return value<std::uint64_t>("nt::newest") > written + kill * 7; }));
    const pid_t pid = module("bad").pid.load();
    if (pid > 0) {
      ::kill(pid, SIGKILL);
    }
    ASSERT_TRUE(wait_until([&] { return module("bad").restarts.load() >= kill; }));
  }
  EXPECT_GT(value<std::uint64_t>("nt::looks"), 0U);
  EXPECT_EQ(value<std::uint64_t>("nt::torn"), 0U);
  EXPECT_TRUE(sut.running());
  sut.signal(SIGTERM);
  EXPECT_EQ(sut.wait(), 0);
}

TEST_F(ProcessFaults, Stopped_process_is_an_overrun_and_goes_on_afterwards) {
  Program& sut = start_and_wait({kGood, process({"count"}, "<budget>off</budget>")});
  ASSERT_TRUE(runs_reach("bad", 5));
  const pid_t pid = module("bad").pid.load();
  ::kill(pid, SIGSTOP);
  ASSERT_TRUE(wait_until([&] { return module("bad").overruns.load() > 3; }));
  EXPECT_TRUE(good_goes_on());
  ::kill(pid, SIGCONT);
  EXPECT_TRUE(runs_reach("bad", module("bad").runs.load() + 5));
  sut.signal(SIGTERM);
  EXPECT_EQ(sut.wait(), 0);
}

TEST_F(ProcessFaults, A_program_of_an_older_schema_gets_the_name_of_the_changed_field) {
  Program& sut = start_and_wait({{.file = "layout_old.so", .name = "good"}});
  ASSERT_TRUE(runs_reach("good", 3));
  Program observer({std::string(MODULE_DIR) + "/layout_observer.exe"}, environment());
  observer.input("\n");
  EXPECT_TRUE(observer.prints("attach 0, moves yes"));
  // The node comes back with a newer layout of the same variable.
  sut.signal(SIGTERM);
  ASSERT_EQ(sut.wait(), 0);
  start_and_wait({{.file = "layout_new.so", .name = "good"}});
  ASSERT_TRUE(runs_reach("good", 3));
  observer.input("\n");
  EXPECT_TRUE(observer.says("nt_layout::axis"));
  EXPECT_TRUE(observer.prints("attach -"));
  EXPECT_CONTAINS(observer.err(), "speed");
  EXPECT_TRUE(observer.running()) << "it may go on with what it has";
}

}  // namespace
}  // namespace indurop::test
