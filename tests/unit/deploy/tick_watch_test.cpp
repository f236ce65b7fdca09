// SPDX-License-Identifier: Apache-2.0
#include "deploy/agent/tick_watch.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <cstring>
#include <memory>

#include "scheduler/run_block_setup.h"

namespace indurop::deploy {
namespace {

using namespace std::chrono_literals;

class TickWatchTest : public testing::Test {
 protected:
  TickWatchTest() {
    scheduler::RunBlockSetup setup;
    setup.node_name = "a";
    setup.basic_period_ns = 1'000'000;
    setup.macro_period_ns = 1'000'000;
    setup.slot_count = 1;
    scheduler::ModuleSetup module;
    module.name = "m";
    module.period_ns = 1'000'000;
    module.budget_ns = 10'000'000;
    setup.modules.push_back(module);
    const std::size_t bytes = (scheduler::run_block_size(setup) + 63) / 64 * 64;
    block_.reset(static_cast<scheduler::RunBlock*>(std::aligned_alloc(64, bytes)));
    std::memset(static_cast<void*>(block_.get()), 0, bytes);
    scheduler::init_run_block(*block_, setup);
    block_->state = scheduler::NodeState::Running;
  }
  // For how long the tick stood when that was found; 0 if it is not in `most`.
  std::chrono::nanoseconds found_after(std::chrono::nanoseconds most, std::chrono::nanoseconds step) {
    for (const rt::MonoTime end = now_ + most; now_ < end; now_ += step) {
      if (const auto stood = sut_.check(*block_, now_)) {
        return *stood;
      }
    }
    return {};
  }
  struct Free {
    void operator()(scheduler::RunBlock* block) const noexcept { std::free(block); }  // NOLINT: of aligned_alloc
  };
  std::unique_ptr<scheduler::RunBlock, Free> block_;
  TickWatch sut_;
  rt::MonoTime now_ = rt::mono_time(1'000'000'000);
};

TEST_F(TickWatchTest, A_tick_that_stands_is_found_after_the_patience) {
  const auto stood = found_after(10s, 20ms);
  EXPECT_GT(stood, TickWatch::kPatience);
  EXPECT_LT(stood, TickWatch::kPatience + 100ms);
}

TEST_F(TickWatchTest, A_tick_that_moves_now_and_then_is_well) {
  for (int i = 0; i < 5; ++i) {
    EXPECT_EQ(found_after(2900ms, 20ms), 0s);
    ++block_->tick;
  }
}

TEST_F(TickWatchTest, Slow_schedules_have_their_time) {
  block_->basic_period_ns = 10'000'000'000;
  EXPECT_EQ(found_after(32s, 20ms), 0s);
  EXPECT_GT(found_after(3s, 20ms), 32s);
}

TEST_F(TickWatchTest, Time_without_polls_does_not_count) {
  EXPECT_EQ(found_after(1s, 20ms), 0s);
  now_ += 3600s;
  EXPECT_EQ(found_after(1s, 20ms), 0s);
}

TEST_F(TickWatchTest, Only_a_node_that_should_run_is_judged) {
  block_->state = scheduler::NodeState::Stopping;
  EXPECT_EQ(found_after(60s, 20ms), 0s);
}

TEST_F(TickWatchTest, A_module_without_a_budget_may_take_its_time) {
  block_->modules()[0].budget_ns = 0;
  EXPECT_EQ(found_after(60s, 20ms), 0s);
}

}  // namespace
}  // namespace indurop::deploy
