// SPDX-License-Identifier: Apache-2.0
// indurop reload --config: another schedule takes over while the node runs.

#pragma once

#include <cstdint>
#include <string>

#include "tools/cli/command/verb.h"

namespace indurop::tools {

struct ScheduleOptions {
  std::string config;  // empty: the schedule before
  bool dry_run = false;
  std::int64_t timeout_ns = 0;
};

// Returns the exit code.
int reload_schedule(Context& context, const ScheduleOptions& options);

}  // namespace indurop::tools
