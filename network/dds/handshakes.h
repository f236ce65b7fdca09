// SPDX-License-Identifier: Apache-2.0
// Cyclone DDS 0.10.2 gives up a handshake that is not done within 100 s of the wall clock, and damages its list of
// timers by that: the program crashes, or lets no newcomer in any more. Programs that link network/dds/ set no such
// limit: the handshake is repeated until it succeeds, is refused, or the other participant is gone.

#pragma once

namespace indurop::dds {

// Returns true if Cyclone uses the function of this program. The call also links it into the program.
bool handshakes_are_unlimited() noexcept;

}  // namespace indurop::dds
