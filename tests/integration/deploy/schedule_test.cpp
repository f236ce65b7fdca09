// SPDX-License-Identifier: Apache-2.0
// A deployment changes the schedule of all boards in one tick, or of none; the nodes go on.

#include "schedule_fixture.h"

namespace indurop::test {
namespace {

class Rescheduled : public ScheduleTest {};

TEST_F(Rescheduled, Two_boards_take_over_in_one_tick_and_no_run_of_what_stays_is_lost) {
  start_with({press_of("a"), ticks_of("a")}, {press_of("b"), ticks_of("b")});
  const std::string next =
      plant_of({press_of("a", "30ms", "20ms"), ticks_of("a")}, {press_of("b", "20ms"), ticks_of("b", 1)});
  const Outcome plan = deploy(next, {"--dry-run"});
  EXPECT_EQ(plan.code, 0) << plan.err;
  EXPECT_EQ(planned(plan.json(), "a", "press"), "rescheduled") << plan.out;
  EXPECT_EQ(planned(plan.json(), "a", "ticks"), "kept");
  EXPECT_EQ(planned(plan.json(), "b", "press"), "rescheduled");
  EXPECT_THAT(plan.out, HasSubstr("period 10 ms -> 30 ms, offset 0 ns -> 20 ms"));
  EXPECT_EQ(seen("a").schedule, 1U) << "nothing was changed";
  const Outcome done = deploy(next);
  ASSERT_EQ(done.code, 0) << done.err << agent("a").err() << agent("b").err();
  const std::string second = done.json()["deployment"];
  expect_not_restarted();
  for (const char* name : {"a", "b"}) {
    EXPECT_EQ(seen(name).schedule, 2U);
    const Seen now = seen(name);
    EXPECT_LE(now.left_out, 2 * now.lost + now.overruns) << name;
    EXPECT_EQ(press(name).deployment, second);
    expect_as_said(name);
  }
  EXPECT_EQ(seen("a").first, seen("b").first) << "not in one tick";
  EXPECT_TRUE(both_run(second));

  // What a board resumes is the new schedule.
  kill_node(board("a"));
  EXPECT_TRUE(wait_until([&] { return vars::running_node(board("a")) > 0 && seen("a").periods["press"] > 0; }));
  EXPECT_TRUE(wait_until([&] { return runs("a", second); }));
  EXPECT_EQ(seen("a").periods["press"], 30'000'000);
}

// The same ticks, in the same order: a plant that is restarted has no other schedule.
TEST_F(Rescheduled, It_runs_as_a_plant_that_is_restarted_with_it) {
  start_with({press_of("a"), ticks_of("a")}, {press_of("b"), ticks_of("b")});
  const std::string next =
      plant_of({press_of("a", "30ms"), ticks_of("a")}, {press_of("b", "70ms", "40ms"), ticks_of("b", 1)});
  ASSERT_EQ(deploy(next).code, 0);
  expect_not_restarted();
  expect_as_said("a");
  expect_as_said("b");
  const Outcome again = deploy(next, {"--restart", "-m", "the same, restarted"});
  ASSERT_EQ(again.code, 0) << again.err;
  EXPECT_NE(vars::running_node(board("a")), pids_["a"]);
  for (const char* name : {"a", "b"}) {
    EXPECT_EQ(seen(name).schedule, 1U);
    expect_as_said(name);
  }
}

TEST_F(Rescheduled, Modules_are_added_and_ended_and_come_back_by_a_rollback) {
  start_with({press_of("a"), ticks_of("a")}, {press_of("b"), ticks_of("b")});
  const Outcome done = deploy(
      plant_of({press_of("a", "20ms"), {"count", "ticks_a", "40ms", "0ms", 2, ""}}, {press_of("b"), ticks_of("b")}));
  ASSERT_EQ(done.code, 0) << done.err << agent("a").err();
  EXPECT_EQ(planned(done.json(), "a", "ticks"), "ended") << done.out;
  EXPECT_EQ(planned(done.json(), "a", "count"), "added");
  EXPECT_EQ(planned(done.json(), "b", "press"), "kept");
  expect_not_restarted();
  expect_as_said("a");
  EXPECT_EQ(seen("a").ended, std::set<std::string>{"ticks"});
  EXPECT_EQ(seen("b").schedule, 1U) << "nothing of it differs";
  EXPECT_EQ(done.json()["deployment"], press("b").deployment);

  const Outcome back = indurop({"rollback", "--health", "300ms", "-o", "json"});
  EXPECT_EQ(back.code, 0) << back.err << agent("a").err();
  EXPECT_EQ(planned(back.json(), "a", "ticks"), "added") << back.out;
  EXPECT_EQ(planned(back.json(), "a", "count"), "ended");
  EXPECT_EQ(planned(back.json(), "a", "press"), "rescheduled");
  expect_not_restarted();
  EXPECT_EQ(seen("a").ended, std::set<std::string>{"count"});
  EXPECT_EQ(seen("a").periods["press"], 10'000'000);
  EXPECT_TRUE(both_run(first_));
}

// A process waits for the tick of all boards; what runs in the background begins after it.
TEST_F(Rescheduled, Processes_are_added_and_go_with_a_rollback) {
  start_with({press_of("a"), ticks_of("a")}, {press_of("b"), ticks_of("b")});
  std::filesystem::copy_file(PROCESS_FILE, folder() / "helper.exe");
  std::ofstream(folder() / "nap.sh") << "#!/bin/sh\nexec sleep 1000\n";
  ::chmod(path("nap.sh").c_str(), 0755);
  const std::string next = plant_of({press_of("a", "20ms"), ticks_of("a")}, {press_of("b"), ticks_of("b")});
  text_.insert(text_.find("</board>"),
               "<module><filename>./helper.exe</filename><moduletype>process</moduletype><operationtype>periodic"
               "</operationtype><period>10ms</period><priority>3</priority></module>"
               "<module><filename>./nap.sh</filename><moduletype>process</moduletype><operationtype>non-real"
               "</operationtype></module>\n");
  std::ofstream(next) << text_;
  const Outcome done = deploy(next);
  ASSERT_EQ(done.code, 0) << done.err << agent("a").err();
  EXPECT_EQ(planned(done.json(), "a", "helper"), "added") << done.out;
  EXPECT_EQ(planned(done.json(), "a", "nap"), "added");
  expect_not_restarted();
  const auto runs_helper = [&] {
    const auto ran = seen("a").ran;
    return std::any_of(ran.begin(), ran.end(), [](const auto& one) {
      return std::find(one.second.begin(), one.second.end(), "helper") != one.second.end();
    });
  };
  EXPECT_TRUE(wait_until(runs_helper));

  const Outcome back = indurop({"rollback", "--health", "300ms", "-o", "json"});
  EXPECT_EQ(back.code, 0) << back.err << agent("a").err();
  EXPECT_EQ(planned(back.json(), "a", "helper"), "ended") << back.out;
  EXPECT_TRUE(wait_until([&] { return seen("a").ended == std::set<std::string>{"helper", "nap"}; }));
  EXPECT_FALSE(runs_helper());
  expect_not_restarted();
  EXPECT_TRUE(both_run(first_));
}

// Its policy is that of the deployment that was taken back.
TEST_F(Rescheduled, A_process_whose_end_stops_the_node_in_the_trial_leaves_no_board_stopped) {
  start_with({press_of("a"), ticks_of("a")}, {press_of("b"), ticks_of("b")});
  std::ofstream(folder() / "broken.sh") << "#!/bin/sh\nexit 3\n";
  ::chmod(path("broken.sh").c_str(), 0755);
  const std::string next = plant_of({press_of("a"), ticks_of("a")}, {press_of("b"), ticks_of("b")});
  text_.insert(text_.find("</board>"),
               "<module><filename>./broken.sh</filename><moduletype>process</moduletype><operationtype>non-real"
               "</operationtype><restart max=\"0\" escalate=\"stop-node\"/></module>\n");
  std::ofstream(next) << text_;
  const Outcome done = deploy(next, {"--health", "1s"});
  EXPECT_EQ(done.code, 5) << done.err << agent("a").err();
  EXPECT_TRUE(both_run(first_)) << agent("a").err();
  EXPECT_EQ(vars::running_node(board("b")), pids_["b"]);
}

TEST_F(Rescheduled, Files_and_schedule_change_in_one_tick) {
  start_with({press_of("a"), ticks_of("a")}, {press_of("b"), ticks_of("b")});
  bring("a", "press_a_second");
  bring("b", "press_b_second");
  const std::int64_t turns = number("a", "turns");
  const Outcome done = deploy(plant_of({press_of("a", "20ms"), ticks_of("a")}, {press_of("b", "20ms"), ticks_of("b")}));
  ASSERT_EQ(done.code, 0) << done.err << agent("a").err() << agent("b").err();
  EXPECT_EQ(planned(done.json(), "a", "press"), "exchanged with state") << done.out;
  EXPECT_THAT(done.out, HasSubstr("bytes; period 10 ms -> 20 ms"));
  expect_not_restarted();
  EXPECT_TRUE(shows("a", -1));
  EXPECT_TRUE(shows("b", -1));
  EXPECT_GE(number("a", "turns"), turns) << "it continues with what it kept";
  for (const char* name : {"a", "b"}) {
    EXPECT_EQ(press(name).version, 2U);
    expect_as_said(name);
  }
  EXPECT_EQ(done.json()["plan"][0]["tick"], done.json()["plan"][0]["schedule_tick"]);
  EXPECT_EQ(seen("a").first, seen("b").first);

  const Outcome back = indurop({"reload", "--back", "--plant", "p" + std::to_string(::getpid()), "--health", "300ms"});
  EXPECT_EQ(back.code, 0) << back.err;
  EXPECT_TRUE(shows("a", 1));
  EXPECT_EQ(seen("b").periods["press"], 10'000'000);
  EXPECT_TRUE(both_run(first_));
  expect_not_restarted();
}

TEST_F(Rescheduled, What_boards_send_each_other_goes_on_and_is_not_changed_without_a_restart) {
  const Part watch{"watch", "ticks_a", "10ms", "0ms", 3, ""};  // reads what the press of board a writes
  start_with({press_of("a")}, {press_of("b"), ticks_of("b"), watch});
  ASSERT_TRUE(wait_until([&] { return value("b", "a_turns") > 0; }));
  const Outcome done = deploy(plant_of({press_of("a", "20ms")}, {press_of("b", "20ms"), ticks_of("b"), watch}));
  ASSERT_EQ(done.code, 0) << done.err;
  expect_not_restarted();
  for (int i = 0; i < 3; ++i) {
    const std::int64_t turns = value("b", "a_turns");
    EXPECT_TRUE(wait_until([&] { return value("b", "a_turns") > turns; }));
  }
  add_file("later", "press_a_second");
  const Outcome fewer = deploy(plant_of({press_of("a", "20ms")}, {press_of("b"), ticks_of("b")}), {"--dry-run"});
  EXPECT_NE(planned(fewer.json(), "a", "press"), "restarted") << "a variable may have no reader any more" << fewer.out;
  const Outcome writer = deploy(
      plant_of({{"later", "later", "10ms", "0ms", 1, ""}}, {press_of("b"), ticks_of("b"), watch}), {"--dry-run"});
  EXPECT_THAT(writer.out, HasSubstr("module later is added and writes variable xt::a_turns"));
  EXPECT_EQ(vars::running_node(board("a")), pids_["a"]);
}

TEST_F(Rescheduled, A_schedule_that_cannot_be_met_is_refused_and_nothing_changes) {
  start_with({press_of("a"), ticks_of("a")}, {press_of("b"), ticks_of("b")});
  Part slow = press_of("b", "20ms");
  slow.more = "<wcet>25ms</wcet>";
  const Outcome done = deploy(plant_of({press_of("a", "20ms"), ticks_of("a")}, {slow, ticks_of("b")}));
  EXPECT_EQ(done.code, 4) << done.out << done.err;
  EXPECT_THAT(done.err, HasSubstr("plant.xml:"));
  EXPECT_EQ(seen("a").schedule, 1U);
  EXPECT_TRUE(both_run(first_));
}

TEST_F(Rescheduled, An_added_module_that_cannot_start_is_refused_and_nothing_changes) {
  start_with({press_of("a"), ticks_of("a")}, {press_of("b"), ticks_of("b")}, "cpp_first");
  add_file("bad", "cpp_bad_start");
  const Outcome done = deploy(plant_of({press_of("a", "20ms"), ticks_of("a")}, {{"bad", "bad"}, ticks_of("b")}));
  EXPECT_EQ(done.code, 4) << done.out << done.err;
  EXPECT_EQ(planned(done.json(), "b", "bad"), "refused") << done.out;
  EXPECT_THAT(done.err, HasSubstr("no oil"));
  for (const char* name : {"a", "b"}) {
    EXPECT_EQ(seen(name).schedule, 1U);
    expect_untouched(name);
  }
  EXPECT_TRUE(both_run(first_));
}

TEST_F(Rescheduled, A_fault_of_an_added_module_brings_the_former_schedule_back_on_all_boards) {
  start_with({press_of("a"), ticks_of("a")}, {press_of("b"), ticks_of("b")}, "cpp_first");
  add_file("bad", "cpp_throws");
  const Outcome done =
      deploy(plant_of({press_of("a", "20ms"), ticks_of("a")}, {{"bad", "bad"}, ticks_of("b")}), {"--health", "20s"});
  EXPECT_EQ(done.code, 5) << done.out << done.err;
  EXPECT_THAT(done.err, HasSubstr(board("b") + ": module bad"));
  EXPECT_TRUE(both_run(first_)) << agent("a").err() << agent("b").err();
  expect_not_restarted();
  EXPECT_EQ(seen("a").periods["press"], 10'000'000);
  EXPECT_EQ(seen("b").ended, std::set<std::string>{"bad"});
  EXPECT_TRUE(wait_until([&] { return number("b", "shown") > 0; }));
}

// A module of it is always in a run when the tick comes.
TEST_F(Rescheduled, A_board_that_misses_the_tick_is_named_and_all_keep_the_former_schedule) {
  Part busy = press_of("b", "20ms");
  busy.more = "<overrun>catch-up</overrun>";
  start_with({press_of("a"), ticks_of("a")}, {busy, ticks_of("b")}, "cpp_long");
  const Outcome done =
      deploy(plant_of({press_of("a", "20ms"), ticks_of("a")}, {busy, ticks_of("b", 3)}), {"--health", "20s"});
  EXPECT_EQ(done.code, 5) << done.out << done.err;
  EXPECT_THAT(done.err, HasSubstr(board("b") + ": it missed the tick of the change"));
  EXPECT_TRUE(both_run(first_)) << agent("a").err() << agent("b").err();
  expect_not_restarted();
  EXPECT_EQ(seen("a").periods["press"], 10'000'000);
  EXPECT_EQ(seen("b").schedule, 1U);
}

}  // namespace
}  // namespace indurop::test
