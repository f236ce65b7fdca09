// SPDX-License-Identifier: Apache-2.0
// Messages of a replay at its end: what differed, and what could not be compared and why.

#pragma once

#include <cstdint>

#include "node/replay/comparison.h"
#include "node/replay/replayed_modules.h"
#include "node/run/console.h"
#include "node/run/ending.h"
#include "node/run/options.h"

namespace indurop::node {

// How much of a recording was repeated.
struct Repeated {
  std::uint64_t ticks = 0;
  std::uint64_t runs = 0;
  std::uint64_t runs_not_here = 0;  // of modules that are not in the configuration
  bool damaged = false;             // parts of the recording could not be read
  bool closed = false;              // the recording is complete
};

// Prints the outcome and returns how the replay ends.
Ending conclude(const config::Replay& replay, const ReplayedModules& modules, const Comparison& comparison,
                const Repeated& repeated, const vars::Store& store, const Console& console);

}  // namespace indurop::node
