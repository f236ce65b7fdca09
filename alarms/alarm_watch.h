// SPDX-License-Identifier: Apache-2.0
// Looks at the conditions of a node's alarms and keeps what happens. Reads the store as every observer does: no tick
// notices it. Of one thread.

#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "alarms/alarm_journal.h"
#include "alarms/declared_alarms.h"
#include "vars/store.h"

namespace indurop::alarms {

// A condition has to be over for so long, so that one that flickers does not fill the history.
inline constexpr std::int64_t kBackForNs = 1'000'000'000;

// One condition over time.
class AlarmCondition {
 public:
  // True from `delay` after it came until kBackForNs after it went. `standing`: how it was before the first look.
  bool look(const schema::Alarm& alarm, double value, std::int64_t now_ns, bool standing) noexcept;

 private:
  bool known_ = false;
  bool met_ = false;
  bool standing_ = false;
  std::int64_t since_ns_ = 0;  // of met_
};

// A module of the node, as its run block says. One that is down is an alarm, which nobody has to declare.
struct ModuleNow {
  std::string name;
  std::string down;  // "is stopped"; empty: it does its work
  std::string why;   // its last fault, if it has one
};
// For so long, so that one that is only restarted raises nothing.
inline constexpr std::int64_t kModuleDelayNs = 2'000'000'000;
// "module Robot"
std::string module_alarm(const std::string& module);

class AlarmWatch {
 public:
  explicit AlarmWatch(std::string node) : node_(std::move(node)), journal_(node_) {}

  // Looks once, about ten times a second; writes nothing if another process watches already. Returns why what happened
  // could not be kept, else nothing. `modules`: all of the node; nothing if that is not known now, then their alarms
  // stay as they are.
  std::string look(const std::optional<std::vector<ModuleNow>>& modules);
  [[nodiscard]] const AlarmJournal& journal() const noexcept { return journal_; }
  // Nothing to look at: ask more rarely.
  [[nodiscard]] bool idle() const noexcept {
    return alarms_.empty() && modules_.empty() && journal_.book().standing().empty();
  }

 private:
  // A module that is down, or was when it was looked at before.
  struct Module {
    AlarmCondition condition;
    bool standing = false;
    std::string text;
    std::string value;
  };
  bool attach();
  void look_at_variables();
  void look_at_modules(const std::vector<ModuleNow>& modules);
  std::vector<AlarmEntry> decide(const AlarmBook& book) const;

  std::string node_;
  AlarmJournal journal_;
  std::optional<vars::Store> store_;
  std::uint64_t number_ = 0;  // of the store
  std::vector<DeclaredAlarm> alarms_;
  std::vector<AlarmCondition> conditions_;  // beside alarms_
  std::vector<char> standing_;              // beside alarms_: by the last look
  std::vector<std::string> values_;         // beside alarms_: of those that stand
  std::map<std::string, Module> modules_;   // by the names of their alarms
  bool modules_known_ = false;              // at the last look
};

}  // namespace indurop::alarms
