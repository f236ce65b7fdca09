// SPDX-License-Identifier: Apache-2.0
// Deployers, agents and nodes killed in each phase of a change of the schedule on two boards: in the end both boards
// run by the same one, and nodes that were not killed have never been started again.

#include "schedule_fixture.h"

namespace indurop::test {
namespace {

class ScheduleKills : public ScheduleTest {
 protected:
  void SetUp() override {
    start_with({press_of("a"), ticks_of("a")}, {press_of("b"), ticks_of("b")}, "cpp_first");
    add_file("slow_start", "cpp_waits");
  }
  // Board a has another period, and board b a module in place of its press that starts slowly.
  std::string next() {
    return plant_of({press_of("a", "20ms"), ticks_of("a")}, {{"slow", "slow_start", "20ms"}, ticks_of("b")});
  }
  Program& deploy_until_loading() {
    Program& deployer = start_indurop({"deploy", next(), "--health", "500ms", "--timeout", "60s"});
    EXPECT_TRUE(wait_until([&] { return report("a")["phase"] == "prepared" && report("b")["phase"] == "checking"; }));
    return deployer;
  }
  void let_b_start() const { std::ofstream(path("go")) << "go\n"; }
  // Both boards run by the new schedule, and monitor it for a while.
  Program& deploy_until_changed() {
    let_b_start();
    Program& deployer = start_indurop({"deploy", next(), "--health", "60s", "--timeout", "20s"});
    EXPECT_TRUE(wait_until([&] { return seen("a").schedule == 2 && seen("b").schedule == 2; }));
    EXPECT_TRUE(wait_until([&] { return report("a")["phase"] == "trial" && report("b")["phase"] == "trial"; }));
    return deployer;
  }
  void expect_the_first_everywhere() {
    EXPECT_TRUE(both_run(first_)) << agent("a").err() << agent("b").err();
    EXPECT_EQ(seen("a").periods["press"], 10'000'000);
    EXPECT_EQ(seen("b").periods["press"], 10'000'000);
    EXPECT_FALSE(seen("b").ended.contains("press"));
    EXPECT_TRUE(goes_on("a"));
    EXPECT_TRUE(goes_on("b"));
  }
  bool goes_on(const std::string& name) {
    const std::int64_t turns = number(name, "turns");
    return wait_until([&] { return number(name, "turns") > turns; });
  }
  void expect_same_node(const std::string& name) {
    EXPECT_EQ(vars::running_node(board(name)), pids_[name]) << "the node of board " << name << " was started again";
  }
};

TEST_F(ScheduleKills, A_deployer_killed_while_a_board_prepares_changes_nothing) {
  Program& deployer = deploy_until_loading();
  deployer.signal(SIGKILL);
  (void)deployer.finish();
  EXPECT_TRUE(wait_until([&] { return runs("a", first_); })) << "it does not wait for b";
  let_b_start();
  expect_the_first_everywhere();
  expect_same_node("a");
  expect_same_node("b");
  EXPECT_EQ(seen("a").schedule, 1U);
  const Outcome again = deploy(next());
  EXPECT_EQ(again.code, 0) << "the next one finds the boards free: " << again.err;
  expect_as_said("b");
  expect_same_node("b");
}

TEST_F(ScheduleKills, An_agent_killed_while_its_board_prepares_changes_nothing) {
  Program& deployer = deploy_until_loading();
  stop_agent("b", SIGKILL);
  EXPECT_EQ(deployer.finish().code, 1) << deployer.err();
  let_b_start();
  start_agent("b");
  expect_the_first_everywhere();
  expect_same_node("a");
  expect_same_node("b");
}

TEST_F(ScheduleKills, A_node_killed_while_it_prepares_changes_nothing) {
  Program& deployer = deploy_until_loading();
  kill_node(board("b"));
  const Outcome outcome = deployer.finish();
  EXPECT_EQ(outcome.code, 4) << outcome.err;
  EXPECT_THAT(outcome.err, HasSubstr(board("b") + ": its node ended"));
  let_b_start();
  expect_the_first_everywhere();
  expect_same_node("a");
}

TEST_F(ScheduleKills, A_deployer_killed_in_the_trial_brings_the_former_schedule_back) {
  Program& deployer = deploy_until_changed();
  deployer.signal(SIGKILL);
  (void)deployer.finish();
  expect_the_first_everywhere();
  expect_same_node("a");
  expect_same_node("b");
}

TEST_F(ScheduleKills, An_agent_killed_in_the_trial_brings_the_former_schedule_back) {
  Program& deployer = deploy_until_changed();
  stop_agent("b", SIGKILL);
  const Outcome outcome = deployer.finish();
  EXPECT_EQ(outcome.code, 5) << outcome.err;
  EXPECT_THAT(outcome.err, HasSubstr(board("b") + ": it no longer reports"));
  EXPECT_EQ(seen("b").schedule, 2U) << "its node goes on";
  start_agent("b");
  expect_the_first_everywhere();
  expect_same_node("a");
  expect_same_node("b");
}

TEST_F(ScheduleKills, A_node_killed_in_the_trial_brings_the_former_schedule_back) {
  Program& deployer = deploy_until_changed();
  kill_node(board("b"));
  EXPECT_EQ(deployer.finish().code, 5) << deployer.err();
  expect_the_first_everywhere();
  expect_same_node("a");
}

TEST_F(ScheduleKills, A_cancelled_deployer_brings_the_former_schedule_back) {
  Program& deployer = deploy_until_changed();
  deployer.signal(SIGINT);
  EXPECT_EQ(deployer.finish().code, 130);
  expect_the_first_everywhere();
  expect_same_node("a");
  expect_same_node("b");
}

TEST_F(ScheduleKills, A_board_killed_in_the_trial_resumes_the_former_schedule) {
  Program& deployer = deploy_until_changed();
  stop_agent("b", SIGKILL);
  kill_node(board("b"));
  EXPECT_EQ(deployer.finish().code, 5) << deployer.err();
  start_agent("b");
  expect_the_first_everywhere();
  expect_same_node("a");
}

// Its agent comes back to a node that has outlived it and takes over the schedule from the other board.
TEST_F(ScheduleKills, A_board_whose_agent_missed_the_commit_takes_it_over_without_a_restart) {
  stop_agent("b", SIGKILL);
  let_b_start();
  const Outcome done = deploy(next(), {"--allow-missing", "--timeout", "3s"});
  ASSERT_EQ(done.code, 0) << done.err;
  expect_as_said("a");
  start_agent("b");
  EXPECT_TRUE(both_run(done.json()["deployment"])) << agent("b").err();
  expect_as_said("b");
  expect_same_node("a");
  expect_same_node("b");
}

}  // namespace
}  // namespace indurop::test
