// SPDX-License-Identifier: Apache-2.0
#include "scheduler/bands.h"

#include <gmock/gmock.h>

namespace indurop::scheduler {
namespace {

using testing::ElementsAre;

Task task(std::int64_t period, int priority, ModuleType type = ModuleType::Thread, int core = 0) {
  Task t;
  t.period_ns = period;
  t.priority = priority;
  t.type = type;
  t.core = core;
  return t;
}

TEST(Bands, Neighbours_of_one_period_share_a_band_and_the_top_one_runs_inline) {
  const std::vector<Task> tasks = {task(500, 3), task(100, 2), task(100, 1), task(500, 4, ModuleType::Process)};
  const auto sut = make_bands(tasks, 100);
  ASSERT_EQ(sut.size(), 3U);
  EXPECT_EQ(sut[0].kind, BandKind::Inline);
  EXPECT_THAT(sut[0].tasks, ElementsAre(2, 1));
  EXPECT_EQ(sut[1].kind, BandKind::Thread);
  EXPECT_THAT(sut[1].tasks, ElementsAre(0));
  EXPECT_EQ(sut[2].kind, BandKind::Process);
  EXPECT_GT(sut[0].fifo_priority, sut[1].fifo_priority);
  EXPECT_GT(sut[1].fifo_priority, sut[2].fifo_priority);
}

TEST(Bands, A_slow_module_of_the_highest_priority_keeps_faster_ones_out_of_the_tick_thread) {
  const std::vector<Task> tasks = {task(200, 1), task(100, 2)};
  const auto sut = make_bands(tasks, 100);
  ASSERT_EQ(sut.size(), 2U);
  EXPECT_EQ(sut[0].kind, BandKind::Thread);
  EXPECT_EQ(sut[1].kind, BandKind::Thread);
}

TEST(Bands, Another_overrun_policy_is_another_band) {
  std::vector<Task> tasks = {task(100, 1), task(100, 2)};
  tasks[1].overrun = OverrunPolicy::CatchUp;
  EXPECT_EQ(make_bands(tasks, 100).size(), 2U);
}

TEST(Bands, Equal_priorities_on_two_cores_both_run_inline) {
  const std::vector<Task> tasks = {task(100, 1, ModuleType::Thread, 0), task(100, 1, ModuleType::Thread, 1)};
  const auto sut = make_bands(tasks, 100);
  ASSERT_EQ(sut.size(), 2U);
  EXPECT_EQ(sut[0].kind, BandKind::Inline);
  EXPECT_EQ(sut[1].kind, BandKind::Inline);
}

TEST(Bands, A_lower_priority_on_another_core_waits_in_a_thread) {
  const std::vector<Task> tasks = {task(100, 1, ModuleType::Thread, 0), task(100, 2, ModuleType::Thread, 1)};
  EXPECT_EQ(make_bands(tasks, 100)[1].kind, BandKind::Thread);
}

// Of a band only the front is compared with other cores.
TEST(Bands, Modules_that_may_run_in_parallel_share_no_band_with_those_that_may_not) {
  const std::vector<Task> tasks = {task(200, 1, ModuleType::Thread, 0), task(100, 1, ModuleType::Thread, 1),
                                   task(100, 2, ModuleType::Thread, 1)};
  const auto sut = make_bands(tasks, 100);
  ASSERT_EQ(sut.size(), 3U);
  EXPECT_EQ(sut[1].kind, BandKind::Inline);
  EXPECT_EQ(sut[2].kind, BandKind::Thread);
}

TEST(Bands, A_higher_priority_at_the_front_of_another_cores_band_is_waited_for) {
  const std::vector<Task> tasks = {task(100, 1, ModuleType::Thread, 0), task(100, 2, ModuleType::Thread, 0),
                                   task(100, 2, ModuleType::Thread, 1)};
  const auto sut = make_bands(tasks, 100);
  ASSERT_EQ(sut.size(), 2U);
  EXPECT_EQ(sut[1].kind, BandKind::Thread);
}

TEST(Bands, An_offset_is_a_band_of_its_own) {
  std::vector<Task> tasks = {task(200, 1), task(200, 2)};
  tasks[1].offset_ns = 100;
  EXPECT_EQ(make_bands(tasks, 100).size(), 2U);
}

TEST(Bands, Where_data_keeps_the_order_another_core_does_not_part_neighbours) {
  const std::vector<Task> tasks = {task(100, 1), task(100, 2, ModuleType::Thread, 1), task(100, 3)};
  EXPECT_EQ(make_bands(tasks, 100, CoreOrder::Total).size(), 3U);
  const auto sut = make_bands(tasks, 100, CoreOrder::Data);
  ASSERT_EQ(sut.size(), 2U);
  EXPECT_THAT(sut[0].tasks, ElementsAre(0, 2));
  EXPECT_EQ(sut[0].kind, BandKind::Inline);
  EXPECT_EQ(sut[1].kind, BandKind::Inline);
}

TEST(Bands, A_band_begins_with_what_waits_for_another_core_and_ends_with_what_it_waits_for) {
  std::vector<Task> tasks;
  for (int i = 0; i < 6; ++i) {
    tasks.push_back(task(100, i, ModuleType::Thread, i == 2 ? 1 : 0));
    tasks.back().index = static_cast<std::uint32_t>(10 + i);
  }
  tasks[2].after = {10};  // of core 1, for the first of core 0
  tasks[4].after = {12};  // and back
  const auto sut = make_bands(tasks, 100, CoreOrder::Data);
  ASSERT_EQ(sut.size(), 4U);
  EXPECT_THAT(sut[0].tasks, ElementsAre(0));
  EXPECT_THAT(sut[1].tasks, ElementsAre(1, 3));
  EXPECT_THAT(sut[2].tasks, ElementsAre(2));
  EXPECT_THAT(sut[3].tasks, ElementsAre(4, 5));
  EXPECT_EQ(sut[2].kind, BandKind::Thread) << "it waits, so not in the tick thread";
}

}  // namespace
}  // namespace indurop::scheduler
