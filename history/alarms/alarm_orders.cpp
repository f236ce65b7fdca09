// SPDX-License-Identifier: Apache-2.0
#include "history/alarms/alarm_orders.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "core/base/text.h"
#include "core/rt/clock.h"
#include "core/schema/schema.h"
#include "history/alarms/alarm_watch.h"

namespace indurop::alarms {
namespace {

struct Known {
  std::string part;
  std::string text;
  schema::Priority priority = schema::Priority::Medium;
};

std::map<std::string, Known> known_alarms(const std::vector<DeclaredAlarm>& declared, const AlarmBook& book) {
  std::map<std::string, Known> all;
  for (const DeclaredAlarm& one : declared) {
    all.emplace(one.name, Known{one.part, one.alarm.text, one.alarm.priority});
  }
  for (const auto& [name, record] : book.standing()) {
    const bool module = name.starts_with(module_alarm(""));
    all.emplace(name, Known{module ? name : name.substr(0, name.find(' ')), record.last.text, record.last.priority});
  }
  return all;
}

// Matches "press::oil > 80", "press::oil", "oil" or a glob.
bool fits(const std::string& wanted, const std::string& name, const Known& alarm) {
  const auto is_end_of = [&wanted](const std::string& whole) {
    return whole == wanted || (whole.size() > wanted.size() + 2 && whole.ends_with(wanted) &&
                               whole.compare(whole.size() - wanted.size() - 2, 2, "::") == 0);
  };
  return is_end_of(name) || is_end_of(alarm.part) ||
         (schema::is_glob(wanted) && schema::glob_match(wanted, alarm.part));
}

std::vector<std::string> chosen_of(const std::map<std::string, Known>& all, const AlarmOrder& order,
                                   std::vector<std::string>& problems) {
  std::vector<std::string> chosen;
  for (const std::string& wanted : order.names) {
    const std::size_t before = chosen.size();
    for (const auto& [name, alarm] : all) {
      if (fits(wanted, name, alarm)) {
        chosen.push_back(name);
      }
    }
    if (chosen.size() == before) {
      std::vector<std::string> names;
      for (const auto& [name, alarm] : all) {
        names.push_back(alarm.part);
      }
      problems.push_back(fmt::format("there is no alarm '{}'{}", wanted, base::suggestion(wanted, names)));
    }
  }
  for (const auto& [name, alarm] : order.all ? all : std::map<std::string, Known>()) {
    chosen.push_back(name);
  }
  std::sort(chosen.begin(), chosen.end());
  chosen.erase(std::unique(chosen.begin(), chosen.end()), chosen.end());
  return chosen;
}

}  // namespace

Result<std::vector<std::string>, AlarmProblem> carry_out(AlarmJournal& journal,
                                                         const std::vector<DeclaredAlarm>& declared,
                                                         const AlarmOrder& order) {
  std::vector<std::string> done;
  AlarmProblem problem;
  const std::int64_t now = rt::wall_ns();
  const std::string failure = journal.change([&](const AlarmBook& book) {
    std::vector<AlarmEntry> entries;
    const auto all = known_alarms(declared, book);
    const auto chosen = chosen_of(all, order, problem.texts);
    if (!problem.texts.empty()) {
      return entries;
    }
    for (const std::string& name : chosen) {
      const Known& alarm = all.find(name)->second;
      if (!after(book.find(name).state, order.what)) {
        continue;
      }
      entries.push_back({now,
                         name,
                         order.what,
                         {},
                         alarm.text,
                         alarm.priority,
                         {},
                         order.who,
                         order.from,
                         order.reason,
                         order.what == AlarmEvent::Shelved ? now + order.for_ns : 0,
                         0});
      done.push_back(name);
    }
    return entries;
  });
  if (!failure.empty()) {
    return AlarmProblem{true, {failure}};
  }
  if (!problem.texts.empty()) {
    return problem;
  }
  return done;
}

}  // namespace indurop::alarms
