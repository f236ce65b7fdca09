// SPDX-License-Identifier: Apache-2.0
// Evaluates the conditions of a node's alarms and records their events. Reads the store like every observer: no tick is
// affected. Used by one thread.

#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "history/alarms/alarm_journal.h"
#include "history/alarms/declared_alarms.h"
#include "store/vars/store.h"

namespace indurop::alarms {

// A condition must be over for this time (ns), so that one that flickers does not fill the history.
inline constexpr std::int64_t kBackForNs = 1'000'000'000;

// One condition over time.
class AlarmCondition {
 public:
  // Returns true from `delay` after the condition became true until kBackForNs after it became false. `standing`: its
  // state before the first evaluation.
  bool evaluate(const schema::Alarm& alarm, double value, std::int64_t now_ns, bool standing) noexcept;

 private:
  bool known_ = false;
  bool met_ = false;
  bool standing_ = false;
  std::int64_t since_ns_ = 0;  // time of the last change of met_
};

// A module of the node, as in its run block. A module that is down is an alarm, which needs no declaration.
struct ModuleNow {
  std::string name;
  std::string down;  // "is stopped"; empty: it works
  std::string why;   // its last fault, if it has one
};
// A module must be down for this time (ns), so that a restart raises no alarm.
inline constexpr std::int64_t kModuleDelayNs = 2'000'000'000;
// "module Robot"
std::string module_alarm(const std::string& module);

class AlarmWatch {
 public:
  explicit AlarmWatch(std::string node) : node_(std::move(node)), journal_(node_) {}

  // Evaluates once, to be called about ten times a second; writes nothing if another process evaluates already. Returns
  // why the events could not be recorded, else an empty text. `modules`: all modules of the node; nothing if they are
  // not known now, then their alarms do not change.
  std::string evaluate(const std::optional<std::vector<ModuleNow>>& modules);
  [[nodiscard]] const AlarmJournal& journal() const noexcept { return journal_; }
  // Nothing to evaluate: call more rarely.
  [[nodiscard]] bool idle() const noexcept {
    return alarms_.empty() && modules_.empty() && journal_.book().standing().empty();
  }

 private:
  // A module that is down, or was at the last evaluation.
  struct Module {
    AlarmCondition condition;
    bool standing = false;
    std::string text;
    std::string value;
  };
  bool attach();
  void evaluate_variables();
  void evaluate_modules(const std::vector<ModuleNow>& modules);
  std::vector<AlarmEntry> decide(const AlarmBook& book) const;

  std::string node_;
  AlarmJournal journal_;
  std::optional<vars::Store> store_;
  std::uint64_t number_ = 0;  // number of the store
  std::vector<DeclaredAlarm> alarms_;
  std::vector<AlarmCondition> conditions_;  // one for each of alarms_
  std::vector<char> standing_;              // one for each of alarms_: result of the last evaluation
  std::vector<std::string> values_;         // one for each of alarms_: value of those whose condition is true
  std::map<std::string, Module> modules_;   // by the names of their alarms
  bool modules_known_ = false;              // at the last evaluation
};

}  // namespace indurop::alarms
