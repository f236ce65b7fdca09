// SPDX-License-Identifier: Apache-2.0
// What the code of bodies tells beside what it does; null: nothing.

#pragma once

#include "plc/emit/coverage_table.h"
#include "plc/emit/debug_table.h"

namespace indurop::plc {

struct Probes {
  DebugTable* debug = nullptr;        // statements tell a debugger where they are; the table gets their numbers
  CoverageTable* coverage = nullptr;  // statements are counted; the table gets what is counted
};

}  // namespace indurop::plc
