// SPDX-License-Identifier: Apache-2.0
#include "history/explain/questions.h"

#include <gmock/gmock.h>

#include <array>
#include <random>

#include "history/explain/facts_json.h"
#include "history/explain/run_facts.h"

namespace indurop::explain {
namespace {

using testing::HasSubstr;
using testing::Not;

constexpr std::int64_t kMs = 1'000'000;

ModuleFact periodic(const char* name, std::int64_t period_ns) {
  ModuleFact module;
  module.name = name;
  module.type = "thread";
  module.operation = "periodic";
  module.period_ns = period_ns;
  return module;
}

// Writes x in every tick up to `last`; y comes from board other.
Facts board(const char* name, std::uint64_t last) {
  Facts facts;
  facts.node = facts.board = name;
  facts.is_virtual = true;
  facts.basic_period_ns = kMs;
  facts.lease_ns = 500 * kMs;
  facts.tick = last + 1;
  facts.now_ns = static_cast<std::int64_t>(last + 1) * kMs;
  facts.modules.push_back(periodic("writer", kMs));
  for (std::uint64_t tick = 0; tick <= last; ++tick) {
    const auto release = static_cast<std::int64_t>(tick) * kMs;
    facts.runs.push_back({0, tick, release, release, release + 1000, false});
  }
  facts.variables.push_back({"x", {std::string("writer@") + name}, {}, 0, 0});
  return facts;
}

Facts reader(const char* state, std::int64_t heard_ns) {
  Facts facts = board("here", 3000);
  facts.alive = true;
  facts.boards.push_back({"other", state, {}, heard_ns, 0, 0});
  facts.variables.push_back({"y", {"writer@other"}, "other", 0, 0});
  return facts;
}

TEST(Explain, For_a_module_that_is_not_due_its_next_release_is_reported) {
  Facts facts = board("here", 100);
  facts.modules.push_back(periodic("slow", 10 * kMs));
  const Answer sut = why_late(facts, "slow", 42);
  EXPECT_EQ(sut.cause, Cause::NotDue);
  EXPECT_THAT(sut.text, HasSubstr("next in tick 50"));
}

// By schedules whose changes are known: in every run, in every third and so on, with runs that take time and that do
// not.
TEST(Explain, A_value_that_changes_in_each_run_is_not_left_as_it_is) {
  int fresh = 0;
  int left = 0;
  for (std::uint64_t every = 1; every <= 4; ++every) {
    for (const std::int64_t takes : {std::int64_t{0}, std::int64_t{1000}}) {
      for (std::uint64_t last = 20; last < 40; ++last) {
        Facts facts = board("here", last);
        for (RunFact& run : facts.runs) {
          run.end_ns = run.start_ns + takes;
          if (run.tick % every == 0) {
            facts.changes.push_back({"x", "writer", run.tick, run.end_ns});
          }
        }
        const bool changed = last % every == 0;
        const Answer sut = why_old(std::span(&facts, 1), 0, "x", facts.now_ns);
        ASSERT_EQ(sut.cause, changed ? Cause::AllIsWell : Cause::Unchanged) << last << " every " << every;
        ASSERT_EQ(sut.text, changed ? "writer changed x in its last run" : "writer runs and leaves x as it is");
        int& count = changed ? fresh : left;
        ++count;
      }
    }
  }
  EXPECT_GT(fresh, 40);
  EXPECT_GT(left, 40);
}

TEST(Explain, What_a_process_left_counts_before_its_node_has_noted_the_run) {
  Facts facts = board("here", 50);
  for (const RunFact& run : facts.runs) {
    facts.changes.push_back({"x", "writer", run.tick, run.end_ns});
  }
  facts.runs.pop_back();
  const Answer sut = why_old(std::span(&facts, 1), 0, "x", facts.now_ns);
  EXPECT_EQ(sut.cause, Cause::AllIsWell) << sut.text;
  ASSERT_EQ(sut.evidence.size(), 2U);
  EXPECT_THAT(sut.evidence[0], HasSubstr("writer ran last in tick 50 "));
  EXPECT_THAT(sut.evidence[1], HasSubstr("x changed last in tick 50 "));
}

TEST(Explain, What_is_said_at_the_end_of_a_recording_counts_not_what_was_at_its_begin) {
  Facts read;
  ASSERT_TRUE(read_facts(facts_text(reader("alive", 1000 * kMs)), read));
  ASSERT_TRUE(read_facts(facts_text(reader("silent", 2000 * kMs)), read));
  ASSERT_EQ(read.boards.size(), 1U);
  EXPECT_EQ(read.boards[0].state, "silent");
  EXPECT_EQ(read.modules.size(), 1U);
}

TEST(Explain, A_run_that_still_has_time_is_no_trouble) {
  Facts facts = board("here", 1000);
  facts.alive = true;
  facts.modules.push_back(periodic("slow", 20 * kMs));
  for (std::uint64_t tick = 0; tick <= 960; tick += 20) {
    const auto release = static_cast<std::int64_t>(tick) * kMs;
    facts.runs.push_back({1, tick, release, release, release + 1000, false});
  }
  facts.tick = 999;
  facts.now_ns = 999 * kMs;
  EXPECT_EQ(last_trouble(facts, "slow"), kNone) << "that of tick 980 may come until 1000";
  facts.tick = 1001;
  facts.now_ns = 1001 * kMs;
  EXPECT_EQ(last_trouble(facts, "slow"), 980U);
}

TEST(Explain, What_the_ends_of_a_box_do_not_hold_is_no_trouble) {
  Facts facts = board("here", 1000);
  facts.closed = true;
  facts.first_tick = 200;
  facts.modules.push_back(periodic("slow", 10 * kMs));
  for (std::uint64_t tick = 500; tick <= 960; tick += 10) {
    const auto release = static_cast<std::int64_t>(tick) * kMs;
    if (tick != 700) {
      facts.runs.push_back({1, tick, release, release, release + 1000, false});
    }
  }
  EXPECT_EQ(last_trouble(facts, "slow"), 700U) << "its ring had nothing before 500, and was copied at 965";
  for (const std::uint64_t tick : {300U, 970U, 990U}) {
    const Answer sut = why_late(facts, "slow", tick);
    EXPECT_EQ(sut.cause, Cause::NotKnown) << tick;
    EXPECT_THAT(sut.text, HasSubstr("of slow the ticks 500 to 960 are known"));
  }
  std::erase_if(facts.runs, [](const RunFact& run) { return run.module == 1 && run.tick > 800; });
  EXPECT_EQ(last_trouble(facts, "slow"), 900U) << "that long for a copy";
}

TEST(Explain, What_the_recording_lacks_is_no_trouble_and_nobodys_fault) {
  Facts facts = board("here", 1000);
  std::erase_if(facts.runs, [](const RunFact& run) { return run.tick > 500 && run.tick < 700; });
  EXPECT_EQ(last_trouble(facts, "writer"), 699U);
  EXPECT_EQ(why_late(facts, "writer", 600).cause, Cause::Machine) << "nothing says that it ran";
  facts.holes.push_back({0, 500, 700, 501 * kMs, 700 * kMs, 199});
  EXPECT_EQ(last_trouble(facts, "writer"), kNone);
  const Answer sut = why_late(facts, "writer", 600);
  EXPECT_EQ(sut.cause, Cause::NotKnown);
  EXPECT_THAT(sut.text, HasSubstr("the recording lacks 199 runs of writer between the ticks 500 and 700"));

  // Another module of the core that did not run meanwhile.
  facts.modules.push_back(periodic("other", kMs));
  for (std::uint64_t tick = 0; tick < 1000; ++tick) {
    if (tick != 600) {
      const auto release = static_cast<std::int64_t>(tick) * kMs;
      facts.runs.push_back({1, tick, release, release + 100, release + 200, false});
    }
  }
  EXPECT_EQ(why_late(facts, "other", 600).cause, Cause::NotKnown);
  EXPECT_THAT(why_late(facts, "other", 600).text, HasSubstr("the recording lacks runs of writer then"));
  EXPECT_EQ(why_late(facts, "other", 800).cause, Cause::AllIsWell);
}

TEST(Explain, What_is_not_known_is_said_with_its_reason) {
  Facts facts = board("here", 100);
  EXPECT_EQ(why_late(facts, "nobody", 3).cause, Cause::NotKnown);
  facts.first_tick = 50;
  std::erase_if(facts.runs, [](const RunFact& run) { return run.tick < 50; });
  EXPECT_THAT(why_late(facts, "writer", 3).text, HasSubstr("available from tick 50 on"));
}

TEST(Explain, A_stop_is_noted_when_it_has_been_obeyed) {
  Facts facts = board("here", 1000);
  std::erase_if(facts.runs, [](const RunFact& run) { return run.tick > 500 && run.tick < 900; });
  facts.orders.push_back({504 * kMs, 0, "ana", "", "stop", "writer", "", 0, ""});
  for (const std::uint64_t tick : {501U, 503U, 505U, 899U}) {
    const Answer sut = why_late(facts, "writer", tick);
    EXPECT_EQ(sut.cause, Cause::Stopped) << tick;
    EXPECT_EQ(sut.culprit, "ana");
  }
  EXPECT_EQ(why_old({&facts, 1}, 0, "x", 700 * kMs).culprit, "ana");
  facts.orders[0].node_ns = 800 * kMs;
  EXPECT_NE(why_late(facts, "writer", 503).cause, Cause::Stopped) << "that was later";
}

TEST(Explain, A_process_that_died_in_a_run_without_an_end_is_named) {
  Facts facts = board("here", 1000);
  facts.modules.push_back(periodic("proc", 10 * kMs));
  ModuleFact& proc = facts.modules.back();
  proc.type = "process";
  proc.state = "restarting";
  proc.faults = 1;
  proc.fault_tick = 191;  // seen behind the run of tick 190
  proc.fault = "signal 6 (Aborted)";
  for (std::uint64_t tick = 0; tick < 190; tick += 10) {
    const auto release = static_cast<std::int64_t>(tick) * kMs;
    facts.runs.push_back({1, tick, release, release, release + 1000, false});
  }
  for (const std::uint64_t tick : {190U, 200U, 250U}) {
    const Answer sut = why_late(facts, "proc", tick);
    EXPECT_EQ(sut.cause, Cause::Fault) << tick;
    EXPECT_EQ(sut.culprit, "proc");
    EXPECT_THAT(sut.text, HasSubstr("signal 6"));
    EXPECT_THAT(sut.text, Not(HasSubstr("stays stopped")));
  }
  facts.modules.back().state = "faulted";  // it was started again as often as it may be
  facts.modules.back().restarts = 3;
  EXPECT_THAT(why_late(facts, "proc", 250).text, HasSubstr("stays stopped"));
}

TEST(Explain, An_older_fault_is_known_by_its_run) {
  Facts facts = board("here", 1000);
  std::erase_if(facts.runs, [](const RunFact& run) { return run.tick > 300 && run.tick < 400; });
  facts.runs[300].faulted = true;
  facts.modules[0].state = "running";
  facts.modules[0].faults = 2;
  facts.modules[0].fault_tick = 950;
  facts.modules[0].fault = "out of ink";
  const Answer sut = why_late(facts, "writer", 350);
  EXPECT_EQ(sut.cause, Cause::Fault);
  EXPECT_THAT(sut.text, HasSubstr("in tick 300"));
}

TEST(Explain, A_force_that_is_over_is_known_for_its_time) {
  Facts facts = board("here", 1000);
  facts.orders.push_back({300 * kMs, 0, "bob", "", "force", "x", "8", 500 * kMs, ""});
  EXPECT_EQ(why_old({&facts, 1}, 0, "x", 400 * kMs).cause, Cause::Force);
  EXPECT_EQ(why_old({&facts, 1}, 0, "x", 400 * kMs).culprit, "bob");
  EXPECT_EQ(why_old({&facts, 1}, 0, "x", 600 * kMs).cause, Cause::Unchanged) << "its time was over";
  facts.orders.push_back({350 * kMs, 0, "bob", "", "unforce", "x", "", 0, ""});
  EXPECT_EQ(why_old({&facts, 1}, 0, "x", 400 * kMs).cause, Cause::Unchanged) << "it was released";
}

TEST(Explain, A_device_is_named_while_its_data_is_not_good) {
  Facts facts = board("here", 1000);
  facts.devices.push_back({"axis", "ethercat eth1, slave 2", "quality[1]", {"x"}, {}});
  facts.devices.push_back({"other", "ethercat eth1, slave 3", "quality[2]", {"y"}, {{0, 2}}});
  EXPECT_EQ(why_old({&facts, 1}, 0, "x", 400 * kMs).cause, Cause::Unchanged) << "its quality is not known";
  facts.devices[0].qualities = {{DeviceFact::kSinceBefore, 1}, {300 * kMs, 2}, {500 * kMs, 1}};
  EXPECT_EQ(why_old({&facts, 1}, 0, "x", 299 * kMs).cause, Cause::Unchanged);
  const Answer sut = why_old({&facts, 1}, 0, "x", 400 * kMs);
  EXPECT_EQ(sut.cause, Cause::Device);
  EXPECT_EQ(sut.culprit, "axis");
  EXPECT_EQ(sut.text,
            "x is exchanged with device axis (ethercat eth1, slave 2): it is lost: no connection, no answer in "
            "time, or an invalid one");
  EXPECT_THAT(sut.evidence, testing::ElementsAre("quality[1] is 2 since tick 300 (300 ms)"));
  EXPECT_EQ(why_old({&facts, 1}, 0, "x", 500 * kMs).cause, Cause::Unchanged) << "it is back";
  facts.devices[0].variables = {"x.status"};
  facts.devices[0].qualities = {{DeviceFact::kSinceBefore, 0}};
  EXPECT_THAT(why_old({&facts, 1}, 0, "x", 0).evidence, testing::ElementsAre("quality[1] is 0"));
}

TEST(Explain, A_board_that_went_on_running_was_cut_off) {
  Facts other = board("other", 2999);
  other.boards.push_back({"here", "silent", {}, 1000 * kMs, 1, 0});
  const std::vector<Facts> plant{reader("silent", 1000 * kMs), other};
  EXPECT_EQ(why_gone(plant, 0, "other").cause, Cause::Network);
  EXPECT_EQ(why_old(plant, 0, "y", 2000 * kMs).cause, Cause::Network);
}

TEST(Explain, A_board_whose_runs_end_was_killed_or_said_why_it_ended) {
  std::vector<Facts> plant{reader("silent", 1000 * kMs), board("other", 1000)};
  EXPECT_EQ(why_gone(plant, 0, "other").cause, Cause::Board);
  EXPECT_EQ(why_gone(plant, 0, "other").culprit, "other");
  plant[1].closed = true;
  EXPECT_EQ(why_gone(plant, 0, "other").cause, Cause::NotKnown) << "only its recording ended";
  plant[1].stop_reason = "signal 15";
  EXPECT_THAT(why_gone(plant, 0, "other").text, HasSubstr("signal 15"));
}

TEST(Explain, Without_anything_of_the_board_itself_neither_board_nor_cable_is_blamed) {
  const std::vector<Facts> plant{reader("silent", 1000 * kMs)};
  EXPECT_EQ(why_gone(plant, 0, "other").cause, Cause::NotKnown);
}

TEST(Explain, A_value_of_a_board_that_is_heard_is_followed_to_its_writer) {
  std::vector<Facts> plant{reader("alive", 3000 * kMs), board("other", 3000)};
  plant[1].variables.push_back({"y", {"writer@other"}, {}, 0, 0});
  EXPECT_EQ(why_old(plant, 0, "y", 3000 * kMs).cause, Cause::Unchanged);
  plant[1].modules[0].state = "faulted";
  plant[1].modules[0].faults = 1;
  plant[1].modules[0].fault_tick = 2000;
  plant[1].modules[0].fault = "SIGSEGV";
  std::erase_if(plant[1].runs, [](const RunFact& run) { return run.tick > 2000; });
  const Answer sut = why_old(plant, 0, "y", 3000 * kMs);
  EXPECT_EQ(sut.cause, Cause::Fault);
  EXPECT_EQ(sut.culprit, "writer");
}

TEST(Explain, At_the_end_of_a_node_its_last_runs_count) {
  std::vector<Facts> plant{board("here", 100)};
  plant[0].stop_reason = "end of the duration";
  plant[0].now_ns = 102 * kMs;
  EXPECT_EQ(why_old(plant, 0, "x", plant[0].now_ns).cause, Cause::Unchanged);
  EXPECT_EQ(why_old(plant, 0, "x", 200 * kMs).cause, Cause::Stopped) << "later it is the node's end";
}

TEST(Explain, A_rate_limit_is_reported_only_within_its_time) {
  std::vector<Facts> plant{reader("alive", 3000 * kMs), board("other", 3000)};
  plant[0].variables.back().every_ns = 100 * kMs;
  plant[1].variables.push_back({"y", {"writer@other"}, {}, 0, 0});
  plant[1].changes.push_back({"y", "writer", 2950, 2950 * kMs});
  EXPECT_EQ(why_old(plant, 0, "y", 3000 * kMs).cause, Cause::Rate);
  EXPECT_EQ(why_old(plant, 0, "y", 3000 * kMs).culprit, "other");
  plant[1].changes[0].time_ns = 2800 * kMs;
  EXPECT_EQ(why_old(plant, 0, "y", 3000 * kMs).cause, Cause::Unchanged);
}

TEST(Explain, Who_forces_a_value_and_who_wrote_it_last) {
  Facts facts = board("here", 100);
  facts.changes.push_back({"x", "writer", 20, 20 * kMs});
  EXPECT_EQ(who_changed(facts, "x", 100 * kMs).culprit, "writer");
  facts.orders.push_back({30 * kMs, 0, "ana", "pc4", "set", "x", "7", 0, ""});
  EXPECT_EQ(who_changed(facts, "x", 100 * kMs).culprit, "ana");
  EXPECT_EQ(who_changed(facts, "x", 25 * kMs).culprit, "writer");
  facts.orders.push_back({40 * kMs, 0, "bob", "", "force", "x", "8", 0, ""});
  facts.variables[0].forced_until_ns = INT64_MAX;
  const std::vector<Facts> plant{facts};
  EXPECT_EQ(why_old(plant, 0, "x", 100 * kMs).culprit, "bob");
  EXPECT_EQ(who_changed(facts, "z", 100 * kMs).cause, Cause::NotKnown);
}

// Facts come from memory that anybody may have written, and from files.
TEST(Explain, Numbers_that_make_no_sense_are_answered_too) {
  std::mt19937_64 random(36);
  const auto number = [&random] {
    constexpr std::array<std::int64_t, 12> kBad{0,         1,         -1,        2,        kMs - 1,  1000147,
                                                INT32_MAX, INT64_MAX, INT64_MIN, -1000147, 60 * kMs, INT64_MAX / 2};
    return kBad[random() % kBad.size()];
  };
  const auto once = [&random] { return random() % 3 == 0; };
  for (int round = 0; round < 3000; ++round) {
    Facts facts = reader("silent", 5 * kMs);
    facts.runs.resize(50);
    facts.modules.push_back(periodic("slow", 10 * kMs));
    facts.variables.push_back({"z", {"slow"}, {}, 0, 0});
    for (std::int64_t* const one : {&facts.basic_period_ns, &facts.epoch_ns, &facts.now_ns, &facts.lease_ns}) {
      *one = once() ? number() : *one;
    }
    facts.tick = once() ? static_cast<std::uint64_t>(number()) : facts.tick;
    facts.first_tick = once() ? static_cast<std::uint64_t>(number()) : facts.first_tick;
    for (ModuleFact& module : facts.modules) {
      for (std::int64_t* const one : {&module.period_ns, &module.offset_ns, &module.deadline_ns}) {
        *one = once() ? number() : *one;
      }
    }
    make_sound(facts);
    const std::uint64_t at = once() ? random() % 100'000 : 42;
    for (const char* module : {"writer", "slow"}) {
      EXPECT_FALSE(why_late(facts, module, at).text.empty() && last_trouble(facts, module) == 7);
    }
    for (const char* variable : {"x", "y", "z"}) {
      EXPECT_FALSE(why_old({&facts, 1}, 0, variable, static_cast<std::int64_t>(at)).text.empty());
    }
    EXPECT_FALSE(why_gone({&facts, 1}, 0, "other").text.empty());
  }
}

}  // namespace
}  // namespace indurop::explain
