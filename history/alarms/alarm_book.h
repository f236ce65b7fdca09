// SPDX-License-Identifier: Apache-2.0
// The events of alarms, entry by entry, and the resulting state of each. Knows no file and no clock.

#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "core/base/json.h"
#include "core/schema/schema.h"
#include "history/alarms/alarm_state.h"

namespace indurop::alarms {

// A line of the history. `state` instead of `event`: the state of an alarm when the history was cut.
struct AlarmEntry {
  std::int64_t wall_ns = 0;
  std::string alarm;  // "press::oil > 80"
  std::optional<AlarmEvent> event;
  std::optional<AlarmState> state;
  std::string text;
  schema::Priority priority = schema::Priority::Medium;
  std::string value;  // when it was raised
  std::string who;    // the user, for user actions
  std::string from;   // address
  std::string reason;
  std::int64_t until_ns = 0;  // end of shelving, CLOCK_REALTIME
  std::uint64_t count = 0;    // with a state: number of times it was raised
};
base::Json json_of(const AlarmEntry& entry);
std::optional<AlarmEntry> parse_alarm_line(std::string_view line);

struct AlarmRecord {
  AlarmState state = AlarmState::Normal;
  std::int64_t since_ns = 0;  // begin of the state, CLOCK_REALTIME
  std::uint64_t count = 0;    // number of times it was raised
  AlarmEntry last;
};

// The counts for a headline.
struct AlarmCounts {
  std::size_t active = 0;
  std::size_t unacknowledged = 0;  // active or returned
  std::size_t shelved = 0;
  std::optional<schema::Priority> worst;  // highest of those that want attention or are active
  bool operator==(const AlarmCounts&) const = default;
};

class AlarmBook {
 public:
  // Entries without a meaning in the alarm's state change nothing: two users may have acted at the same time.
  void add(const AlarmEntry& entry);
  // Returns a Normal record for an unknown alarm.
  [[nodiscard]] AlarmRecord find(std::string_view alarm) const;
  // All alarms that are not normal, by name.
  [[nodiscard]] const std::map<std::string, AlarmRecord, std::less<>>& standing() const noexcept { return standing_; }
  [[nodiscard]] AlarmCounts counts() const;
  // Increases with every change.
  [[nodiscard]] std::uint64_t revision() const noexcept { return revision_; }

 private:
  std::map<std::string, AlarmRecord, std::less<>> standing_;
  std::map<std::string, AlarmRecord, std::less<>> normal_;  // kept for their counts
  std::uint64_t revision_ = 0;
};

}  // namespace indurop::alarms
