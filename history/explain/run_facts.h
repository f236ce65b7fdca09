// SPDX-License-Identifier: Apache-2.0
// The facts from a run block and from a mirror's block. Nothing in the run block is trusted; the mirror's block was
// checked before and does not change.

#pragma once

#include "history/explain/facts.h"
#include "network/mirror/frames/mirror_block.h"
#include "scheduler/run_block.h"

namespace indurop::explain {

// Reads modules, counters and overruns; `with_runs`: also the runs in the slot log. `size`: bytes of the block.
// Inconsistent data is left out.
Facts facts_of(const scheduler::RunBlock& block, std::uint64_t size, bool with_runs);
// Limits numbers beyond what any node reaches, such that sums and products do not overflow; for facts from a source
// that may be damaged.
void make_sound(Facts& facts) noexcept;
void add_boards(const mirror::MirrorBlock& mirror, Facts& facts);

}  // namespace indurop::explain
