// SPDX-License-Identifier: Apache-2.0
// Boards and deployers that are killed in the middle: what is committed is never lost.

#include "killed_fixture.h"

namespace indurop::test {
namespace {

using testing::HasSubstr;

TEST_F(Killed, A_board_without_power_resumes_what_was_committed) {
  lose("a");
  start_agent("a");
  EXPECT_TRUE(both_run_the_committed());
}

TEST_F(Killed, An_agent_that_comes_back_takes_over_its_running_node) {
  const pid_t node = vars::running_node(board("a"));
  ASSERT_GT(node, 0);
  stop_agent("a", SIGKILL);
  start_agent("a");
  EXPECT_TRUE(both_run_the_committed());
  EXPECT_EQ(vars::running_node(board("a")), node);
  stop_agent("a", SIGTERM);
  EXPECT_EQ(vars::running_node(board("a")), 0) << "an agent that is stopped stops its node";
}

TEST_F(Killed, A_node_that_is_killed_is_started_again) {
  const pid_t node = vars::running_node(board("a"));
  kill_node(board("a"));
  EXPECT_TRUE(wait_until([&] { return vars::running_node(board("a")) != node && runs("a", committed_); }));
}

TEST_F(Killed, A_node_that_hangs_is_killed_and_started_again) {
  const pid_t node = vars::running_node(board("a"));
  ASSERT_EQ(::kill(node, SIGSTOP), 0);
  EXPECT_TRUE(wait_until([&] {
    return agent("a").err().find("the node hung: its tick stayed at") != std::string::npos;
  })) << agent("a").err();
  EXPECT_TRUE(wait_until([&] { return vars::running_node(board("a")) != node && runs("a", committed_); }));
}

TEST_F(Killed, A_node_that_dies_again_and_again_stays_down) {
  for (int i = 0; i < 4; ++i) {
    pid_t node = 0;
    ASSERT_TRUE(wait_until([&] { return (node = vars::running_node(board("a"))) > 0; })) << i;
    ::kill(node, SIGKILL);
    ASSERT_TRUE(wait_until([&] { return vars::running_node(board("a")) != node; }));
  }
  EXPECT_TRUE(wait_until([&] { return report("a")["state"] == "failed"; }));
  EXPECT_THAT(report("a")["message"].get<std::string>(), HasSubstr("signal 9"));
}

TEST_F(Killed, A_board_that_dies_in_the_trial_rolls_all_back) {
  Program& deployer = start_indurop({"deploy", next_, "--health", "8s"});
  ASSERT_TRUE(wait_until([&] { return in_phase("a", "trial"); }));
  lose("a");
  const Outcome outcome = deployer.finish();
  EXPECT_EQ(outcome.code, 5) << outcome.err;
  start_agent("a");
  EXPECT_TRUE(both_run_the_committed());
}

TEST_F(Killed, A_deployer_that_dies_in_the_trial_is_no_commit) {
  Program& deployer = start_indurop({"deploy", next_, "--health", "20s"});
  ASSERT_TRUE(wait_until([&] { return in_phase("a", "trial"); }));
  deployer.signal(SIGKILL);
  (void)deployer.finish();
  EXPECT_TRUE(both_run_the_committed());
  EXPECT_THAT(report("a")["message"].get<std::string>(), HasSubstr("deployer"));
  EXPECT_EQ(deploy(next_).code, 0) << "and the next one finds the boards free";
}

TEST_F(Killed, An_interrupted_deployment_is_taken_back_at_once) {
  Program& deployer = start_indurop({"deploy", next_, "--health", "20s"});
  ASSERT_TRUE(wait_until([&] { return in_phase("b", "trial"); }));
  deployer.signal(SIGINT);
  EXPECT_EQ(deployer.finish().code, 130);
  EXPECT_TRUE(both_run_the_committed());
}

TEST_F(Killed, A_board_that_missed_the_commit_takes_it_over) {
  lose("b");
  const Outcome done = deploy(next_, {"--allow-missing", "--timeout", "4s"});
  ASSERT_EQ(done.code, 0) << done.err;
  start_agent("b");
  EXPECT_TRUE(wait_until([&] { return runs("b", done.json()["deployment"]); }));
}

TEST_F(Killed, A_half_written_state_file_is_not_read) {
  stop_agent("a", SIGTERM);
  std::ofstream(folder() / "state" / board("a") / "committed.json.new") << "{ half";
  start_agent("a");
  EXPECT_TRUE(both_run_the_committed());
}

}  // namespace
}  // namespace indurop::test
