// SPDX-License-Identifier: Apache-2.0
// Facts of a run block and of a mirror's block. What they say was checked before: offsets lead inside.

#pragma once

#include "explain/facts.h"
#include "mirror/frames/mirror_block.h"
#include "scheduler/run_block.h"

namespace indurop::explain {

// Modules, figures, overruns; `with_runs`: also the runs that the slot log holds.
Facts facts_of(const scheduler::RunBlock& block, bool with_runs);
void add_boards(const mirror::MirrorBlock& mirror, Facts& facts);

}  // namespace indurop::explain
