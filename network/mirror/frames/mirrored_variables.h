// SPDX-License-Identifier: Apache-2.0
// The variables that a board reads from other boards, and their age: its mirror lists the variables, its store has the
// time when their owner last confirmed them. Reads from outside, so tools and agents can use it; no DDS here.

#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/rt/clock.h"
#include "network/mirror/frames/mirror_block.h"

namespace indurop::mirror {

struct MirroredVariable {
  std::string name;
  std::string owner;         // board
  std::int64_t age_ns = -1;  // since the owner last confirmed the value, changed or not; negative: it never did
  bool valid = false;
  bool leads = false;  // its owner is alive and serves longest of the boards that send the variable (<standby>)
};

// Returns one entry for each variable and each board that sends it. `node`: the board to which this mirror block
// belongs. Empty if it has no store. Not real-time safe.
std::vector<MirroredVariable> mirrored_variables(const std::string& node, const MirrorBlock& block, rt::MonoTime now);

}  // namespace indurop::mirror
