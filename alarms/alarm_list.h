// SPDX-License-Identifier: Apache-2.0
// How the alarms of a node stand, for people and programs: what it declares and what its history says.

#pragma once

#include <optional>
#include <string>
#include <vector>

#include "alarms/alarm_book.h"
#include "alarms/declared_alarms.h"

namespace indurop::alarms {

struct ListedAlarm {
  std::string name;
  std::string part;  // what to look at; empty: it is not declared any more
  std::string text;
  std::string unit;
  schema::Priority priority = schema::Priority::Medium;
  std::string condition;
  std::int64_t delay_ns = 0;
  AlarmRecord record;
};

// Those that need somebody first, then by priority and time. `all`: those too that are normal.
std::vector<ListedAlarm> list_alarms(const std::vector<DeclaredAlarm>& declared, const AlarmBook& book, bool all);
base::Json json_of(const ListedAlarm& alarm);
// {"active", "unacknowledged", "shelved", "worst"}
base::Json json_of(const AlarmCounts& counts);
// What is not there counts as none.
AlarmCounts counts_in(const base::Json& json);
// "2 alarms want to be acknowledged, 1 is shelved"; empty if all is normal.
std::string sentence_of(const AlarmCounts& counts);

}  // namespace indurop::alarms
