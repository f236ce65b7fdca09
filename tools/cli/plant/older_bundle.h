// SPDX-License-Identifier: Apache-2.0
// Whether a bundle is older than what a board runs, by the order in which the board committed both.

#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tools/client/board/board_history.h"

namespace indurop::tools {

struct OlderBundle {
  PastDeployment bundle;   // when the board committed it first
  PastDeployment current;  // likewise
};

// Returns nothing if deployment `id` is not older than `current`: the board runs it, committed it first after what it
// runs, or does not remember it; or the board runs another plant. A rollback makes nothing newer: what was committed
// first before it counts.
std::optional<OlderBundle> older_bundle(const std::vector<PastDeployment>& history, const std::string& current,
                                        const std::string& id);

}  // namespace indurop::tools
