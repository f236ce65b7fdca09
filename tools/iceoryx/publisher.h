// SPDX-License-Identifier: Apache-2.0
// The part that calls iceoryx: reads the store and publishes changed values. Runs in its own process, because a call of
// iceoryx may abort or never return if another program was killed at the wrong moment.

#pragma once

#include "tools/client/values/watch_source.h"
#include "tools/console/context.h"

namespace indurop::iceoryx {

// iceoryx's limits: topics of all programs of a machine together, length of a name.
std::size_t most_topics() noexcept;
std::size_t longest_name() noexcept;

// Publishes until a signal requests the end, at most `hz` times per second. RouDi must run. SIGALRM ends a process in
// which iceoryx does not return for this long.
inline constexpr unsigned kStuckSeconds = 5;
int publish(tools::Context& context, tools::WatchSource& source, int hz);

}  // namespace indurop::iceoryx
