// SPDX-License-Identifier: Apache-2.0
// indurop reload --config: another schedule takes over while the node runs.

#include <csignal>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "other_schedule_fixture.h"
#include "scheduler/module_command.h"

namespace indurop::test {
namespace {

using scheduler::ModuleState;

TEST_F(OtherSchedule, Modules_that_stay_lose_no_tick_and_the_others_have_new_periods) {
  Program& sut = start_and_wait({kCounter, kWalker});
  ASSERT_TRUE(runs_reach("walker", 20));
  const Outcome done = change({kCounter, {.file = "walker.so", .name = "walker", .period = "4ms", .priority = 5}});
  EXPECT_EQ(done.code, 0) << done.out << done.err;
  EXPECT_CONTAINS(done.out, "kept        counter\n");
  EXPECT_CONTAINS(done.out, "rescheduled walker: period 2 ms -> 4 ms, priority 2 -> 5");
  EXPECT_CONTAINS(done.err, "schedule: took over, modules: 1 kept, 1 rescheduled");
  EXPECT_CONTAINS(done.out, "schedule 2 counts since tick ");
  EXPECT_EQ(run()->macro_period_ns.load(), 4'000'000);
  EXPECT_EQ(module("walker").period_ns.load(), 4'000'000);
  EXPECT_TRUE(goes_on("walker"));
  const std::uint64_t since = run()->schedule_tick.load();
  EXPECT_EQ(since % 2, 0U) << "not the begin of a macro period";
  std::uint64_t seen = 0;
  for (const Started& one : slot_log(*run())) {
    if (one.module == 1 && one.tick >= since) {
      EXPECT_EQ(one.tick % 4, 0U);
      ++seen;
    }
  }
  EXPECT_GT(seen, 5U);
  expect_no_tick_of_counter_is_lost();
  EXPECT_CONTAINS(indurop({"status", "--node", node()}).out, "schedule 2 since tick");
  EXPECT_EQ(indurop({"status", "--node", node(), "-o", "json"}).json()["schedule"], 2);
  sut.signal(SIGTERM);
  EXPECT_EQ(sut.wait(), 0) << sut.err();
  EXPECT_CONTAINS(sut.err(), "schedule 2 (next.xml) counts since tick");
}

TEST_F(OtherSchedule, Back_returns_to_the_schedule_before) {
  start_and_wait({kCounter, kWalker});
  ASSERT_TRUE(runs_reach("walker", 20));
  EXPECT_EQ(indurop({"reload", "--back", "--node", node()}).code, 4) << "there was no other one";
  ASSERT_EQ(change({kCounter, every(kWalker, "5ms")}).code, 0);
  const Outcome back = indurop({"reload", "--back", "--node", node()});
  EXPECT_EQ(back.code, 0) << back.out << back.err;
  EXPECT_CONTAINS(back.out, "rescheduled walker: period 5 ms -> 2 ms");
  EXPECT_EQ(run()->schedule.load(), 3U);
  EXPECT_EQ(module("walker").period_ns.load(), 2'000'000);
  EXPECT_TRUE(goes_on("walker"));
  expect_no_tick_of_counter_is_lost();
}

TEST_F(OtherSchedule, A_dry_run_says_what_would_be_and_changes_nothing) {
  start_and_wait({kCounter, kWalker});
  ASSERT_TRUE(runs_reach("walker", 20));
  const Outcome said = change({kCounter, kAdder}, {"--dry-run", "-o", "json"});
  EXPECT_EQ(said.code, 0) << said.out << said.err;
  const auto json = said.json();
  EXPECT_EQ(json["modules"][0]["fate"], "kept");
  EXPECT_EQ(json["modules"][1]["fate"], "added");
  EXPECT_EQ(json["modules"][2]["fate"], "ended");
  EXPECT_EQ(run()->schedule.load(), 1U);
  EXPECT_TRUE(goes_on("walker"));
}

TEST_F(OtherSchedule, What_cannot_be_is_refused_with_its_place_and_nothing_changes) {
  start_and_wait({kCounter, kWalker});
  ASSERT_TRUE(runs_reach("walker", 20));
  struct Case {
    std::vector<Module> modules;
    std::string text;
  };
  const std::vector<Case> cases = {
      {{kCounter, {.file = "walker.so", .name = "walker", .period = "2ms", .priority = 2, .more = "<wcet>3ms</wcet>"}},
       "walker executes for 3 ms and has only 2 ms"},
      {{kCounter, every(kWalker, "2us")}, "next.xml:"},
      {{kCounter, {.file = "absent.so", .name = "absent", .priority = 2}}, "no such file"},
      {{kCounter, every(kWalker, "1500us")}, "its basic period is 500 us, and the node ticks every 1 ms"},
      {{kCounter,
        {.file = "walker.so", .name = "walker", .period = "2ms", .priority = 2, .properties = {{"label", "w"}}}},
       "module walker differs in <property>"},
      {{kCounter, {.file = MODULE_DIR "/new/walker.so", .name = "walker", .period = "2ms", .priority = 2}},
       "module walker runs another version than"},
      {{kCounter, kWalker, {.file = "reload_offers.so", .name = "offers", .priority = 4}}, "shared functions"},
      {{kCounter, kWalker, {.file = "layout_new.so", .name = "layout", .priority = 4}}, "is not one of this node"}};
  for (const Case& one : cases) {
    const Outcome done = change(one.modules);
    EXPECT_EQ(done.code, 4) << done.out << done.err;
    EXPECT_CONTAINS(done.out + done.err, one.text);
  }
  EXPECT_EQ(run()->schedule.load(), 1U);
  EXPECT_EQ(run()->module_count, 2U);
  EXPECT_TRUE(goes_on("walker"));
  expect_no_tick_of_counter_is_lost();
}

TEST_F(OtherSchedule, A_module_that_ends_is_stopped_and_can_come_back) {
  Program& sut = start_and_wait({kCounter, {.file = "faulty.so", .name = "second", .priority = 2}});
  ASSERT_TRUE(runs_reach("second", 20));
  const Outcome done = change({kCounter});
  EXPECT_EQ(done.code, 0) << done.out << done.err;
  EXPECT_CONTAINS(done.out, "ended       second");
  EXPECT_TRUE(wait_until([&] { return module("second").state.load() == ModuleState::Stopped; }));
  EXPECT_TRUE(sut.prints("stop called"));
  const std::uint64_t runs = module("second").runs.load();
  EXPECT_TRUE(goes_on("counter"));
  EXPECT_EQ(module("second").runs.load(), runs);
  EXPECT_EQ(indurop({"start", "second", "--node", node()}).code, 1) << "no schedule has it";
  EXPECT_CONTAINS(indurop({"status", "--node", node()}).out, "ended");
  const Outcome back = indurop({"reload", "--back", "--node", node()});
  EXPECT_EQ(back.code, 0) << back.out << back.err;
  EXPECT_CONTAINS(back.out, "added       second");
  EXPECT_TRUE(goes_on("second"));
  EXPECT_EQ(module("second").state.load(), ModuleState::Running);
  expect_no_tick_of_counter_is_lost();
}

// Its record takes the commands that are meant for the whole node, too.
TEST_F(OtherSchedule, The_first_module_ends_while_it_is_stopped_and_the_answer_to_the_change_stays) {
  Program& sut = start_and_wait({kCounter, kWalker});
  ASSERT_EQ(indurop({"stop", "counter", "--node", node()}).code, 0);
  const Outcome done = change({kWalker});
  EXPECT_EQ(done.code, 0) << done.out << done.err;
  EXPECT_TRUE(sut.says("module counter: ended"));
  scheduler::CommandTicket last = 0;
  while (scheduler::result_of(run()->modules()[0], last + 1) != scheduler::CommandResult::None) {
    ++last;
  }
  EXPECT_EQ(scheduler::result_of(run()->modules()[0], last), scheduler::CommandResult::Done);
}

TEST_F(OtherSchedule, A_module_is_added_and_runs_from_the_first_tick_on) {
  start_and_wait({kCounter, kWalker});
  ASSERT_TRUE(runs_reach("walker", 20));
  const Module late{.file = "adder.so", .name = "third", .period = "3ms", .priority = 3};
  const Outcome done = change({kCounter, kWalker, late});
  EXPECT_EQ(done.code, 0) << done.out << done.err;
  EXPECT_CONTAINS(done.out, "added       third");
  ASSERT_EQ(run()->module_count, 3U);
  EXPECT_TRUE(goes_on("third"));
  EXPECT_EQ(module("third").faults.load(), 0U);
  for (const Started& one : slot_log(*run())) {
    EXPECT_TRUE(one.module != 2 || one.tick % 3 == 0) << one.tick;
  }
  EXPECT_EQ(indurop({"stop", "third", "--node", node()}).code, 0);
  EXPECT_EQ(indurop({"start", "third", "--node", node()}).code, 0);
  EXPECT_TRUE(goes_on("third"));
  ASSERT_EQ(indurop({"reload", "--back", "--node", node()}).code, 0);
  EXPECT_TRUE(wait_until([&] { return module("third").state.load() == ModuleState::Stopped; }));
  expect_no_tick_of_counter_is_lost();
}

TEST_F(OtherSchedule, A_new_module_that_throws_in_start_changes_nothing) {
  Program& sut = start_and_wait({kCounter, kWalker});
  ASSERT_TRUE(runs_reach("walker", 20));
  const Module bad{
      .file = "faulty.so", .name = "bad", .priority = 3, .properties = {{"fault", "throw"}, {"at", "start"}}};
  const Outcome done = change({kCounter, every(kWalker, "4ms"), bad});
  EXPECT_EQ(done.code, 1) << done.out << done.err;
  EXPECT_CONTAINS(done.err, "module bad: start() failed: exception: out of ink");
  EXPECT_EQ(run()->schedule.load(), 1U);
  EXPECT_EQ(module("walker").period_ns.load(), 2'000'000);
  EXPECT_TRUE(goes_on("walker"));
  // The same name, mended.
  const Outcome again = change({kCounter, kWalker, {.file = "faulty.so", .name = "bad", .priority = 3}});
  EXPECT_EQ(again.code, 4) << "its properties are those that were read: " << again.err;
  expect_no_tick_of_counter_is_lost();
  sut.signal(SIGTERM);
  EXPECT_EQ(sut.wait(), 0) << sut.err();
}

TEST_F(OtherSchedule, A_node_that_is_killed_meanwhile_starts_with_its_configuration) {
  const std::string file = write("module.xml", xml({kCounter, kWalker}));
  Program& first = start_file(file);
  ASSERT_TRUE(wait_until_running(first));
  Program client(adds_slowly(), environment());
  EXPECT_TRUE(wait_until([&] { return run()->module_count == 3U; }));
  first.signal(SIGKILL);
  (void)first.wait();
  EXPECT_EQ(client.wait(), 6) << client.err();
  Program& second = start_file(file);
  ASSERT_TRUE(wait_until_running(second));
  EXPECT_EQ(run()->schedule.load(), 1U);
  EXPECT_EQ(run()->module_count, 2U);
  EXPECT_TRUE(goes_on("walker"));
}

TEST_F(OtherSchedule, A_client_that_is_killed_does_not_stop_the_change) {
  start_and_wait({kCounter, kWalker});
  ASSERT_TRUE(runs_reach("walker", 20));
  Program client(adds_slowly(), environment());
  EXPECT_TRUE(wait_until([&] { return run()->module_count == 3U; }));
  client.signal(SIGKILL);
  (void)client.wait();
  EXPECT_TRUE(wait_until([&] { return run()->schedule.load() == 2U; }));
  EXPECT_TRUE(goes_on("slow"));
  expect_no_tick_of_counter_is_lost();
}

TEST_F(OtherSchedule, A_recording_of_it_is_replayed_bit_by_bit_and_names_the_tick) {
  const std::string file = folder() / "run.mcap";
  Program& sut = start({kCounter, kWalker}, {"--record", file});
  ASSERT_TRUE(wait_until_running(sut));
  ASSERT_TRUE(runs_reach("walker", 20));
  ASSERT_EQ(change({kCounter, every(kWalker, "5ms")}).code, 0);
  ASSERT_TRUE(goes_on("walker"));
  const std::uint64_t tick = run()->schedule_tick.load();
  sut.signal(SIGTERM);
  EXPECT_EQ(sut.wait(), 0);
  const Outcome again = indurop({"replay", file, "--node", node() + "-r"});
  EXPECT_EQ(again.code, 0) << again.out << again.err;
  EXPECT_CONTAINS(again.out, " values: equal");
  EXPECT_CONTAINS(again.err, "schedule 2 took over in tick " + std::to_string(tick));
}

}  // namespace
}  // namespace indurop::test
