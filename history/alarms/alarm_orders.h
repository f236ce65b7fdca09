// SPDX-License-Identifier: Apache-2.0
// User actions on alarms: acknowledge, shelve, unshelve. Each becomes a line in the history.

#pragma once

#include <indurop/result.h>

#include <cstdint>
#include <string>
#include <vector>

#include "history/alarms/alarm_journal.h"
#include "history/alarms/declared_alarms.h"

namespace indurop::alarms {

struct AlarmOrder {
  AlarmEvent what = AlarmEvent::Acknowledged;  // or Shelved, Unshelved
  std::vector<std::string> names;              // of alarms, or of the variables they evaluate; globs
  bool all = false;                            // all alarms to which the action applies
  std::int64_t for_ns = 0;                     // duration of shelving
  std::string who;
  std::string from;
  std::string reason;
};

struct AlarmProblem {
  bool failed = false;  // the history could not be written; else a name is wrong
  std::vector<std::string> texts;
};

// Returns the alarms that it was done to. All or none: a name that matches no alarm is a problem; an alarm in a state
// to which the order does not apply is left out.
Result<std::vector<std::string>, AlarmProblem> carry_out(AlarmJournal& journal,
                                                         const std::vector<DeclaredAlarm>& declared,
                                                         const AlarmOrder& order);

}  // namespace indurop::alarms
