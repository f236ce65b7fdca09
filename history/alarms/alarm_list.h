// SPDX-License-Identifier: Apache-2.0
// The states of a node's alarms, for people and programs: from what the node declares and from the history.

#pragma once

#include <optional>
#include <string>
#include <vector>

#include "history/alarms/alarm_book.h"
#include "history/alarms/declared_alarms.h"

namespace indurop::alarms {

struct ListedAlarm {
  std::string name;
  std::string part;  // the variable or its part to check; empty: the alarm is not declared any more
  std::string text;
  std::string unit;
  schema::Priority priority = schema::Priority::Medium;
  std::string condition;
  std::int64_t delay_ns = 0;
  AlarmRecord record;
};

// Lists the alarms that need attention first, then by priority and time. `all`: includes normal ones.
std::vector<ListedAlarm> list_alarms(const std::vector<DeclaredAlarm>& declared, const AlarmBook& book, bool all);
base::Json json_of(const ListedAlarm& alarm);
// {"active", "unacknowledged", "shelved", "worst"}
base::Json json_of(const AlarmCounts& counts);
// Returns the counts; missing fields count as none.
AlarmCounts counts_in(const base::Json& json);
// Returns "2 alarms want to be acknowledged, 1 is shelved"; empty if all is normal.
std::string sentence_of(const AlarmCounts& counts);

}  // namespace indurop::alarms
