// SPDX-License-Identifier: Apache-2.0
// The variables that a board's node reads from other boards, and their age, as JSON for remote tools (docs/cli.md).

#pragma once

#include <string>

namespace indurop::deploy {

// Returns an empty list if no node of this board runs, or it belongs to no plant.
std::string mirror_text(const std::string& board);

}  // namespace indurop::deploy
