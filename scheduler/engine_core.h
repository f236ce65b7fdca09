// SPDX-License-Identifier: Apache-2.0
// What an engine keeps for each core.

#pragma once

#include <atomic>
#include <cstdint>
#include <optional>

#include "scheduler/engine.h"

namespace indurop::scheduler {

struct Engine::Core {
  int number = 0;
  bool primary = false;
  CoreTrace trace;
  // For its tick thread.
  const Schedule::CoreBands* bands = nullptr;  // of the schedule that counts
  const Schedule::CoreBands* next = nullptr;   // of the one that was prepared last
  std::optional<ModuleThread> thread;          // while it runs
  std::atomic<std::uint64_t> begun{0};         // number of its last tick + 1
  std::atomic<bool> follows{false};            // it has taken over `next`
};

}  // namespace indurop::scheduler
