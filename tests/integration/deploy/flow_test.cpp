// SPDX-License-Identifier: Apache-2.0
// New versions of modules on two boards bring variables that one of them writes and the other one reads: the nodes go
// on, and so do the variables that they exchange already.

#include "flow_fixture.h"

namespace indurop::test {
namespace {

class Flow : public FlowTest {};

class FlowOfProcess : public FlowTest {
 protected:
  FlowOfProcess() { source_is_process_ = true; }
};

TEST_F(FlowOfProcess, New_variables_are_sent_from_their_first_run_on_and_the_nodes_go_on) {
  Judge judge(board("b"));
  bring("new", "new");
  EXPECT_THAT(why(deploy(plant(), {"--dry-run"}).json(), board("a"), "source"),
              HasSubstr("what it carries is known when its new process runs"));
  EXPECT_EQ(SeenNode(board("a")).find("xt::flow"), std::nullopt) << "nothing was changed";
  const Outcome done = deploy(plant());
  ASSERT_EQ(done.code, 0) << done.err << agent("a").err() << agent("b").err();
  EXPECT_THAT(why(done.json(), board("a"), "source"), HasSubstr("new: "));
  EXPECT_TRUE(flows());
  EXPECT_THAT(mirrored("b"), testing::ElementsAre("xt::a_turns", "xt::flow", "xt::wide"));
  expect_untouched();
  expect_sound(judge);
}

TEST_F(Flow, New_variables_are_sent_from_their_first_run_on_and_the_nodes_go_on) {
  Judge judge(board("b"));
  bring("new", "new");
  const Outcome plan = deploy(plant(), {"--dry-run"});
  EXPECT_EQ(plan.code, 0) << plan.err;
  EXPECT_THAT(why(plan.json(), board("a"), "source"), HasSubstr("new: "));
  EXPECT_THAT(why(plan.json(), board("a"), "source"), HasSubstr("xt::flow"));
  EXPECT_THAT(why(plan.json(), board("b"), "sink"), HasSubstr("xt::wide"));
  EXPECT_EQ(SeenNode(board("a")).find("xt::flow"), std::nullopt) << "nothing was changed";
  EXPECT_THAT(mirrored("b"), testing::ElementsAre("xt::a_turns"));

  const Outcome done = deploy(plant());
  ASSERT_EQ(done.code, 0) << done.err << agent("a").err() << agent("b").err();
  EXPECT_TRUE(flows());
  EXPECT_THAT(mirrored("b"), testing::ElementsAre("xt::a_turns", "xt::flow", "xt::wide"));
  expect_untouched();
  expect_sound(judge);
}

TEST_F(Flow, A_reload_of_one_board_names_the_deployment_that_brings_new_variables) {
  const std::string file = std::string(FLOW_FOLDER) + "/source_new.so";
  for (const bool dry : {true, false}) {
    std::vector<std::string> words = {"reload", "source", file, "--board", board("a"), "--health", "0s"};
    if (dry) {
      words.emplace_back("--dry-run");
    }
    const Outcome refused = indurop(words);
    EXPECT_EQ(refused.code, 4) << refused.out << refused.err;
    EXPECT_THAT(refused.err, HasSubstr("variable xt::flow is not one of this board"));
    EXPECT_THAT(refused.err, HasSubstr("variable xt::wide is not one of this board"));
    EXPECT_THAT(refused.err, HasSubstr("`indurop deploy` brings new variables to all boards of a plant"));
    EXPECT_THAT(refused.err, testing::Not(HasSubstr("restart the node")));
  }
  EXPECT_EQ(SeenNode(board("a")).find("xt::flow"), std::nullopt) << "nothing was changed";
  expect_untouched();
  bring("new", "new");
  const Outcome done = deploy(plant());
  ASSERT_EQ(done.code, 0) << done.err;
  EXPECT_TRUE(flows());
  expect_untouched();
}

TEST_F(Flow, A_rollback_and_the_way_forward_leave_the_nodes_running) {
  Judge judge(board("b"));
  bring("new", "new");
  const Outcome done = deploy(plant());
  ASSERT_EQ(done.code, 0) << done.err;
  ASSERT_TRUE(flows());
  const Outcome back = indurop({"rollback", "--health", "300ms", "-o", "json"});
  ASSERT_EQ(back.code, 0) << back.err;
  EXPECT_EQ(back.json()["deployment"], first_);
  EXPECT_TRUE(wait_until([] { return mirrored("b") == std::vector<std::string>{"xt::a_turns"}; }));
  SeenNode b(board("b"));
  EXPECT_EQ(b.quality("xt::flow"), 0U) << "it is read from no board any more";
  const auto last = b.number("xt::flow");
  EXPECT_GT(last.value_or(0), 0U) << "and keeps its value";
  EXPECT_EQ(last.value_or(0), SeenNode(board("a")).number("xt::flow").value_or(0)) << "the last one that was written";
  const Outcome again = indurop({"rollback", "--health", "300ms", "-o", "json"});
  ASSERT_EQ(again.code, 0) << again.err;
  EXPECT_TRUE(flows());
  expect_untouched();
  expect_sound(judge, 1);
}

TEST_F(Flow, A_fault_in_the_trial_takes_the_routes_back_and_a_better_version_gets_them) {
  Judge judge(board("b"));
  bring("new", "throws");
  const Outcome done = deploy(plant(), {"--health", "20s"});
  EXPECT_EQ(done.code, 5) << done.err;
  EXPECT_TRUE(both_run(first_));
  EXPECT_TRUE(wait_until([] { return mirrored("b") == std::vector<std::string>{"xt::a_turns"}; }));
  EXPECT_EQ(SeenNode(board("b")).quality("xt::flow"), 0U);
  EXPECT_GT(SeenNode(board("b")).number("xt::flow").value_or(0), 0U) << "values of the trial stay";
  bring("new", "new");
  const Outcome better = deploy(plant());
  EXPECT_EQ(better.code, 0) << better.err;
  EXPECT_TRUE(flows());
  expect_untouched();
  expect_sound(judge, 1);
}

TEST_F(Flow, A_node_killed_in_the_trial_takes_the_routes_back) {
  bring("new", "new");
  Program& deployer = start_indurop({"deploy", plant(), "--health", "60s", "--timeout", "20s"});
  ASSERT_TRUE(flows());
  kill_node(board("a"));
  EXPECT_EQ(deployer.finish().code, 5) << deployer.err();
  EXPECT_TRUE(both_run(first_));
  EXPECT_EQ(vars::running_node(board("b")), pids_["b"]);
  EXPECT_TRUE(wait_until([] { return mirrored("b") == std::vector<std::string>{"xt::a_turns"}; }));
  const std::uint64_t then = SeenNode(board("a")).number("xt::a_turns").value_or(0);
  EXPECT_TRUE(wait_until([&] { return SeenNode(board("b")).number("xt::b_seen").value_or(0) > then; }))
      << "what was exchanged before is exchanged again";
  EXPECT_EQ(SeenNode(board("a")).find("xt::flow"), std::nullopt) << "the node has started with the first deployment";
  EXPECT_EQ(deploy(plant()).code, 0);
  EXPECT_TRUE(flows());
  EXPECT_EQ(vars::running_node(board("b")), pids_["b"]);
}

TEST_F(Flow, An_agent_killed_in_the_trial_takes_the_routes_back) {
  Judge judge(board("b"));
  bring("new", "new");
  Program& deployer = start_indurop({"deploy", plant(), "--health", "60s", "--timeout", "20s"});
  ASSERT_TRUE(flows());
  stop_agent("b", SIGKILL);
  EXPECT_EQ(deployer.finish().code, 5) << deployer.err();
  start_agent("b");
  EXPECT_TRUE(both_run(first_));
  EXPECT_TRUE(wait_until([] { return mirrored("b") == std::vector<std::string>{"xt::a_turns"}; }));
  expect_untouched();
  expect_sound(judge, 1);
}

TEST_F(Flow, Nodes_that_start_later_have_the_routes) {
  bring("new", "new");
  const Outcome done = deploy(plant());
  ASSERT_EQ(done.code, 0) << done.err;
  const std::string second = done.json()["deployment"];
  for (const char* name : {"b", "a", "b"}) {
    ASSERT_TRUE(flows());
    const pid_t before = vars::running_node(board(name));
    kill_node(board(name));
    ASSERT_TRUE(wait_until([&] {
      const pid_t now = vars::running_node(board(name));
      return now > 0 && now != before && runs(name, second);
    }));
  }
  EXPECT_TRUE(flows());
  EXPECT_EQ(mirrored("b").size(), 3U);
  EXPECT_LE(SeenNode(board("b")).number("xt::b_wrong").value_or(0), 1U) << "source has begun again once";
}

TEST_F(Flow, A_board_that_missed_the_deployment_takes_it_over_without_a_restart) {
  stop_agent("b", SIGKILL);
  bring("new", "new");
  const Outcome done = deploy(plant(), {"--allow-missing", "--timeout", "3s"});
  ASSERT_EQ(done.code, 0) << done.err;
  EXPECT_THAT(mirrored("b"), testing::ElementsAre("xt::a_turns"));
  Judge judge(board("b"));
  start_agent("b");
  EXPECT_TRUE(both_run(done.json()["deployment"])) << agent("b").err();
  EXPECT_TRUE(flows());
  expect_untouched();
  expect_sound(judge);
}

TEST_F(Flow, Added_modules_bring_variables_for_other_boards_too) {
  bring("first", "new");
  std::filesystem::copy_file(std::filesystem::path(FLOW_FOLDER) / "source_added.so", folder() / "added.so");
  const Outcome done = deploy(plant(module("source") + module("added", 2)));
  ASSERT_EQ(done.code, 0) << done.err << agent("a").err() << agent("b").err();
  EXPECT_TRUE(flows());
  expect_untouched();
  EXPECT_EQ(SeenNode(board("b")).number("xt::b_wrong").value_or(0), 0U);
  EXPECT_THAT(why(done.json(), board("a"), "added"), HasSubstr("xt::flow"));
  const Outcome back = indurop({"rollback", "--health", "300ms", "-o", "json"});
  ASSERT_EQ(back.code, 0) << back.err;
  EXPECT_TRUE(wait_until([] { return mirrored("b") == std::vector<std::string>{"xt::a_turns"}; }));
  expect_untouched();
}

TEST_F(Flow, A_variable_of_another_type_restarts_the_nodes_and_the_plan_says_why) {
  bring("new", "new");
  ASSERT_EQ(deploy(plant()).code, 0);
  ASSERT_TRUE(flows());
  bring("other", "other");
  const Outcome plan = deploy(plant(), {"--dry-run"});
  EXPECT_EQ(plan.code, 0) << plan.err;
  EXPECT_THAT(plan.out, HasSubstr("variable xt::flow has another layout in this node"));
  EXPECT_TRUE(flows()) << "nothing was changed";
  const std::string file = std::string(FLOW_FOLDER) + "/source_other.so";
  const Outcome alone = indurop({"reload", "source", file, "--board", board("a"), "--health", "0s"});
  EXPECT_EQ(alone.code, 4) << alone.err;
  EXPECT_THAT(alone.err, HasSubstr("xt::flow"));
  const Outcome done = deploy(plant());
  EXPECT_EQ(done.code, 0) << done.err;
  EXPECT_NE(vars::running_node(board("a")), pids_["a"]);
  EXPECT_TRUE(wait_until([] { return SeenNode(board("b")).number("xt::b_seen").value_or(0) > 0; }));
}

}  // namespace
}  // namespace indurop::test
