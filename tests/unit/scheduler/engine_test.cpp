// SPDX-License-Identifier: Apache-2.0
// The engine driven by a virtual clock and by the real one: order, policies, faults, statistics.

#include "scheduler/engine.h"

#include <gmock/gmock.h>
#include <pthread.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <csignal>
#include <stdexcept>
#include <string_view>
#include <thread>

#include "core/rt/clock.h"
#include "fixture.h"

namespace indurop::scheduler {
namespace {

using testing::ElementsAre;

std::vector<int> g_order;
VirtualClock* g_clock = nullptr;
std::atomic<int> g_calls{0};
std::atomic<int> g_other{0};

template <int N>
void note() {
  g_order.push_back(N);
}

class EngineInVirtualTime : public testing::Test {
 protected:
  void SetUp() override {
    g_order.clear();
    g_calls = 0;
    g_other = 0;
    g_clock = &clock;
  }
  std::unique_ptr<Engine> make(const std::vector<Task>& tasks, std::int64_t basic, std::int64_t macro,
                               Kernel* with = nullptr) {
    block = make_block(tasks, basic, macro);
    EngineSettings settings;
    settings.basic_period_ns = basic;
    settings.realtime = false;
    return std::make_unique<Engine>(*block, tasks, settings, Hooks{}, with != nullptr ? *with : clock);
  }
  void steps(Engine& sut, std::uint64_t from, std::uint64_t to, std::int64_t basic) {
    for (std::uint64_t tick = from; tick < to; ++tick) {
      const std::int64_t at = epoch + static_cast<std::int64_t>(tick) * basic;
      clock.sleep_until(rt::mono_time(at));
      sut.step(tick, rt::mono_time(epoch));
    }
  }
  VirtualClock clock;
  BlockPointer block;
  const std::int64_t epoch = 2'000'000;
};

TEST_F(EngineInVirtualTime, Runs_table_3_of_the_chapter_in_its_order) {
  const std::vector<Task> tasks = {periodic(0, 500'000, 3, note<1>), periodic(1, 100'000, 2, note<2>),
                                   periodic(2, 100'000, 1, note<3>)};
  auto sut = make(tasks, 100'000, 500'000);
  steps(*sut, 0, 6, 100'000);
  EXPECT_THAT(g_order, ElementsAre(3, 2, 1, 3, 2, 3, 2, 3, 2, 3, 2, 3, 2, 1));
  EXPECT_EQ(block->modules()[0].runs.load(), 2U);
  EXPECT_EQ(block->modules()[2].runs.load(), 6U);
}

TEST_F(EngineInVirtualTime, Calls_sporadic_modules_after_the_periodic_ones_when_their_condition_holds) {
  Task event;
  event.index = 1;
  event.operation = Operation::Sporadic;
  event.condition = +[] { return g_order.size() == 2 ? 1 : 0; };
  event.run = note<9>;
  auto sut = make({periodic(0, 100'000, 1, note<1>), event}, 100'000, 100'000);
  steps(*sut, 0, 3, 100'000);
  EXPECT_THAT(g_order, ElementsAre(1, 1, 9, 1));
}

TEST_F(EngineInVirtualTime, Counts_what_a_sporadic_process_missed_while_it_was_busy) {
  Task event;
  event.index = 1;
  event.type = ModuleType::Process;
  event.operation = Operation::Sporadic;
  auto sut = make({periodic(0, 100'000, 1, note<1>), event}, 100'000, 100'000);
  ModuleRecord& record = block->modules()[1];
  ProcessSlot& slot = block->process_slots()[1];
  record.pid = 1;
  record.state = ModuleState::Running;
  std::uint64_t handled = 0;
  for (std::uint64_t tick = 0; tick < 10; ++tick) {
    steps(*sut, tick, tick + 1, 100'000);
    if (tick % 3 == 2) {
      slot.done = slot.released.load();
      ++handled;
    }
  }
  EXPECT_EQ(slot.released.load(), handled + 1);
  EXPECT_EQ(record.skipped.load() + slot.released.load(), 10U);
  EXPECT_EQ(record.overruns.load(), 0U);
}

TEST_F(EngineInVirtualTime, Quarantines_a_module_that_throws_and_names_the_cause) {
  const std::vector<Task> tasks = {periodic(0, 100'000, 1, [] { throw std::runtime_error("no sensor"); }),
                                   periodic(1, 100'000, 2, note<2>)};
  auto sut = make(tasks, 100'000, 100'000);
  steps(*sut, 0, 3, 100'000);
  const ModuleRecord& record = block->modules()[0];
  EXPECT_EQ(record.state.load(), ModuleState::Faulted);
  EXPECT_EQ(record.fault_kind.load(), static_cast<std::uint32_t>(FaultKind::Exception));
  EXPECT_STREQ(record.last_fault, "exception: no sensor");
  EXPECT_EQ(record.runs.load(), 1U);
  EXPECT_EQ(block->modules()[1].runs.load(), 3U);
}

TEST_F(EngineInVirtualTime, Measures_execution_response_and_latency) {
  const std::vector<Task> tasks = {periodic(0, 1'000'000, 1, [] { g_clock->advance(30'000); }),
                                   periodic(1, 1'000'000, 2, [] { g_clock->advance(5'000); })};
  auto sut = make(tasks, 1'000'000, 1'000'000);
  steps(*sut, 0, 10, 1'000'000);
  const ModuleRecord& second = block->modules()[1];
  EXPECT_EQ(second.exec.max.load(), 5'000);
  EXPECT_EQ(second.latency.min.load(), 30'000);
  EXPECT_EQ(second.response.max.load(), 35'000);
  EXPECT_EQ(second.jitter.count.load(), 10U);
  EXPECT_EQ(second.jitter.max.load(), 0);
}

TEST_F(EngineInVirtualTime, Names_the_culprit_of_an_inline_overrun_and_who_ran_before_it) {
  const std::vector<Task> tasks = {periodic(0, 100'000, 1, [] { g_clock->advance(20'000); }),
                                   periodic(1, 100'000, 2, [] { g_clock->advance(150'000); }),
                                   periodic(2, 100'000, 3, note<3>)};
  auto sut = make(tasks, 100'000, 100'000);
  steps(*sut, 0, 1, 100'000);
  EXPECT_EQ(block->modules()[1].overruns.load(), 1U);
  EXPECT_EQ(block->modules()[2].overruns.load(), 0U);
  const OverrunEntry& entry = *block->at<OverrunEntry>(block->overrun_log_offset);
  EXPECT_EQ(entry.module, 1U);
  EXPECT_EQ(entry.own_ns, 150'000);
  EXPECT_EQ(entry.previous, 0);
  EXPECT_EQ(entry.previous_ns, 20'000);
}

TEST_F(EngineInVirtualTime, A_disabled_module_leaves_its_place_empty_until_it_is_enabled) {
  const std::vector<Task> tasks = {periodic(0, 100'000, 1, note<1>), periodic(1, 100'000, 2, note<2>),
                                   periodic(2, 200'000, 3, note<3>)};
  auto sut = make(tasks, 100'000, 200'000);
  steps(*sut, 0, 2, 100'000);
  EXPECT_TRUE(sut->disable(0));
  EXPECT_TRUE(sut->disable(2));
  EXPECT_FALSE(sut->disable(7)) << "no such module";
  EXPECT_TRUE(sut->at_rest(0) && sut->at_rest(2));
  steps(*sut, 2, 4, 100'000);
  sut->enable(0);
  sut->enable(2);
  steps(*sut, 4, 5, 100'000);
  EXPECT_THAT(g_order, ElementsAre(1, 2, 3, 1, 2, 2, 2, 1, 2, 3));
  EXPECT_EQ(block->modules()[0].skipped.load(), 0U);
  EXPECT_EQ(block->modules()[2].skipped.load(), 0U);
}

TEST_F(EngineInVirtualTime, Stops_only_the_module_whose_policy_says_so) {
  std::vector<Task> tasks = {periodic(0, 100'000, 1, [] { g_clock->advance(150'000); }),
                             periodic(1, 200'000, 2, note<2>)};
  tasks[0].overrun = OverrunPolicy::StopModule;
  auto sut = make(tasks, 100'000, 200'000);
  steps(*sut, 0, 4, 100'000);
  EXPECT_EQ(block->modules()[0].runs.load(), 1U);
  EXPECT_EQ(block->modules()[0].state.load(), ModuleState::Faulted);
  EXPECT_EQ(block->modules()[1].runs.load(), 2U);
}

// From here on with threads and the real clock.

class EngineThreads : public EngineInVirtualTime {
 protected:
  SystemKernel system;
  void run_until(Engine& sut, const std::function<bool()>& reached) {
    const std::int64_t deadline = rt::now_ns() + 20'000'000'000;
    while (!reached() && rt::now_ns() < deadline) {
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    sut.request_stop();
    sut.join();
    EXPECT_TRUE(reached());
  }
};

TEST_F(EngineThreads, Runs_exactly_the_ticks_asked_for) {
  const std::vector<Task> tasks = {periodic(0, 1'000'000, 1, [] { ++g_calls; }),
                                   periodic(1, 5'000'000, 2, [] { ++g_other; })};
  auto sut = make(tasks, 1'000'000, 5'000'000, &system);
  ASSERT_TRUE(sut->start(50).ok());
  sut->join();
  EXPECT_EQ(block->modules()[0].runs.load() + block->modules()[0].skipped.load(), 50U);
  EXPECT_EQ(static_cast<std::uint64_t>(g_calls.load()), block->modules()[0].runs.load());
}

// Moves with the tick thread alone; others sleep really, and a little only.
class TickClock final : public Kernel {
 public:
  rt::MonoTime now() noexcept override { return rt::mono_time(now_.load()); }
  void sleep_until(rt::MonoTime deadline) noexcept override {
    char name[16] = {};
    ::pthread_getname_np(::pthread_self(), name, sizeof name);
    if (!std::string_view(name).starts_with("irp-tick")) {
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
      return;
    }
    now_ = std::max(now_.load(), rt::to_ns(deadline)) + (++sleeps == late_sleep ? late_ns : 0);
  }
  void advance(std::int64_t ns) noexcept { now_ += ns; }
  int late_sleep = 0;  // the one that takes longer, counted from 1
  std::int64_t late_ns = 0;
  std::atomic<int> sleeps{0};

 private:
  std::atomic<std::int64_t> now_{1'000'000'000};
};
TickClock* g_tick_clock = nullptr;

TEST_F(EngineThreads, A_tick_that_comes_right_before_the_next_one_is_lost_and_nobodys_overrun) {
  for (const std::int64_t late : {0LL, 900'000LL, 991'000LL, 1'000'000LL, 3'991'000LL}) {
    TickClock ticking;
    g_tick_clock = &ticking;
    ticking.late_ns = late;
    ticking.late_sleep = 40;
    const std::vector<Task> tasks = {periodic(0, 1'000'000, 1, [] { g_tick_clock->advance(50'000); })};
    block = make_block(tasks, 1'000'000, 1'000'000);
    EngineSettings settings;
    settings.basic_period_ns = 1'000'000;
    settings.realtime = false;
    settings.spin.mode = SpinMode::Off;
    Engine sut(*block, tasks, settings, Hooks{}, ticking);
    ASSERT_TRUE(sut.start(100).ok());
    sut.join();
    ASSERT_GT(ticking.sleeps, 40);
    const ModuleRecord& record = block->modules()[0];
    EXPECT_EQ(record.overruns.load(), 0U) << late;
    const std::uint64_t lost = late == 0 || late == 900'000 ? 0 : late == 3'991'000 ? 4 : 1;
    EXPECT_EQ(block->lost_ticks.load(), lost) << late;
    EXPECT_EQ(record.runs.load(), 100 - lost) << late;
    EXPECT_EQ(record.skipped.load(), lost) << late;
  }
}

RunBlock* g_block = nullptr;
std::vector<std::int64_t> g_starts;

TEST_F(EngineThreads, Ticks_follow_a_grid_that_a_module_moves) {
  constexpr std::int64_t kPeriod = 1'000'000;
  constexpr std::int64_t kMove = 7'000;
  TickClock ticks;
  g_tick_clock = &ticks;
  const std::vector<Task> tasks = {periodic(0, kPeriod, 1, [] {
    g_starts.push_back(rt::to_ns(g_tick_clock->now()));
    g_block->epoch_ns += g_starts.size() % 2 == 0 ? kMove : -kMove / 7;
  })};
  block = make_block(tasks, kPeriod, kPeriod);
  EngineSettings settings;
  settings.basic_period_ns = kPeriod;
  settings.realtime = false;
  settings.spin.mode = SpinMode::Off;
  Engine sut(*block, tasks, settings, Hooks{}, ticks);
  g_block = block.get();
  g_starts.clear();
  ASSERT_TRUE(sut.start(40).ok());
  sut.join();
  ASSERT_EQ(g_starts.size(), 40U);
  for (std::size_t i = 1; i < g_starts.size(); ++i) {
    EXPECT_EQ(g_starts[i] - g_starts[i - 1], kPeriod + (i % 2 == 0 ? kMove : -kMove / 7)) << i;
  }
  EXPECT_EQ(block->lost_ticks.load(), 0U);
  EXPECT_EQ(block->modules()[0].latency.max.load(), 0);
}

TEST_F(EngineThreads, Skips_a_release_while_the_band_is_still_busy) {
  const std::vector<Task> tasks = {periodic(0, 2'000'000, 1, [] { ++g_other; }), periodic(1, 4'000'000, 2, [] {
                                     ++g_calls;
                                     std::this_thread::sleep_for(std::chrono::milliseconds(10));
                                   })};
  auto sut = make(tasks, 2'000'000, 4'000'000, &system);
  ASSERT_TRUE(sut->start(0).ok());
  run_until(*sut, [] { return g_calls > 3; });
  EXPECT_GT(block->modules()[1].overruns.load(), 0U);
  // What was due while the machine stood still is skipped as well, and no overrun of a module.
  const std::uint64_t others = block->modules()[1].skipped.load() - block->modules()[1].overruns.load();
  EXPECT_LE(others, block->lost_ticks.load());
  EXPECT_EQ(block->modules()[0].overruns.load(), 0U);
}

TEST_F(EngineThreads, Catches_up_releases_if_the_policy_says_so) {
  std::vector<Task> tasks = {
      periodic(0, 2'000'000, 1, [] { ++g_other; }), periodic(1, 4'000'000, 2, [] {
        if (++g_calls == 1) {  // held up for some of its periods, however long the machine takes for them
          const int until = g_other + 12;
          for (int ms = 0; g_other < until && ms < 10'000; ++ms) {
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
          }
        }
      })};
  tasks[1].overrun = OverrunPolicy::CatchUp;
  auto sut = make(tasks, 2'000'000, 4'000'000, &system);
  ASSERT_TRUE(sut->start(200).ok());
  sut->join();
  EXPECT_GE(block->modules()[1].overruns.load(), 3U);
  EXPECT_GE(g_calls.load() + static_cast<int>(block->modules()[1].skipped.load()), 98);
}

#ifndef __SANITIZE_THREAD__
TEST_F(EngineThreads, Contains_a_crashing_module_of_the_inline_band) {
  std::vector<Task> tasks = {periodic(0, 1'000'000, 1, [] { std::raise(SIGSEGV); }),
                             periodic(1, 1'000'000, 2, [] { ++g_calls; })};
  auto sut = make(tasks, 1'000'000, 1'000'000, &system);
  ASSERT_TRUE(sut->start(0).ok());
  run_until(*sut, [] { return g_calls > 5; });
  EXPECT_EQ(block->modules()[0].fault_kind.load(), static_cast<std::uint32_t>(FaultKind::Signal));
  EXPECT_EQ(block->modules()[0].runs.load(), 1U);
}

TEST_F(EngineThreads, A_module_is_at_rest_only_when_its_run_is_over) {
  static std::atomic<bool> inside{false};
  static std::atomic<bool> leave{false};
  inside = leave = false;
  const std::vector<Task> tasks = {periodic(0, 1'000'000, 1, [] { ++g_calls; }), periodic(1, 2'000'000, 2, [] {
                                     inside = true;
                                     while (!leave) {
                                     }
                                     inside = false;
                                   })};
  auto sut = make(tasks, 1'000'000, 2'000'000, &system);
  ASSERT_TRUE(sut->start(0).ok());
  const std::int64_t deadline = rt::now_ns() + 20'000'000'000;
  while (!inside && rt::now_ns() < deadline) {
    std::this_thread::yield();
  }
  EXPECT_TRUE(sut->disable(1));
  EXPECT_FALSE(sut->at_rest(1));
  leave = true;
  run_until(*sut, [&] { return sut->at_rest(1); });
  EXPECT_FALSE(inside);
}

TEST_F(EngineThreads, Ends_a_module_that_never_returns_by_its_budget) {
  std::vector<Task> tasks = {periodic(0, 1'000'000, 1, [] { ++g_calls; }), periodic(1, 2'000'000, 2, [] {
                               volatile bool forever = true;
                               while (forever) {
                               }
                             })};
  tasks[1].budget_ns = 10'000'000;
  auto sut = make(tasks, 1'000'000, 2'000'000, &system);
  ASSERT_TRUE(sut->start(0).ok());
  run_until(*sut, [this] { return block->modules()[1].state.load() == ModuleState::Faulted; });
  EXPECT_EQ(block->modules()[1].fault_kind.load(), static_cast<std::uint32_t>(FaultKind::Budget));
}
#endif

}  // namespace
}  // namespace indurop::scheduler
