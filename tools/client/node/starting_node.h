// SPDX-License-Identifier: Apache-2.0
// A node that was started a moment ago has no shared memory yet. A user who types `indurop run ... &` and then `indurop
// status` expects that node, so verbs wait for it.

#pragma once

#include <cstdint>

#include "core/rt/clock.h"
#include "tools/client/process/interrupt.h"

namespace indurop::tools {

// Returns true if a process that is to become a node started less than two seconds ago. Reads /proc.
[[nodiscard]] bool node_is_starting();

// Calls `attempt` again and again until it returns true or no node is starting.
template <class Attempt>
void while_starting(Attempt attempt) {
  constexpr std::int64_t kPauseNs = 20'000'000;
  while (!attempt() && node_is_starting() && wait_until(rt::now_ns() + kPauseNs) == Woken::Deadline) {
  }
}

}  // namespace indurop::tools
