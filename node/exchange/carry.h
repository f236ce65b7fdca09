// SPDX-License-Identifier: Apache-2.0
// What goes from one version of a module to the next: variables of the same name and type, as they declare them
// (<indurop/state.h>).

#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "node/modules/module_memory.h"
#include "scheduler/exchange.h"
#include "store/operate/reload.h"

namespace indurop::node {

// Maximum number of bytes that are copied in a tick, for a module of this period (ns; 0: it is not periodic): what
// takes a hundredth of it, at 5 bytes in a nanosecond. More is copied between two runs, on a normal thread.
std::size_t most_in_tick(std::int64_t period_ns) noexcept;
inline constexpr std::size_t kMostInTick = std::size_t{64} * 1024;  // whatever the period

struct Carry {
  operate::ReloadPlan plan;
  std::vector<scheduler::Exchange::Pair> pairs;  // adjacent variables are one pair
  bool between_runs = false;                     // a normal thread copies, by ModuleMemory
  bool loses = false;                            // values are lost that the new version needs
  void carry_between_runs() {
    between_runs = true;
    pairs.clear();
  }
};

// Compares what both keep. The pairs have the addresses of both. `most`: what may be copied in a tick.
Carry plan_carry(const ModuleMemory& from, const ModuleMemory& to, std::size_t most = kMostInTick);

// The same for two processes, by the forms of their keyframes; nullopt: it declares nothing. There are no pairs.
Carry plan_carry(const std::optional<std::string>& from, const std::optional<std::string>& to);

}  // namespace indurop::node
