// SPDX-License-Identifier: Apache-2.0
// What a board's node reads from other boards and how old it is, as JSON for tools elsewhere (docs/cli.md).

#pragma once

#include <string>

namespace indurop::deploy {

// An empty list if no node of this board runs, or it is no board of a plant.
std::string mirror_text(const std::string& board);

}  // namespace indurop::deploy
