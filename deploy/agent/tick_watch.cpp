// SPDX-License-Identifier: Apache-2.0
#include "deploy/agent/tick_watch.h"

#include <algorithm>

namespace indurop::deploy {
namespace {

// Maximum that counts of the time between two checks: the agent checks every 20 ms when it can.
constexpr std::chrono::milliseconds kMaxBetweenChecks{100};

bool may_take_its_time(const scheduler::RunBlock& block) {
  for (std::uint32_t i = 0; i < block.module_count; ++i) {
    const scheduler::ModuleRecord& module = block.modules()[i];
    if (module.type == scheduler::ModuleType::Thread && module.operation != scheduler::Operation::NonReal &&
        module.budget_ns == 0) {
      return true;
    }
  }
  return false;
}

}  // namespace

std::optional<std::chrono::nanoseconds> TickWatch::check(const scheduler::RunBlock& block, rt::MonoTime now) {
  const std::uint64_t tick = block.tick.load();
  const bool runs = block.state.load() == scheduler::NodeState::Running;
  const std::chrono::nanoseconds since = std::min<std::chrono::nanoseconds>(now - checked_, kMaxBetweenChecks);
  checked_ = now;
  if (!runs || seen_ != tick) {
    seen_ = tick;
    stood_ = {};
    return std::nullopt;
  }
  stood_ += since;
  const std::chrono::nanoseconds most = kPatience + 3 * std::chrono::nanoseconds(block.basic_period_ns);
  return stood_ > most && !may_take_its_time(block) ? std::optional(stood_) : std::nullopt;
}

}  // namespace indurop::deploy
