// SPDX-License-Identifier: Apache-2.0
// The tracks of a node's tape on which a variable is known best.

#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "store/tape/follower.h"
#include "tools/client/node/run_view.h"

namespace indurop::tools {

// Period in ns at which a module's track is written; INT64_MAX without a rate of its own.
std::int64_t track_period(const RunView& run, std::uint32_t module);

// Returns the tracks of the modules that write the variable (its index in the store's directory); if there are none,
// that of the reader that runs most often. Empty: the variable is on no track.
std::vector<std::size_t> known_tracks(const tape::Follower& follower, const RunView& run, std::uint32_t variable);

}  // namespace indurop::tools
