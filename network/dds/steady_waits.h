// SPDX-License-Identifier: Apache-2.0
// Cyclone DDS waits by the wall clock: when that is set back, its thread for timed events (heartbeats, leases, answers
// to newcomers) sleeps that much longer, and the board is silent meanwhile. Programs that link network/dds/ wait by
// CLOCK_MONOTONIC instead: they define the two functions that Cyclone waits with.

#pragma once

namespace indurop::dds {

// Returns true if Cyclone waits with the functions of this program. The call also links them into the program.
bool waits_are_steady() noexcept;

}  // namespace indurop::dds
