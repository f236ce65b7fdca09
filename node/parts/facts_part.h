// SPDX-License-Identifier: Apache-2.0
// Facts about this node in addition to its runs and values, as a text for its recordings.

#pragma once

#include <string>

#include "network/mirror/frames/mirror_block.h"
#include "node/run/options.h"
#include "node/run/prepared.h"

namespace indurop::node {

// `boards`: null if there are none.
std::string facts_text(const Options& options, const Prepared& prepared, const mirror::MirrorBlock* boards,
                       const std::string& stop_reason);

}  // namespace indurop::node
