// SPDX-License-Identifier: Apache-2.0
// The part that touches iceoryx: reads the store and publishes what changed. Runs in a process of its own, because a
// call of iceoryx may abort or never return when another program was killed in the wrong moment.

#pragma once

#include "tools/values/watch_source.h"

namespace indurop::iceoryx {

// iceoryx's limits for all programs of a machine together and for a name.
std::size_t most_topics() noexcept;
std::size_t longest_name() noexcept;

// Publishes until a signal asks to stop, at most `hz` times per second. RouDi must run. A process in which iceoryx does
// not return for this long is ended by SIGALRM.
inline constexpr unsigned kStuckSeconds = 5;
int publish(tools::Context& context, tools::WatchSource& source, int hz);

}  // namespace indurop::iceoryx
