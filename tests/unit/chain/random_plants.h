// SPDX-License-Identifier: Apache-2.0
// Random boards, what their modules do in virtual time, and random chains over them.

#pragma once

#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <optional>
#include <random>
#include <vector>

#include "config/check/chain_age.h"
#include "scheduler/simulated_kernel.h"
#include "tests/unit/scheduler/fixture.h"

namespace indurop::config {

using base::Nanos;

inline constexpr std::int64_t kBasic = 1'000'000;
inline constexpr std::uint64_t kTicks = 240;

struct Random {
  std::mt19937 engine;
  int upto(int least, int most) { return std::uniform_int_distribution(least, most)(engine); }
};

struct Run {
  std::int64_t release = 0;
  std::int64_t start = 0;
  std::int64_t end = 0;
};
using Runs = std::vector<std::vector<Run>>;  // by module

struct World {
  Runs runs;
  bool overrun = false;
};

// One board alone: values do not change when its modules run. Nothing if one does not end before its next release.
inline std::optional<Runs> run(const std::vector<Timed>& board) {
  std::vector<scheduler::Task> tasks;
  for (std::size_t i = 0; i < board.size(); ++i) {
    scheduler::Task task = scheduler::periodic(
        static_cast<std::uint32_t>(i), board[i].period.count(), static_cast<int>(i) + 1, +[] {});
    task.offset_ns = board[i].offset.count();
    task.work_ns = board[i].execution.count();
    tasks.push_back(task);
  }
  const scheduler::BlockPointer block = scheduler::make_block(tasks, kBasic, 10 * kBasic);
  World world{Runs(board.size()), false};
  scheduler::Hooks hooks;
  hooks.context = &world;
  hooks.ended = [](void* context, std::uint32_t module, std::uint64_t, const scheduler::RunTimes& times,
                   bool) noexcept {
    static_cast<World*>(context)->runs[module].push_back({times.release_ns, times.start_ns, times.end_ns});
    return false;
  };
  scheduler::EngineSettings settings;
  settings.basic_period_ns = kBasic;
  settings.spin.mode = scheduler::SpinMode::Off;
  settings.order = scheduler::CoreOrder::Data;
  scheduler::SimulatedKernel kernel(rt::mono_time(kBasic), {}, {});
  scheduler::Engine engine(*block, tasks, settings, hooks, kernel);
  EXPECT_TRUE(engine.start(kTicks).ok());
  engine.join();
  for (std::size_t i = 0; i < board.size(); ++i) {
    if (block->modules()[i].overruns.load() + block->modules()[i].skipped.load() > 0) {
      return std::nullopt;
    }
    for (Run& one : world.runs[i]) {
      one = {one.release - block->epoch_ns, one.start - block->epoch_ns, one.end - block->epoch_ns};
    }
  }
  return world.runs;
}

inline std::vector<Timed> random_board(Random& random, int modules) {
  std::vector<Timed> board;
  for (int i = 0; i < modules; ++i) {
    Timed one;
    one.period = Nanos(kBasic * std::array{1, 1, 2, 5, 10}.at(static_cast<std::size_t>(random.upto(0, 4))));
    one.offset = random.upto(0, 2) == 0 ? Nanos(kBasic * random.upto(0, 9)) % one.period : Nanos{};
    one.execution = one.period * random.upto(10, 150) / 100 / modules;
    board.push_back(one);
  }
  return board;
}

inline std::vector<ChainLink> random_chain(Random& random, const std::vector<std::vector<Timed>>& plant) {
  std::vector<ChainLink> links;
  const int length = random.upto(2, 6);
  std::size_t board = static_cast<std::size_t>(random.upto(0, static_cast<int>(plant.size()) - 1));
  for (int i = 0; i < length; ++i) {
    if (random.upto(0, 2) == 0) {
      board = static_cast<std::size_t>(random.upto(0, static_cast<int>(plant.size()) - 1));
    }
    const auto module = static_cast<std::size_t>(random.upto(0, static_cast<int>(plant[board].size()) - 1));
    const bool again = std::any_of(links.begin(), links.end(),
                                   [&](const ChainLink& one) { return one.board == board && one.module == module; });
    if (!again) {
      links.push_back({board, module, {}});
    }
  }
  return links;
}

}  // namespace indurop::config
