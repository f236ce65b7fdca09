// SPDX-License-Identifier: Apache-2.0
// Facts of a run block and of a mirror's block. Of the run block nothing is believed; the mirror's was checked before
// and does not change.

#pragma once

#include "explain/facts.h"
#include "mirror/frames/mirror_block.h"
#include "scheduler/run_block.h"

namespace indurop::explain {

// Modules, figures, overruns; `with_runs`: also the runs that the slot log holds. `size`: bytes of the block. What does
// not add up is left out.
Facts facts_of(const scheduler::RunBlock& block, std::uint64_t size, bool with_runs);
// Numbers that no node has become such that sums and products of them fit; for facts whose source may be damaged.
void make_sound(Facts& facts) noexcept;
void add_boards(const mirror::MirrorBlock& mirror, Facts& facts);

}  // namespace indurop::explain
