// SPDX-License-Identifier: Apache-2.0
// Versions of a module that replace each other between two runs: which one runs in which tick, and with what state.

#include "scheduler/exchange.h"

#include <gmock/gmock.h>

#include <random>
#include <stdexcept>
#include <utility>

#include "fixture.h"
#include "scheduler/engine.h"

namespace indurop::scheduler {
namespace {

using testing::ElementsAre;
using Step = Exchange::Step;

constexpr std::int64_t kExchangePeriod = 1'000'000;
constexpr std::int64_t kExchangeEpoch = 2'000'000;

// Two versions of a counter. Each keeps one number, and shows it with its own sign.
std::int64_t g_old = 0;
std::int64_t g_new = 0;
std::int64_t g_fault_at = -1;  // the new version throws when its number is this one, after it has counted
std::vector<std::int64_t> g_shown;

void run_old() {
  g_shown.push_back(++g_old);
}
void run_new() {
  ++g_new;
  if (g_new == g_fault_at) {
    throw std::runtime_error("out of ink");
  }
  g_shown.push_back(-g_new);
}

Exchange::Pair pair_of(std::int64_t& a, std::int64_t& b) {
  return {reinterpret_cast<std::byte*>(&a), reinterpret_cast<std::byte*>(&b), sizeof a};
}

class ModuleExchange : public testing::Test {
 protected:
  void SetUp() override {
    g_old = 0;
    g_new = 100;
    g_fault_at = -1;
    g_shown.clear();
    const std::vector<Task> tasks = {periodic(0, kExchangePeriod, 1, run_old)};
    block = make_block(tasks, kExchangePeriod, kExchangePeriod);
    EngineSettings settings;
    settings.basic_period_ns = kExchangePeriod;
    settings.realtime = false;
    sut = std::make_unique<Engine>(*block, tasks, settings, Hooks{}, clock);
  }
  void steps(int count) {
    for (int i = 0; i < count; ++i, ++tick) {
      clock.sleep_until(rt::mono_time(kExchangeEpoch + static_cast<std::int64_t>(tick) * kExchangePeriod));
      sut->step(tick, rt::mono_time(kExchangeEpoch));
    }
  }
  static Exchange::Settings settings_of(std::vector<Exchange::Pair> pairs) {
    Exchange::Settings settings;
    settings.next.run = run_new;
    settings.pairs = std::move(pairs);
    return settings;
  }
  [[nodiscard]] ModuleRecord& record() const { return block->modules()[0]; }

