// SPDX-License-Identifier: Apache-2.0
// The order of execution (chapter, Table 3), offsets, cores, and sporadic modules behind the periodic ones.

#include <algorithm>
#include <array>
#include <csignal>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <thread>

#include "core/rt/thread.h"
#include "node_fixture.h"

namespace indurop::test {
namespace {

using Schedule = NodeTest;

constexpr std::array kModules{"cntr1", "cntr2", "cntr3", "cntr4"};

std::set<std::uint64_t> slots_of(const scheduler::RunBlock& run, const std::string& name) {
  std::set<std::uint64_t> slots;
  for (const Started& s : slot_log(run)) {
    if (run.modules()[s.module].name == name) {
      slots.insert(s.tick % run.slot_count);
    }
  }
  return slots;
}

TEST_F(Schedule, Of_the_chapter_runs_in_the_order_of_table_3) {
#if defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "ThreadSanitizer makes seven modules take longer than 100 us";
#endif
  const std::string file = std::string(EXAMPLE_DIR) + "/module.xml";
  if (!std::filesystem::exists(file)) {
    GTEST_SKIP() << "the examples are not built";
  }
  // A machine that stands still for some milliseconds makes a module exceed its budget, and what it would have caused
  // does not happen: then it is tried again.
  const auto stood_still = [&] {
    return std::any_of(kModules.begin(), kModules.end(), [&](const char* name) {
      return static_cast<scheduler::FaultKind>(module(name).fault_kind.load()) == scheduler::FaultKind::Budget;
    });
  };
  bool whole = false;
  for (int attempt = 0; attempt < 3 && !whole; ++attempt) {
    Program& sut = start_file(file, {"--report", folder() / "r.json"});
    ASSERT_TRUE(wait_until_running(sut));
    ASSERT_TRUE(wait_until([&] {
      return stood_still() ||
             (module("event1").runs.load() > 0 && std::all_of(kModules.begin(), kModules.end(), [&](const char* name) {
                return module(name).runs.load() >= 200;
              }));
    }));
    sut.signal(SIGTERM);
    const int code = sut.wait();
    whole = !stood_still();
    ASSERT_TRUE(code == 0 || !whole);
  }
  ASSERT_TRUE(whole) << "the machine stood still in each of three attempts";
  const auto& block = *run();
  EXPECT_EQ(block.basic_period_ns, 100'000);
  EXPECT_EQ(block.macro_period_ns, 500'000);
  EXPECT_EQ(order_violations(block), 0);
  EXPECT_EQ(slots_of(block, "cntr3"), (std::set<std::uint64_t>{0, 1, 2, 3, 4}));
  EXPECT_EQ(slots_of(block, "cntr2"), (std::set<std::uint64_t>{0, 1, 2, 3, 4}));
  EXPECT_EQ(slots_of(block, "cntr1"), std::set<std::uint64_t>{0});
  EXPECT_EQ(slots_of(block, "cntr4"), std::set<std::uint64_t>{0});
  const auto report = nlohmann::json::parse(std::ifstream(folder() / "r.json"));
  EXPECT_EQ(report["modules"].size(), 7U);
  EXPECT_EQ(report["node"], node());
}

TEST_F(Schedule, Is_shown_by_the_log_in_the_order_of_the_plan) {
  Program& sut = start_and_wait({{.file = "counter.so", .name = "last", .priority = 3},
                                 {.file = "label.so", .name = "slow", .period = "2ms", .priority = 2},
                                 {.file = "label.so", .name = "first", .priority = 1}});
  ASSERT_TRUE(runs_reach("last", 200));
  const auto log = indurop({"log", "-o", "json", "-n", "300"});
  ASSERT_EQ(log.code, 0);
  const auto runs = nlohmann::json::parse(log.out)["runs"];
  std::map<std::uint64_t, std::vector<std::pair<std::int64_t, std::string>>> ticks;
  for (const auto& entry : runs) {
    ticks[entry["tick"]].emplace_back(entry["release_ns"].get<std::int64_t>() + entry["latency_ns"].get<std::int64_t>(),
                                      entry["module"]);
  }
  const std::map<std::string, int> place = {{"first", 1}, {"slow", 2}, {"last", 3}};
  for (auto& [tick, started] : ticks) {
    std::sort(started.begin(), started.end());
    for (std::size_t i = 1; i < started.size(); ++i) {
      EXPECT_LT(place.at(started[i - 1].second), place.at(started[i].second)) << "tick " << tick;
    }
  }
  sut.signal(SIGTERM);
  EXPECT_EQ(sut.wait(), 0);
}

TEST_F(Schedule, With_offsets_runs_each_module_in_its_own_basic_period) {
  Program& sut = start_and_wait(
      {{.file = "label.so", .name = "zero", .period = "4ms", .priority = 1},
       {.file = "label.so", .name = "one", .period = "4ms", .priority = 2, .more = "<offset>1ms</offset>"},
       {.file = "label.so", .name = "three", .period = "4ms", .priority = 3, .more = "<offset>3ms</offset>"}});
  ASSERT_TRUE(runs_reach("three", 20));
  sut.signal(SIGTERM);
  ASSERT_EQ(sut.wait(), 0);
  EXPECT_EQ(run()->basic_period_ns, 1'000'000);
  EXPECT_EQ(slots_of(*run(), "zero"), std::set<std::uint64_t>{0});
  EXPECT_EQ(slots_of(*run(), "one"), std::set<std::uint64_t>{1});
  EXPECT_EQ(slots_of(*run(), "three"), std::set<std::uint64_t>{3});
}

TEST_F(Schedule, Interrupts_a_long_module_for_those_with_a_higher_priority) {
  Program& sut = start_and_wait(
      {{.file = "counter.so", .name = "fast", .priority = 1},
       {.file = "faulty.so", .name = "long", .period = "20ms", .priority = 2, .properties = {{"busy_us", "8000"}}}});
  ASSERT_TRUE(runs_reach("long", 10));
  sut.signal(SIGTERM);
  ASSERT_EQ(sut.wait(), 0);
  int during = 0;
  const auto log = slot_log(*run());
  for (const Started& slow : log) {
    for (const Started& fast : log) {
      during +=
          slow.module == 1 && fast.module == 0 && fast.start_ns > slow.start_ns && fast.end_ns < slow.end_ns ? 1 : 0;
    }
  }
  EXPECT_GT(during, 10) << "the fast module ran while the long one did";
  EXPECT_EQ(order_violations(*run()), 0);
}

TEST_F(Schedule, On_several_cores_keeps_the_total_order_if_configured) {
  const auto cores = rt::allowed_cores();
  if (cores.size() < 2) {
    GTEST_SKIP() << "needs two cores";
  }
  const auto on = [&](std::size_t i) { return "<core>" + std::to_string(cores[i]) + "</core>"; };
  std::string text = xml({{.file = "label.so", .name = "a", .priority = 1, .more = on(0)},
                          {.file = "label.so", .name = "b", .priority = 2, .more = on(1)},
                          {.file = "label.so", .name = "c", .period = "2ms", .priority = 3, .more = on(0)},
                          {.file = "label.so", .name = "d", .period = "2ms", .priority = 4, .more = on(1)}});
  text.insert(text.find("<root>") + 6, "<order>total</order>");
  Program& sut = start_file(write("total.xml", text));
  ASSERT_TRUE(wait_until_running(sut));
  for (const char* name : {"a", "b", "c", "d"}) {
    ASSERT_TRUE(runs_reach(name, 200)) << name;
  }
  sut.signal(SIGTERM);
  ASSERT_EQ(sut.wait(), 0);
  EXPECT_EQ(order_violations(*run()), 0);
}

TEST_F(Schedule, Sporadic_thread_and_process_run_when_their_event_occurs) {
  Program& sut = start_and_wait({{.file = "counter.so", .name = "counter"},
                                 {.file = "event.so",
                                  .name = "event",
                                  .operation = "sporadic",
                                  .period = "10ms",
                                  .priority = 1,
                                  .properties = {{"every", "10"}}},
                                 {.file = "process.exe",
                                  .name = "process",
                                  .type = "process",
                                  .operation = "sporadic",
                                  .period = "100ms",
                                  .priority = 2}});
  ASSERT_TRUE(runs_reach("event", 20));
  ASSERT_TRUE(runs_reach("process", 20));
  const auto events = value<std::uint32_t>("nt::events");
  const auto counted = value<std::uint32_t>("nt::counted");
  EXPECT_LE(events * 10, counted);
  sut.signal(SIGTERM);
  EXPECT_EQ(sut.wait(), 0);
  // Both came after the periodic module of their tick.
  std::map<std::uint64_t, std::int64_t> end_of;
  const auto log = slot_log(*run());
  for (const Started& s : log) {
    if (s.module == 0) {
      end_of[s.tick] = s.end_ns;
    }
  }
  for (const Started& s : log) {
    if (s.module != 0 && end_of.contains(s.tick)) {
      EXPECT_GE(s.start_ns, end_of[s.tick]);
    }
  }
}

TEST_F(Schedule, After_base_does_not_wait_for_a_long_module) {
  Program& sut = start_and_wait(
      {{.file = "counter.so", .name = "counter", .priority = 1},
       {.file = "faulty.so", .name = "long", .period = "50ms", .priority = 2, .properties = {{"busy_us", "30000"}}},
       {.file = "event.so", .name = "late", .operation = "sporadic", .period = "1s", .priority = 1},
       {.file = "event.so",
        .name = "early",
        .operation = "sporadic",
        .period = "1s",
        .priority = 2,
        .properties = {{"early", "true"}},
        .more = "<position>after-base</position>"}});
  ASSERT_TRUE(runs_reach("long", 5));
  sut.signal(SIGTERM);
  ASSERT_EQ(sut.wait(), 0);
  int early = 0;
  int late = 0;
  const auto log = slot_log(*run());
  for (const Started& slow : log) {
    for (const Started& s : log) {
      const bool during = slow.module == 1 && s.start_ns > slow.start_ns && s.end_ns < slow.end_ns;
      early += during && s.module == 3 ? 1 : 0;
      late += during && s.module == 2 ? 1 : 0;
    }
  }
  EXPECT_GT(early, 0);
  EXPECT_EQ(late, 0);
}

TEST_F(Schedule, Deadlines_of_sporadic_and_periodic_modules_are_watched) {
  Program& sut = start_and_wait({{.file = "counter.so", .name = "counter", .period = "10ms", .priority = 1},
                                 {.file = "faulty.so",
                                  .name = "slow",
                                  .period = "10ms",
                                  .priority = 2,
                                  .properties = {{"busy_us", "3000"}},
                                  .more = "<deadline>2ms</deadline>"},
                                 {.file = "event.so",
                                  .name = "event",
                                  .operation = "sporadic",
                                  .period = "1ms",
                                  .priority = 1,
                                  .properties = {{"busy_us", "2000"}}}});
  EXPECT_TRUE(wait_until([&] { return module("slow").deadline_misses.load() > 3; }));
  EXPECT_TRUE(wait_until([&] { return module("event").deadline_misses.load() > 3; }));
  sut.signal(SIGTERM);
  EXPECT_EQ(sut.wait(), 0);
  EXPECT_TRUE(sut.says("module slow:"));
  EXPECT_CONTAINS(sut.err(), "of 2000.0 us missed");
}

TEST_F(Schedule, Too_short_a_basic_period_is_refused_and_adjusted_on_request) {
  const std::vector<Module> modules = {{.file = "counter.so", .name = "a", .period = "1ms"},
                                       {.file = "label.so", .name = "b", .period = "1001us", .priority = 2}};
  const auto refused = run_to_end(modules);
  EXPECT_EQ(refused.code, 4);
  EXPECT_CONTAINS(refused.err, "b period 1.001 ms -> 1 ms");
  EXPECT_CONTAINS(refused.err, "--adjust");
  EXPECT_EQ(run_to_end(modules, {"--adjust", "--duration", "20ms"}).code, 0);
  EXPECT_GE(run()->basic_period_ns, 50'000);
}

}  // namespace
}  // namespace indurop::test
