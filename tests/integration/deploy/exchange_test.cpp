// SPDX-License-Identifier: Apache-2.0
// A deployment exchanges the modules that differ on all boards in one tick, or nothing; the nodes go on.

#include "exchange_fixture.h"

namespace indurop::test {
namespace {

class Exchange : public ExchangeTest {};

TEST_F(Exchange, PLC_programs_of_two_boards_are_exchanged_in_one_tick_with_what_they_keep) {
  start_plant();
  bring("a", "press_a_second");
  bring("b", "press_b_second");
  const Outcome plan = deploy(plant(), {"--dry-run"});
  EXPECT_EQ(plan.code, 0) << plan.err;
  EXPECT_EQ(plan.json()["result"], "compared");
  for (const char* name : {"a", "b"}) {
    EXPECT_EQ(planned(plan.json(), name, "press"), "exchanged with state") << plan.out;
    EXPECT_EQ(planned(plan.json(), name, "ticks"), "kept");
    EXPECT_EQ(press(name).version, 1U) << "nothing was changed";
  }
  const Outcome done = deploy(plant());
  ASSERT_EQ(done.code, 0) << done.err << agent("a").err() << agent("b").err();
  const std::string second = done.json()["deployment"];
  for (const char* name : {"a", "b"}) {
    EXPECT_EQ(planned(done.json(), name, "press"), "exchanged with state");
    EXPECT_TRUE(shows(name, -1));
    EXPECT_EQ(press(name).version, 2U);
    EXPECT_EQ(press(name).deployment, second);
    expect_untouched(name);
  }
  EXPECT_LT(std::abs(press("a").since_ns - press("b").since_ns), press("a").period_ns / 2) << "not in one tick";
  EXPECT_TRUE(both_run(second));

  // What a board resumes is the new deployment.
  kill_node(board("a"));
  EXPECT_TRUE(wait_until([&] { return vars::running_node(board("a")) > 0 && press("a").version == 1; }));
  EXPECT_TRUE(shows("a", -1));
  EXPECT_TRUE(wait_until([&] { return runs("a", second); }));
  EXPECT_EQ(press("a").deployment, second);
}

TEST_F(Exchange, A_rollback_goes_back_on_all_boards_with_what_the_new_versions_kept) {
  start_plant();
  bring("a", "press_a_second");
  bring("b", "press_b_second");
  ASSERT_EQ(deploy(plant()).code, 0);
  const std::int64_t before = number("a", "turns");
  const Outcome back = indurop({"rollback", "--health", "300ms", "-o", "json"});
  EXPECT_EQ(back.code, 0) << back.err;
  EXPECT_EQ(back.json()["deployment"], first_);
  for (const char* name : {"a", "b"}) {
    EXPECT_EQ(planned(back.json(), name, "press"), "exchanged with state");
    EXPECT_TRUE(shows(name, 1));
    expect_untouched(name);
  }
  EXPECT_GT(number("a", "turns"), before);
  const std::string plant_name = "p" + std::to_string(::getpid());
  EXPECT_EQ(indurop({"reload", "--back", "--plant", plant_name, "--health", "300ms"}).code, 0) << "forward again";
  EXPECT_TRUE(shows("a", -1));
  EXPECT_TRUE(shows("b", -1));
  EXPECT_EQ(indurop({"reload", "press", "--back", "--plant", plant_name}).code, 2);
  EXPECT_EQ(indurop({"reload"}).code, 2);
  expect_untouched("b");
  EXPECT_LT(std::abs(press("a").since_ns - press("b").since_ns), press("a").period_ns / 2) << "not in one tick";
}

TEST_F(Exchange, A_process_is_exchanged_with_what_it_keeps_and_goes_back) {
  press_b_is_process_ = true;
  start_plant("process_first");
  bring("a", "press_a_second");
  bring("b", "process_second");
  EXPECT_EQ(planned(deploy(plant(), {"--dry-run"}).json(), "b", "press"), "exchanged");
  const std::int64_t before = number("b", "turns");
  const Outcome done = deploy(plant());
  ASSERT_EQ(done.code, 0) << done.err << agent("b").err();
  EXPECT_EQ(planned(done.json(), "a", "press"), "exchanged with state");
  EXPECT_EQ(planned(done.json(), "b", "press"), "exchanged with state") << done.out;
  EXPECT_LT(std::abs(press("a").since_ns - press("b").since_ns), press("a").period_ns / 2) << "not in one tick";
  EXPECT_TRUE(shows("b", -1));
  EXPECT_GT(number("b", "turns"), before);
  EXPECT_TRUE(both_run(done.json()["deployment"]));
  expect_untouched("a");
  expect_untouched("b");
  const std::int64_t since = number("b", "turns");
  EXPECT_EQ(indurop({"rollback", "--health", "300ms"}).code, 0);
  EXPECT_TRUE(shows("b", 1));
  EXPECT_GT(number("b", "turns"), since);
  EXPECT_TRUE(both_run(first_));
  expect_untouched("a");
  expect_untouched("b");
}

TEST_F(Exchange, Only_the_board_whose_file_differs_exchanges_it_and_both_commit) {
  start_plant();
  bring("b", "press_b_second");
  const Outcome done = deploy(plant());
  ASSERT_EQ(done.code, 0) << done.err;
  EXPECT_EQ(planned(done.json(), "a", "press"), "kept");
  EXPECT_EQ(press("a").version, 1U);
  EXPECT_EQ(press("b").version, 2U);
  EXPECT_EQ(done.json()["deployment"], press("a").deployment);
  EXPECT_TRUE(both_run(done.json()["deployment"]));
  expect_untouched("a");
  expect_untouched("b");
}

TEST_F(Exchange, A_fault_of_one_new_version_takes_all_boards_back) {
  start_plant("cpp_first");
  bring("a", "press_a_second");
  bring("b", "cpp_throws");
  const Outcome done = deploy(plant(), {"--health", "20s"});
  EXPECT_EQ(done.code, 5) << done.err;
  EXPECT_THAT(done.err, HasSubstr(board("b") + ": module press"));
  EXPECT_THAT(done.err, HasSubstr("out of oil"));
  EXPECT_TRUE(shows("a", 1));
  EXPECT_TRUE(shows("b", 1));
  EXPECT_TRUE(both_run(first_));
  expect_untouched("a");
  EXPECT_EQ(vars::running_node(board("b")), pids_["b"]);
  EXPECT_EQ(press("b").faults, 1U);
  EXPECT_EQ(press("b").deployment, first_);
  EXPECT_LE(number("b", "gaps"), 1) << "only the run that threw";
  EXPECT_EQ(deploy(plant(), {"--health", "20s"}).code, 5) << "and again";
}

TEST_F(Exchange, A_version_that_cannot_start_is_refused_and_nothing_is_exchanged) {
  start_plant("cpp_first");
  bring("a", "press_a_second");
  bring("b", "cpp_bad_start");
  const Outcome done = deploy(plant());
  EXPECT_EQ(done.code, 4) << done.err;
  EXPECT_THAT(done.err, HasSubstr("no oil"));
  EXPECT_EQ(planned(done.json(), "b", "press"), "refused") << done.out;
  EXPECT_TRUE(both_run(first_));
  for (const char* name : {"a", "b"}) {
    EXPECT_EQ(press(name).version, 1U);
    expect_untouched(name);
  }
}

TEST_F(Exchange, What_cannot_be_exchanged_restarts_the_nodes_and_the_plan_says_why) {
  start_plant();
  bring("a", "press_a_second");
  const std::string other = plant("10ms", "<core>0</core>");
  const Outcome plan = deploy(other, {"--dry-run"});
  EXPECT_EQ(plan.code, 0) << plan.err;
  EXPECT_EQ(planned(plan.json(), "a", "press"), "restarted");
  EXPECT_EQ(planned(plan.json(), "b", "ticks"), "restarted");
  EXPECT_THAT(plan.json()["plan"][0]["restart"].get<std::string>(),
              HasSubstr("board " + board("a") + ", module press: <core> is new"));
  EXPECT_EQ(vars::running_node(board("a")), pids_["a"]);
  const Outcome done = deploy(other);
  EXPECT_EQ(done.code, 0) << done.err;
  EXPECT_NE(vars::running_node(board("a")), pids_["a"]);
  EXPECT_NE(vars::running_node(board("b")), pids_["b"]);
  EXPECT_TRUE(both_run(done.json()["deployment"]));
}

TEST_F(Exchange, A_version_that_uses_other_variables_restarts_the_nodes_and_the_plan_says_why) {
  start_plant("cpp_first");
  bring("b", "cpp_reads_more");
  const Outcome plan = deploy(plant(), {"--dry-run"});
  EXPECT_EQ(plan.code, 0) << plan.err;
  EXPECT_EQ(planned(plan.json(), "a", "ticks"), "restarted");
  EXPECT_THAT(plan.out, HasSubstr("it reads variable xt::b_ticks"));
  const Outcome done = deploy(plant());
  EXPECT_EQ(done.code, 0) << done.err;
  EXPECT_NE(vars::running_node(board("a")), pids_["a"]);
  EXPECT_TRUE(both_run(done.json()["deployment"]));
}

TEST_F(Exchange, By_request_the_nodes_are_restarted) {
  start_plant();
  bring("a", "press_a_second");
  const Outcome done = deploy(plant(), {"--restart"});
  EXPECT_EQ(done.code, 0) << done.err;
  EXPECT_NE(vars::running_node(board("a")), pids_["a"]);
  EXPECT_NE(vars::running_node(board("b")), pids_["b"]);
  EXPECT_TRUE(shows("a", -1));
  EXPECT_EQ(deploy(plant(), {"--restart", "--dry-run"}).code, 2);
}

TEST_F(Exchange, What_was_exchanged_by_hand_becomes_what_was_deployed) {
  start_plant();
  const std::string file = std::string(EXCHANGED_FOLDER) + "/press_a_second.so";
  ASSERT_EQ(indurop({"reload", "press", file, "--board", board("a"), "--health", "0s"}).code, 0);
  EXPECT_EQ(press("a").version, 2U);
  Outcome done = deploy(plant(), {"-m", "the same files again"});
  EXPECT_EQ(done.code, 0) << done.err;
  EXPECT_EQ(planned(done.json(), "a", "press"), "exchanged with state") << "the deployment has the first one";
  EXPECT_TRUE(shows("a", 1));
  ASSERT_EQ(indurop({"reload", "press", file, "--board", board("a"), "--health", "0s"}).code, 0);
  bring("a", "press_a_second");
  done = deploy(plant());
  EXPECT_EQ(done.code, 0) << done.err;
  EXPECT_EQ(planned(done.json(), "a", "press"), "kept") << "it runs already";
  EXPECT_TRUE(both_run(done.json()["deployment"]));
  expect_untouched("a");
}

}  // namespace
}  // namespace indurop::test
