// SPDX-License-Identifier: Apache-2.0
// Captures the log messages of Cyclone DDS instead of printing them to stderr: any thread may log the same message a
// thousand times a second.

#pragma once

#include <cstdint>
#include <string>

namespace indurop::dds {

// From now on all DDS messages in this process are counted and the last one is kept. May be called repeatedly.
void catch_dds_log();
// Returns the last message, one line without DDS's own prefix; empty if there was none. Thread safe, not real-time
// safe.
std::string last_dds_message();
// Returns the last message that states why two participants with keys reject each other; empty: none.
std::string last_refusal();
std::uint64_t dds_message_count() noexcept;
// Returns the number of samples that were dropped because their bytes are no value of their type.
std::uint64_t unreadable_samples() noexcept;

}  // namespace indurop::dds
