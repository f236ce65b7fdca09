// SPDX-License-Identifier: Apache-2.0
// Instrumentation in the code of bodies; null: none.

#pragma once

#include "control/plc/emit/coverage_table.h"
#include "control/plc/emit/debug_table.h"

namespace indurop::plc {

struct Probes {
  DebugTable* debug = nullptr;        // statements report their position to a debugger; receives their numbers
  CoverageTable* coverage = nullptr;  // statements are counted; receives the meaning of the counters
};

}  // namespace indurop::plc
