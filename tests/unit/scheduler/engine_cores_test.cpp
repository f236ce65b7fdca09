// SPDX-License-Identifier: Apache-2.0
// Order between bands that do not share one FIFO core: several cores, or no real-time privileges at all.

#include <gtest/gtest.h>

#include <atomic>
#include <thread>

#include "core/rt/clock.h"
#include "core/rt/thread.h"
#include "fixture.h"

namespace indurop::scheduler {
namespace {

std::atomic<std::uint64_t> g_first{0};
std::atomic<std::uint64_t> g_second{0};
std::atomic<int> g_violations{0};

void busy(std::int64_t ns) {
  const std::int64_t end = rt::now_ns() + ns;
  while (rt::now_ns() < end) {
  }
}

void first() {
  busy(200'000);
  ++g_first;
}
// Runs in every second tick, after first() of the same tick.
void second() {
  if (g_first.load() < 2 * g_second.load() + 1) {
    ++g_violations;
  }
  ++g_second;
}

class EngineOrder : public testing::TestWithParam<bool> {};

TEST_P(EngineOrder, A_lower_priority_waits_for_the_higher_one_of_its_tick) {
  const auto cores = rt::allowed_cores();
  const bool two_cores = GetParam();
  if (two_cores && cores.size() < 2) {
    GTEST_SKIP() << "needs two cores";
  }
  g_first = 0;
  g_second = 0;
  g_violations = 0;
  std::vector<Task> tasks = {periodic(0, 2'000'000, 1, first), periodic(1, 4'000'000, 2, second)};
  tasks[0].core = cores.front();
  tasks[1].core = two_cores ? cores.back() : cores.front();
  tasks[0].overrun = tasks[1].overrun = OverrunPolicy::CatchUp;
  auto block = make_block(tasks, 2'000'000, 4'000'000);
  EngineSettings settings;
  settings.basic_period_ns = 2'000'000;
  settings.primary_core = cores.front();
  settings.realtime = false;
  SystemKernel clock;
  Engine sut(*block, tasks, settings, Hooks{}, clock);
  ASSERT_TRUE(sut.start(0).ok());
  const std::int64_t deadline = rt::now_ns() + 30'000'000'000;
  while (g_second < 30 && rt::now_ns() < deadline) {
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  sut.request_stop();
  sut.join();
  EXPECT_GE(g_second, 30U);
  // A lost basic period takes first()'s run of it away; only then may second() be ahead of the count.
  if (block->lost_ticks.load() == 0 && block->modules()[0].skipped.load() == 0) {
    EXPECT_EQ(g_violations, 0);
  }
}
// The mirror sends what modules have written as soon as it is notified.
TEST(EngineCores, Work_on_a_core_other_than_the_primary_one_is_reported) {
  const auto cores = rt::allowed_cores();
  if (cores.size() < 2) {
    GTEST_SKIP() << "needs two cores";
  }
  std::vector<Task> tasks = {periodic(0, 2'000'000, 1, [] {})};
  tasks[0].core = cores.back();
  auto block = make_block(tasks, 2'000'000, 2'000'000);
  EngineSettings settings;
  settings.basic_period_ns = 2'000'000;
  settings.primary_core = cores.front();
  settings.realtime = false;
  std::uint64_t notified = 0;
  Hooks hooks;
  hooks.context = &notified;
  hooks.worked = [](void* context) noexcept { ++*static_cast<std::uint64_t*>(context); };
  SystemKernel clock;
  Engine sut(*block, tasks, settings, hooks, clock);
  sut.step(0, rt::MonoTime{});
  EXPECT_EQ(notified, 2U);  // once by the primary core, once by the one of the module
}

INSTANTIATE_TEST_SUITE_P(OneAndTwoCores, EngineOrder, testing::Bool());

}  // namespace
}  // namespace indurop::scheduler
