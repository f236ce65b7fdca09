// SPDX-License-Identifier: Apache-2.0
// States of an alarm and what leads from one to the other, as in the alarm state transition diagram of ISA-18.2 and
// IEC 62682, without latching, suppression by design and out of service. Pure.

#pragma once

#include <optional>
#include <string_view>

namespace indurop::alarms {

enum class AlarmState { Normal, Unacknowledged, Acknowledged, Returned, Shelved };
// Returned: the condition is over, and nobody has acknowledged that it was there.

enum class AlarmEvent { Raised, Cleared, Acknowledged, Shelved, Unshelved, Removed };

// Nothing: the event means nothing in this state.
std::optional<AlarmState> after(AlarmState state, AlarmEvent event) noexcept;

const char* word_of(AlarmState state) noexcept;  // "returned"
const char* word_of(AlarmEvent event) noexcept;  // "raised"
std::optional<AlarmState> alarm_state_of(std::string_view word) noexcept;
std::optional<AlarmEvent> alarm_event_of(std::string_view word) noexcept;

// Somebody has to look at it.
bool wants_attention(AlarmState state) noexcept;
// The condition is there, as far as this tells.
bool is_active(AlarmState state) noexcept;

}  // namespace indurop::alarms
