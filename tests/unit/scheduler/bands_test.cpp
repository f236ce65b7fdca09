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

TEST(Bands, NeighboursOfOnePeriodShareABandAndTheTopOneRunsInline) {
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

TEST(Bands, ASlowModuleOfTheHighestPriorityKeepsFasterOnesOutOfTheTickThread) {
  const std::vector<Task> tasks = {task(200, 1), task(100, 2)};
  const auto sut = make_bands(tasks, 100);
  ASSERT_EQ(sut.size(), 2U);
  EXPECT_EQ(sut[0].kind, BandKind::Thread);
  EXPECT_EQ(sut[1].kind, BandKind::Thread);
}

TEST(Bands, AnotherOverrunPolicyIsAnotherBand) {
  std::vector<Task> tasks = {task(100, 1), task(100, 2)};
  tasks[1].overrun = OverrunPolicy::CatchUp;
  EXPECT_EQ(make_bands(tasks, 100).size(), 2U);
}

TEST(Bands, EqualPrioritiesOnTwoCoresBothRunInline) {
  const std::vector<Task> tasks = {task(100, 1, ModuleType::Thread, 0), task(100, 1, ModuleType::Thread, 1)};
  const auto sut = make_bands(tasks, 100);
  ASSERT_EQ(sut.size(), 2U);
  EXPECT_EQ(sut[0].kind, BandKind::Inline);
  EXPECT_EQ(sut[1].kind, BandKind::Inline);
}

TEST(Bands, ALowerPriorityOnAnotherCoreWaitsInAThread) {
  const std::vector<Task> tasks = {task(100, 1, ModuleType::Thread, 0), task(100, 2, ModuleType::Thread, 1)};
  EXPECT_EQ(make_bands(tasks, 100)[1].kind, BandKind::Thread);
}

TEST(Bands, AnOffsetIsABandOfItsOwn) {
  std::vector<Task> tasks = {task(200, 1), task(200, 2)};
  tasks[1].offset_ns = 100;
  EXPECT_EQ(make_bands(tasks, 100).size(), 2U);
}

}  // namespace
}  // namespace indurop::scheduler
