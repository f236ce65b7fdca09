// SPDX-License-Identifier: Apache-2.0
// The time of a tick in a recording, found without reading it from its beginning. Not real-time safe.

#pragma once

#include <cstdint>
#include <optional>

#include "history/recording/mcap_reader.h"

namespace indurop::recorder {

// Returns the log time of the first run of this tick or a later one; nullopt: there is none. `runs`: the channel of the
// runs. Reads some chunks; the reader's next() is not affected.
std::optional<std::uint64_t> time_of_tick(const recording::McapReader& reader, std::uint16_t runs, std::uint64_t tick);

}  // namespace indurop::recorder
