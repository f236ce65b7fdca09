// SPDX-License-Identifier: Apache-2.0
#include "history/alarms/alarm_state.h"

#include <algorithm>
#include <array>
#include <cstddef>

namespace indurop::alarms {
namespace {

constexpr std::array<const char*, 5> kStates{"normal", "unacknowledged", "acknowledged", "returned", "shelved"};
static_assert(kStates.size() == static_cast<std::size_t>(AlarmState::Shelved) + 1);
constexpr std::array<const char*, 6> kEvents{"raised", "cleared", "acknowledged", "shelved", "unshelved", "removed"};
static_assert(kEvents.size() == static_cast<std::size_t>(AlarmEvent::Removed) + 1);

template <class Value, std::size_t kCount>
std::optional<Value> find(const std::array<const char*, kCount>& words, std::string_view word) noexcept {
  const auto* const found = std::find(words.begin(), words.end(), word);
  return found == words.end() ? std::nullopt : std::optional(static_cast<Value>(found - words.begin()));
}

}  // namespace

std::optional<AlarmState> after(AlarmState state, AlarmEvent event) noexcept {
  switch (event) {
    case AlarmEvent::Raised:
      return state == AlarmState::Normal || state == AlarmState::Returned ? std::optional(AlarmState::Unacknowledged)
                                                                          : std::nullopt;
    case AlarmEvent::Cleared:
      return state == AlarmState::Unacknowledged ? std::optional(AlarmState::Returned)
             : state == AlarmState::Acknowledged ? std::optional(AlarmState::Normal)
                                                 : std::nullopt;
    case AlarmEvent::Acknowledged:
      return state == AlarmState::Unacknowledged ? std::optional(AlarmState::Acknowledged)
             : state == AlarmState::Returned     ? std::optional(AlarmState::Normal)
                                                 : std::nullopt;
    case AlarmEvent::Shelved:
      return AlarmState::Shelved;  // shelved again, with a new duration
    case AlarmEvent::Unshelved:
      return state == AlarmState::Shelved ? std::optional(AlarmState::Normal) : std::nullopt;
    case AlarmEvent::Removed:
      return state == AlarmState::Normal ? std::nullopt : std::optional(AlarmState::Normal);
  }
  return std::nullopt;
}

const char* word_of(AlarmState state) noexcept {
  return kStates.at(static_cast<std::size_t>(state));
}

const char* word_of(AlarmEvent event) noexcept {
  return kEvents.at(static_cast<std::size_t>(event));
}

std::optional<AlarmState> alarm_state_of(std::string_view word) noexcept {
  return find<AlarmState>(kStates, word);
}

std::optional<AlarmEvent> alarm_event_of(std::string_view word) noexcept {
  return find<AlarmEvent>(kEvents, word);
}

bool wants_attention(AlarmState state) noexcept {
  return state == AlarmState::Unacknowledged || state == AlarmState::Returned;
}

bool is_active(AlarmState state) noexcept {
  return state == AlarmState::Unacknowledged || state == AlarmState::Acknowledged;
}

}  // namespace indurop::alarms
