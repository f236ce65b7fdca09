// SPDX-License-Identifier: Apache-2.0
// A schedule in virtual time with a fault at a known place, and what is known of it afterwards.

#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "history/explain/facts.h"
#include "scheduler/task.h"

namespace indurop::explain {

inline constexpr std::int64_t kBasic = 1'000'000;
inline constexpr std::uint64_t kTicks = 120;

// What is wrong.
struct Injection {
  enum class What { Nothing, Longer, Throws, Event, MachineStands, Stopped, PageFault };
  What what = What::Nothing;
  std::uint32_t module = 0;
  std::uint64_t tick = 0;   // its first run from here on
  std::int64_t for_ns = 0;  // how much longer
  std::string by;           // who stops it
};

struct Random {
  std::mt19937 engine;
  int upto(int least, int most) { return std::uniform_int_distribution(least, most)(engine); }
};

// A few modules of various periods that fit well, on one or two cores. The last one is sporadic and runs after the
// base.
std::vector<scheduler::Task> random_schedule(Random& random);

// Runs it; `name_of` a module is "m0", "m1", ...
Facts run_schedule(const std::vector<scheduler::Task>& given, const Injection& injection);

}  // namespace indurop::explain
