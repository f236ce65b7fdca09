// SPDX-License-Identifier: Apache-2.0
#include "history/alarms/alarm_book.h"

#include <algorithm>
#include <utility>

namespace indurop::alarms {

base::Json json_of(const AlarmEntry& entry) {
  base::Json out{{"wall_ns", entry.wall_ns}, {"alarm", entry.alarm}};
  if (entry.event) {
    out["event"] = word_of(*entry.event);
  }
  if (entry.state) {
    out["state"] = word_of(*entry.state);
    out["count"] = entry.count;
  }
  out["text"] = entry.text;
  out["priority"] = schema::word_of(entry.priority);
  const auto add = [&out](const char* name, const std::string& text) {
    if (!text.empty()) {
      out[name] = text;
    }
  };
  add("value", entry.value);
  add("who", entry.who);
  add("from", entry.from);
  add("reason", entry.reason);
  if (entry.until_ns != 0) {
    out["until_ns"] = entry.until_ns;
  }
  return out;
}

std::optional<AlarmEntry> parse_alarm_line(std::string_view line) {
  const auto json = base::Json::parse(line);
  AlarmEntry entry;
  if (!json || !base::read(*json, "wall_ns", entry.wall_ns) || !base::read(*json, "alarm", entry.alarm)) {
    return std::nullopt;
  }
  entry.event = alarm_event_of((*json)["event"].text().value_or(""));
  entry.state = alarm_state_of((*json)["state"].text().value_or(""));
  entry.priority = schema::priority_of((*json)["priority"].text().value_or("")).value_or(schema::Priority::Medium);
  base::read(*json, "text", entry.text);
  base::read(*json, "value", entry.value);
  base::read(*json, "who", entry.who);
  base::read(*json, "from", entry.from);
  base::read(*json, "reason", entry.reason);
  base::read(*json, "until_ns", entry.until_ns);
  base::read(*json, "count", entry.count);
  return entry.event.has_value() != entry.state.has_value() ? std::optional(std::move(entry)) : std::nullopt;
}

void AlarmBook::add(const AlarmEntry& entry) {
  AlarmRecord record = find(entry.alarm);
  const auto next = entry.event ? after(record.state, *entry.event) : entry.state;
  if (!next) {
    return;
  }
  record.state = *next;
  record.since_ns = entry.wall_ns;
  record.count = entry.state ? entry.count : record.count + (entry.event == AlarmEvent::Raised ? 1 : 0);
  const AlarmEntry before = std::exchange(record.last, entry);
  if (entry.event && entry.event != AlarmEvent::Raised && record.last.value.empty()) {
    record.last.value = before.value;
  }
  standing_.erase(entry.alarm);
  normal_.erase(entry.alarm);
  (record.state == AlarmState::Normal ? normal_ : standing_).emplace(entry.alarm, std::move(record));
  ++revision_;
}

AlarmRecord AlarmBook::find(std::string_view alarm) const {
  for (const auto* all : {&standing_, &normal_}) {
    if (const auto found = all->find(alarm); found != all->end()) {
      return found->second;
    }
  }
  return {};
}

AlarmCounts AlarmBook::counts() const {
  AlarmCounts counts;
  for (const auto& [name, record] : standing_) {
    counts.active += is_active(record.state) ? 1U : 0U;
    counts.unacknowledged += wants_attention(record.state) ? 1U : 0U;
    counts.shelved += record.state == AlarmState::Shelved ? 1U : 0U;
    if (record.state != AlarmState::Shelved) {
      counts.worst = std::min(counts.worst.value_or(schema::Priority::Low), record.last.priority);
    }
  }
  return counts;
}

}  // namespace indurop::alarms
