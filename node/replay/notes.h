// SPDX-License-Identifier: Apache-2.0
// Messages of a replay before it begins: which settings of this configuration it ignores, and what the recording lacks.

#pragma once

#include "history/explain/facts.h"
#include "node/replay/recorded_runs.h"
#include "node/replay/replayed_modules.h"
#include "node/run/checked.h"
#include "node/run/console.h"

namespace indurop::node {

void print_notes(const Checked& checked, const ReplayedModules& modules, const RecordedRuns& recorded,
                 const explain::Facts& facts, const Console& console);

}  // namespace indurop::node
