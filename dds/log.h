// SPDX-License-Identifier: Apache-2.0
// What Cyclone DDS has to say goes here instead of to stderr: it can say the same thing a thousand times a second from
// whatever thread calls it.

#pragma once

#include <cstdint>
#include <string>

namespace indurop::dds {

// From now on all messages of DDS in this process are counted and the last one is kept. Any number of times.
void catch_dds_log();
// The last message, one line without DDS's own prefix; empty if there was none. Thread safe, not real-time safe.
std::string last_dds_message();
// The last one that says why two participants with keys do not let each other in; empty: none.
std::string last_refusal();
std::uint64_t dds_message_count() noexcept;

}  // namespace indurop::dds
