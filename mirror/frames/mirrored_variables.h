// SPDX-License-Identifier: Apache-2.0
// What a board reads from the others and how old it is: its mirror shows which variables, its store holds when their
// owner last confirmed them. Looks from outside, so tools and agents can; no DDS here.

#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "mirror/frames/mirror_block.h"
#include "rt/clock.h"

namespace indurop::mirror {

struct MirroredVariable {
  std::string name;
  std::string owner;         // board
  std::int64_t age_ns = -1;  // since the owner last confirmed the value, changed or not; negative: it never did
  bool valid = false;
  bool leads = false;  // its owner is alive and, of several boards that send the variable (<standby>), serves longest
};

// One for each variable and each board that sends it. `node`: the board, whose mirror's block this is. Empty if it has
// no store. Not real-time safe.
std::vector<MirroredVariable> mirrored_variables(const std::string& node, const MirrorBlock& block, rt::MonoTime now);

}  // namespace indurop::mirror
