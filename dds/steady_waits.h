// SPDX-License-Identifier: Apache-2.0
// Cyclone DDS waits by the clock of the wall: where that is put back, its thread for timed events (heartbeats, leases,
// answers to newcomers) sleeps that much longer, and the board is not heard meanwhile. Programs that link this room
// wait by CLOCK_MONOTONIC instead: they define the two functions that Cyclone waits with.

#pragma once

namespace indurop::dds {

// True if Cyclone waits with the functions of this program. Calling it also brings them into the program.
bool waits_are_steady() noexcept;

}  // namespace indurop::dds
