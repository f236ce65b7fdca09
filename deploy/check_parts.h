// SPDX-License-Identifier: Apache-2.0
// The parts check_config() is made of. Each looks at one side of the configuration and reports into the same list.

#pragma once

#include <string>
#include <vector>

#include "deploy/check.h"
#include "deploy/report.h"

namespace indurop::deploy {

struct CheckContext {
  Config& config;
  const CheckOptions& options;
  CheckResult& result;
  Report report;
};

// Basic and macro period, --adjust, number of bands. Fills table, periodic, sporadic, non_real.
void check_schedule(CheckContext& context);
// Cores of this machine. Only where the configuration is to run.
void check_machine(CheckContext& context);
// Files, ABI, symbols, agreement of variable layouts. Fills facts and schema.
void check_files(CheckContext& context);
// Who reads and writes which variable, order and age of data, fail-safe values. Fills uses. After the two above.
void check_access(CheckContext& context);

}  // namespace indurop::deploy
