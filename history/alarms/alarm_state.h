// SPDX-License-Identifier: Apache-2.0
// The states of an alarm and the transitions between them, as in the alarm state transition diagram of ISA-18.2 and IEC
// 62682, without latching, suppression by design and out of service. Pure.

#pragma once

#include <optional>
#include <string_view>

namespace indurop::alarms {

enum class AlarmState { Normal, Unacknowledged, Acknowledged, Returned, Shelved };
// Returned: the condition is over, but no user has acknowledged it.

enum class AlarmEvent { Raised, Cleared, Acknowledged, Shelved, Unshelved, Removed };

// Returns nothing if the event has no meaning in this state.
std::optional<AlarmState> after(AlarmState state, AlarmEvent event) noexcept;

const char* word_of(AlarmState state) noexcept;  // "returned"
const char* word_of(AlarmEvent event) noexcept;  // "raised"
std::optional<AlarmState> alarm_state_of(std::string_view word) noexcept;
std::optional<AlarmEvent> alarm_event_of(std::string_view word) noexcept;

// Returns whether the alarm needs a user's attention.
bool wants_attention(AlarmState state) noexcept;
// Returns whether the condition is present, as far as the state shows.
bool is_active(AlarmState state) noexcept;

}  // namespace indurop::alarms