  VirtualClock clock;
  BlockPointer block;
  std::unique_ptr<Engine> sut;
  std::uint64_t tick = 0;
};

TEST_F(ModuleExchange, The_new_version_continues_with_what_the_old_one_kept_and_no_run_is_left_out) {
  Exchange exchange(settings_of({pair_of(g_old, g_new)}));
  steps(3);
  ASSERT_TRUE(sut->watch(0, exchange));
  EXPECT_TRUE(sut->has_passed(0));
  steps(2);
  EXPECT_EQ(exchange.step(), Step::Done);
  EXPECT_EQ(exchange.first_tick(), 3U);
  EXPECT_TRUE(sut->unwatch(0));
  steps(1);
  EXPECT_THAT(g_shown, ElementsAre(1, 2, 3, -4, -5, -6));
  EXPECT_EQ(record().runs.load(), 6U);
  EXPECT_EQ(record().skipped.load(), 0U);
}

TEST_F(ModuleExchange, It_waits_for_its_tick) {
  Exchange::Settings settings = settings_of({pair_of(g_old, g_new)});
  settings.earliest_tick = 4;
  Exchange exchange(std::move(settings));
  ASSERT_TRUE(sut->watch(0, exchange));
  steps(6);
  EXPECT_THAT(g_shown, ElementsAre(1, 2, 3, 4, -5, -6));
  EXPECT_EQ(exchange.first_tick(), 4U);
}

TEST_F(ModuleExchange, After_a_fault_the_old_version_continues_in_the_next_tick_with_the_state_before_that_run) {
  g_fault_at = 6;
  Exchange exchange(settings_of({pair_of(g_old, g_new)}));
  steps(3);
  ASSERT_TRUE(sut->watch(0, exchange));
  steps(3);
  EXPECT_EQ(exchange.step(), Step::Failing);
  steps(2);
  EXPECT_EQ(exchange.step(), Step::Back);
  EXPECT_EQ(exchange.reason(), Exchange::Reason::Fault);
  EXPECT_EQ(exchange.first_tick(), 6U);
  EXPECT_THAT(g_shown, ElementsAre(1, 2, 3, -4, -5, 6, 7)) << "6 was counted and not shown by the new one";
  EXPECT_EQ(record().faults.load(), 1U);
  EXPECT_NE(record().state.load(), ModuleState::Faulted);
  EXPECT_EQ(record().runs.load(), 8U);
}

TEST_F(ModuleExchange, A_command_lets_the_old_version_continue_with_what_the_new_one_kept_last) {
  Exchange exchange(settings_of({pair_of(g_old, g_new)}));
  ASSERT_TRUE(sut->watch(0, exchange));
  EXPECT_FALSE(exchange.go_back(Exchange::Reason::Command)) << "nothing was exchanged yet";
  steps(3);
  EXPECT_TRUE(exchange.go_back(Exchange::Reason::Command));
  steps(2);
  EXPECT_THAT(g_shown, ElementsAre(-1, -2, -3, 4, 5));
  EXPECT_FALSE(exchange.go_back(Exchange::Reason::Command));
  EXPECT_EQ(exchange.reason(), Exchange::Reason::Command);
}

TEST_F(ModuleExchange, Without_a_way_back_a_fault_stops_the_module) {
  g_fault_at = 2;
  Exchange::Settings settings = settings_of({pair_of(g_old, g_new)});
  settings.can_return = false;
  Exchange exchange(std::move(settings));
  ASSERT_TRUE(sut->watch(0, exchange));
  steps(4);
  EXPECT_THAT(g_shown, ElementsAre(-1));
  EXPECT_EQ(record().state.load(), ModuleState::Faulted);
  EXPECT_FALSE(sut->unwatch(0)) << "its gate is closed";
}

TEST_F(ModuleExchange, A_fault_of_the_old_version_stops_the_module_and_ends_the_exchange) {
  Exchange::Settings settings = settings_of({});
  settings.earliest_tick = 100;
  settings.next.run = run_old;
  Exchange exchange(std::move(settings));
  g_fault_at = g_new + 2;
  const std::vector<Task> tasks = {periodic(0, kExchangePeriod, 1, run_new)};
  EngineSettings engine_settings;
  engine_settings.basic_period_ns = kExchangePeriod;
  engine_settings.realtime = false;
  sut = std::make_unique<Engine>(*block, tasks, engine_settings, Hooks{}, clock);
  ASSERT_TRUE(sut->watch(0, exchange));
  steps(4);
  EXPECT_EQ(record().state.load(), ModuleState::Faulted);
  EXPECT_EQ(exchange.step(), Step::Waiting);
  EXPECT_FALSE(sut->watch(0, exchange)) << "a faulted module has no runs between which it could be exchanged";
}

TEST_F(ModuleExchange, A_copy_counts_only_if_no_run_has_begun_since) {
  Exchange::Settings settings = settings_of({});
  settings.offered = true;
  Exchange exchange(std::move(settings));
  ASSERT_TRUE(sut->watch(0, exchange));
  steps(2);
  const auto first = exchange.gap();
  ASSERT_TRUE(first);
  g_new = g_old;
  steps(1);
  exchange.offer(*first);
  steps(1);
  EXPECT_EQ(exchange.step(), Step::Waiting) << "the copy is older than the last run";
  g_new = g_old;
  exchange.offer(*exchange.gap());
  steps(2);
  EXPECT_THAT(g_shown, ElementsAre(1, 2, 3, 4, -5, -6));
}

TEST_F(ModuleExchange, A_copy_counts_only_if_nothing_of_it_was_written_since) {
  std::atomic<std::uint64_t> version{7};
  Exchange::Settings settings = settings_of({});
  settings.offered = true;
  settings.versions = {{&version}};
  Exchange exchange(std::move(settings));
  ASSERT_TRUE(sut->watch(0, exchange));
  steps(1);
  std::uint64_t gap = *exchange.gap();
  exchange.note_versions();
  g_new = g_old;
  exchange.offer(gap);
  EXPECT_FALSE(exchange.withdraw(gap)) << "nothing was written";
  ++version;
  EXPECT_TRUE(exchange.withdraw(gap));
  EXPECT_FALSE(exchange.is_offered(gap)) << "it can be copied again in the same gap";
  steps(1);
  EXPECT_EQ(exchange.step(), Step::Waiting);
  gap = *exchange.gap();
  exchange.note_versions();
  exchange.offer(gap);
  ++version;
  steps(1);
  EXPECT_EQ(exchange.step(), Step::Waiting) << "the run that would take it notices that, too";
  gap = *exchange.gap();
  exchange.note_versions();
  g_new = g_old;
  exchange.offer(gap);
  steps(2);
  EXPECT_THAT(g_shown, ElementsAre(1, 2, 3, -4, -5));
}

TEST_F(ModuleExchange, A_stopped_module_gets_other_code) {
  ASSERT_TRUE(sut->disable(0));
  Exchange exchange(settings_of({}));
  EXPECT_FALSE(sut->watch(0, exchange));
  sut->replace_closed(0, {run_new, {}});
  steps(1);
  sut->enable(0);
  steps(2);
  EXPECT_THAT(g_shown, ElementsAre(-101, -102));
}

// The state machine against a plain model: a counter that never knows of versions.
TEST_F(ModuleExchange, Whatever_comes_when_the_counter_goes_on) {
  std::mt19937 random(5);  // NOLINT(cert-msc51-cpp): the same each time
  std::int64_t counted = 0;
  for (int round = 0; round < 2000; ++round) {
    const bool forward = round % 2 == 0;
    Exchange::Settings settings;
    settings.next.run = forward ? run_new : run_old;
    settings.pairs = {forward ? pair_of(g_old, g_new) : pair_of(g_new, g_old)};
    settings.earliest_tick = tick + random() % 4;
    Exchange exchange(std::move(settings));
    ASSERT_TRUE(sut->watch(0, exchange));
    for (std::size_t i = random() % 9; i > 0; --i) {
      steps(1);
      if (random() % 5 == 0) {
        (void)exchange.go_back(Exchange::Reason::Command);
      }
    }
    while (exchange.step() != Step::Done && exchange.step() != Step::Back) {
      steps(1);
    }
    ASSERT_TRUE(sut->unwatch(0));
    if (exchange.step() == Step::Back) {
      --round;  // the same version again
    }
  }
  for (const std::int64_t shown : g_shown) {
    ASSERT_EQ(std::abs(shown), ++counted);
  }
  EXPECT_EQ(record().runs.load(), tick);
}

}  // namespace
}  // namespace indurop::scheduler
