// SPDX-License-Identifier: Apache-2.0
// What people do with alarms: acknowledge, shelve, unshelve. Each is a line in the history.

#pragma once

#include <indurop/result.h>

#include <cstdint>
#include <string>
#include <vector>

#include "alarms/alarm_journal.h"
#include "alarms/declared_alarms.h"

namespace indurop::alarms {

struct AlarmOrder {
  AlarmEvent what = AlarmEvent::Acknowledged;  // or Shelved, Unshelved
  std::vector<std::string> names;              // of alarms, or of what they look at; globs
  bool all = false;                            // that it means something for
  std::int64_t for_ns = 0;                     // Shelved
  std::string who;
  std::string from;
  std::string reason;
};

struct AlarmProblem {
  bool failed = false;  // it could not be kept; else a name is wrong
  std::vector<std::string> texts;
};

// The alarms that it was done to. All or none: a name that fits no alarm is a problem; one in a state that the order
// means nothing in is left out.
Result<std::vector<std::string>, AlarmProblem> carry_out(AlarmJournal& journal,
                                                         const std::vector<DeclaredAlarm>& declared,
                                                         const AlarmOrder& order);

}  // namespace indurop::alarms
