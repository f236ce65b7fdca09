// SPDX-License-Identifier: Apache-2.0
// Deployers, agents and nodes killed in each phase of an exchange on two boards: in the end both boards run the same
// deployment, and nodes that were not killed have never been started again.

#include "exchange_fixture.h"

namespace indurop::test {
namespace {

class ExchangeKills : public ExchangeTest {
 protected:
  void SetUp() override { start_plant("cpp_first"); }
  void bring_second(const std::string& press_b) {
    bring("a", "press_a_second");
    bring("b", press_b);
  }
  // A deployer whose board a is prepared, and whose board b starts its new version until let_b_start().
  Program& deploy_until_loading() {
    bring_second("cpp_waits");
    Program& deployer = start_indurop({"deploy", plant(), "--health", "500ms", "--timeout", "60s"});
    EXPECT_TRUE(wait_until([&] { return report("a")["phase"] == "prepared" && report("b")["phase"] == "checking"; }));
    return deployer;
  }
  void let_b_start() const { std::ofstream(path("go")) << "go\n"; }
  // A deployer whose boards both run the new versions, and monitor them for a while.
  Program& deploy_until_exchanged() {
    bring_second("cpp_second");
    Program& deployer = start_indurop({"deploy", plant(), "--health", "60s", "--timeout", "20s"});
    EXPECT_TRUE(shows("a", -1));
    EXPECT_TRUE(shows("b", -1));
    EXPECT_TRUE(wait_until([&] { return report("a")["phase"] == "trial" && report("b")["phase"] == "trial"; }));
    return deployer;
  }
  void expect_the_first_everywhere() {
    EXPECT_TRUE(both_run(first_)) << agent("a").err() << agent("b").err();
    EXPECT_TRUE(shows("a", 1));
    EXPECT_TRUE(shows("b", 1));
  }
};

TEST_F(ExchangeKills, A_deployer_killed_while_a_board_loads_changes_nothing) {
  Program& deployer = deploy_until_loading();
  deployer.signal(SIGKILL);
  (void)deployer.finish();
  EXPECT_TRUE(wait_until([&] { return runs("a", first_); })) << "it does not wait for b";
  let_b_start();
  expect_the_first_everywhere();
  expect_untouched("a");
  expect_untouched("b");
  bring_second("cpp_second");
  EXPECT_EQ(deploy(plant()).code, 0) << "the next one finds the boards free";
  EXPECT_TRUE(shows("b", -1));
  expect_untouched("b");
}

TEST_F(ExchangeKills, An_agent_killed_while_its_board_loads_changes_nothing) {
  Program& deployer = deploy_until_loading();
  stop_agent("b", SIGKILL);
  EXPECT_EQ(deployer.finish().code, 1) << deployer.err();
  let_b_start();
  start_agent("b");
  expect_the_first_everywhere();
  expect_untouched("a");
  expect_untouched("b");
}

TEST_F(ExchangeKills, A_node_killed_while_it_loads_changes_nothing) {
  Program& deployer = deploy_until_loading();
  kill_node(board("b"));
  const Outcome outcome = deployer.finish();
  EXPECT_EQ(outcome.code, 4) << outcome.err;
  EXPECT_THAT(outcome.err, HasSubstr(board("b") + ": its node ended"));
  let_b_start();
  expect_the_first_everywhere();
  expect_untouched("a");
}

TEST_F(ExchangeKills, A_deployer_killed_in_the_trial_takes_all_boards_back) {
  Program& deployer = deploy_until_exchanged();
  deployer.signal(SIGKILL);
  (void)deployer.finish();
  expect_the_first_everywhere();
  expect_untouched("a");
  expect_untouched("b");
}

TEST_F(ExchangeKills, An_agent_killed_in_the_trial_takes_all_boards_back) {
  Program& deployer = deploy_until_exchanged();
  stop_agent("b", SIGKILL);
  const Outcome outcome = deployer.finish();
  EXPECT_EQ(outcome.code, 5) << outcome.err;
  EXPECT_THAT(outcome.err, HasSubstr(board("b") + ": it no longer reports"));
  EXPECT_TRUE(shows("a", 1));
  EXPECT_LT(number("b", "shown"), 0) << "its node goes on";
  start_agent("b");
  expect_the_first_everywhere();
  expect_untouched("a");
  expect_untouched("b");
}

TEST_F(ExchangeKills, A_node_killed_in_the_trial_takes_all_boards_back) {
  Program& deployer = deploy_until_exchanged();
  kill_node(board("b"));
  EXPECT_EQ(deployer.finish().code, 5) << deployer.err();
  expect_the_first_everywhere();
  expect_untouched("a");
}

TEST_F(ExchangeKills, A_cancelled_deployer_takes_all_boards_back) {
  Program& deployer = deploy_until_exchanged();
  deployer.signal(SIGINT);
  EXPECT_EQ(deployer.finish().code, 130);
  expect_the_first_everywhere();
  expect_untouched("a");
  expect_untouched("b");
}

TEST_F(ExchangeKills, A_board_killed_in_the_trial_resumes_the_first_deployment) {
  Program& deployer = deploy_until_exchanged();
  stop_agent("b", SIGKILL);
  kill_node(board("b"));
  EXPECT_EQ(deployer.finish().code, 5) << deployer.err();
  start_agent("b");
  expect_the_first_everywhere();
  expect_untouched("a");
}

// Its agent comes back to a node that has outlived it and takes over the deployment from the other board.
TEST_F(ExchangeKills, A_board_whose_agent_missed_the_commit_takes_it_over_without_a_restart) {
  stop_agent("b", SIGKILL);
  bring_second("cpp_second");
  const Outcome done = deploy(plant(), {"--allow-missing", "--timeout", "3s"});
  ASSERT_EQ(done.code, 0) << done.err;
  EXPECT_TRUE(shows("a", -1));
  start_agent("b");
  EXPECT_TRUE(both_run(done.json()["deployment"])) << agent("b").err();
  EXPECT_TRUE(shows("b", -1));
  expect_untouched("a");
  expect_untouched("b");
}

}  // namespace
}  // namespace indurop::test
