// SPDX-License-Identifier: Apache-2.0
// Tick threads without a clock against a thread that proposes ticks they are about to begin.

#include "scheduler/change_proposal.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <random>
#include <thread>

namespace indurop::scheduler {
namespace {

constexpr std::uint64_t kNever = ~std::uint64_t{0};

struct Core {
  std::atomic<std::uint64_t> begun{0};
  std::uint64_t changed_at = kNever;  // the tick that it learnt
  std::uint64_t changed_in = kNever;  // the tick in which it learnt that

  void tick(ChangeProposal& sut, std::uint64_t tick) {
    begun.store(tick + 1, std::memory_order_seq_cst);
    if (sut.is_there() && changed_at == kNever) {
      if (const auto first = sut.due(tick)) {
        changed_at = *first;
        changed_in = tick;
      }
    }
  }
};

TEST(ChangeProposal, All_cores_change_in_the_same_tick_or_none_does) {
  std::minstd_rand random(1);
  int accepted = 0;
  for (int round = 0; round < 400; ++round) {
    ChangeProposal sut;
    std::array<Core, 3> cores;
    std::atomic<bool> stop{false};
    std::array<std::thread, 3> threads;
    for (std::size_t i = 0; i < cores.size(); ++i) {
      threads[i] = std::thread([&core = cores[i], &sut, &stop] {
        for (std::uint64_t tick = 0; !stop; ++tick) {
          core.tick(sut, tick);
        }
      });
    }
    const auto newest = [&cores] {
      return std::max({cores[0].begun.load(), cores[1].begun.load(), cores[2].begun.load()});
    };
    const auto oldest = [&cores] {
      return std::min({cores[0].begun.load(), cores[1].begun.load(), cores[2].begun.load()});
    };
    while (oldest() < 100) {
      std::this_thread::yield();
    }
    const std::uint64_t tick = newest() + random() % 100'000;
    sut.propose({tick, 1, tick});
    const bool early = newest() <= tick;
    const bool counts = early && sut.confirm();
    if (!counts) {
      sut.take_back();
    }
    while (oldest() < tick + 2) {
      std::this_thread::yield();
    }
    stop = true;
    for (std::thread& thread : threads) {
      thread.join();
    }
    for (const Core& core : cores) {
      EXPECT_EQ(core.changed_at, counts ? tick : kNever) << "round " << round;
      EXPECT_EQ(core.changed_in, counts ? tick : kNever) << "round " << round;
    }
    accepted += counts ? 1 : 0;
  }
  EXPECT_GT(accepted, 0);
}

TEST(ChangeProposal, A_core_that_begins_the_tick_refuses_what_is_not_confirmed) {
  ChangeProposal sut;
  sut.propose({10, 1, 10});
  EXPECT_FALSE(sut.due(9));
  EXPECT_FALSE(sut.due(10));
  EXPECT_FALSE(sut.confirm());
  EXPECT_FALSE(sut.is_there());
}

TEST(ChangeProposal, Is_postponed_in_steps_until_the_last_tick) {
  ChangeProposal sut;
  sut.propose({10, 4, 18});
  ASSERT_TRUE(sut.confirm());
  EXPECT_EQ(sut.due(10), 10U);
  sut.postpone(10);
  EXPECT_FALSE(sut.due(13));
  EXPECT_EQ(sut.due(15), 14U);  // tick 14 was lost
  sut.postpone(15);
  EXPECT_EQ(sut.due(18), 18U);
  sut.postpone(18);
  EXPECT_FALSE(sut.is_there());
}

}  // namespace
}  // namespace indurop::scheduler
