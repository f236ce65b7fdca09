// SPDX-License-Identifier: Apache-2.0
#include "history/alarms/alarm_list.h"

#include <fmt/format.h>

#include <fmt/ranges.h>

#include <algorithm>
#include <set>
#include <string_view>
#include <tuple>

namespace indurop::alarms {
namespace {

ListedAlarm listed(const DeclaredAlarm& one, AlarmRecord record) {
  return {one.name,           one.part,           one.alarm.text,
          one.unit,           one.alarm.priority, schema::condition_text(one.type, one.alarm),
          one.alarm.delay_ns, std::move(record)};
}

// Order: unacknowledged, returned, acknowledged, shelved, normal.
int rank_of(AlarmState state) noexcept {
  switch (state) {
    case AlarmState::Unacknowledged:
      return 0;
    case AlarmState::Returned:
      return 1;
    case AlarmState::Acknowledged:
      return 2;
    case AlarmState::Shelved:
      return 3;
    case AlarmState::Normal:
      break;
  }
  return 4;
}

}  // namespace

std::vector<ListedAlarm> list_alarms(const std::vector<DeclaredAlarm>& declared, const AlarmBook& book, bool all) {
  std::vector<ListedAlarm> list;
  std::set<std::string_view> known;
  for (const DeclaredAlarm& one : declared) {
    known.insert(one.name);
    AlarmRecord record = book.find(one.name);
    if (all || record.state != AlarmState::Normal) {
      list.push_back(listed(one, std::move(record)));
    }
  }
  for (const auto& [name, record] : book.standing()) {
    if (!known.contains(name)) {
      list.push_back({name, {}, record.last.text, {}, record.last.priority, {}, 0, record});
    }
  }
  std::stable_sort(list.begin(), list.end(), [](const ListedAlarm& a, const ListedAlarm& b) {
    return std::tuple(rank_of(a.record.state), a.priority, b.record.since_ns) <
           std::tuple(rank_of(b.record.state), b.priority, a.record.since_ns);
  });
  return list;
}

base::Json json_of(const ListedAlarm& alarm) {
  const AlarmRecord& record = alarm.record;
  base::Json out{{"alarm", alarm.name},          {"name", alarm.part},
                 {"text", alarm.text},           {"priority", schema::word_of(alarm.priority)},
                 {"condition", alarm.condition}, {"unit", alarm.unit},
                 {"delay_ns", alarm.delay_ns},   {"state", word_of(record.state)},
                 {"count", record.count}};
  if (record.since_ns != 0) {
    out["since_wall_ns"] = record.since_ns;
    out["value"] = record.last.value;
    out["who"] = record.last.who;
    out["reason"] = record.last.reason;
  }
  if (record.state == AlarmState::Shelved) {
    out["until_wall_ns"] = record.last.until_ns;
  }
  return out;
}

base::Json json_of(const AlarmCounts& counts) {
  return {{"active", counts.active},
          {"unacknowledged", counts.unacknowledged},
          {"shelved", counts.shelved},
          {"worst", counts.worst ? base::Json(schema::word_of(*counts.worst)) : base::Json()}};
}

AlarmCounts counts_in(const base::Json& json) {
  AlarmCounts counts;
  const auto number = [&json](const char* what) { return json[what].natural().value_or(0); };
  counts.active = number("active");
  counts.unacknowledged = number("unacknowledged");
  counts.shelved = number("shelved");
  counts.worst = schema::priority_of(json["worst"].text().value_or(""));
  return counts;
}

std::string sentence_of(const AlarmCounts& counts) {
  std::vector<std::string> parts;
  const auto add = [&parts](std::size_t count, const char* what) {
    if (count > 0) {
      const char* const alarms = !parts.empty() ? "" : count == 1 ? " alarm" : " alarms";
      parts.push_back(fmt::format("{}{} {} {}", count, alarms, count == 1 ? "is" : "are", what));
    }
  };
  add(counts.active, "active");
  add(counts.unacknowledged, "not acknowledged");
  add(counts.shelved, "shelved");
  return fmt::format("{}", fmt::join(parts, ", "));
}

}  // namespace indurop::alarms
