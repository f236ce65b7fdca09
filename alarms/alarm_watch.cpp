// SPDX-License-Identifier: Apache-2.0
#include "alarms/alarm_watch.h"

#include <fmt/format.h>
#include <indurop/detail/freshness.h>

#include <array>
#include <set>
#include <span>
#include <string_view>

#include "rt/clock.h"
#include "schema/leaf.h"
#include "vars/process.h"
#include "vars/shm_file.h"

namespace indurop::alarms {
namespace {

// The longest value of one element.
using Bytes = std::array<std::uint8_t, sizeof(std::uint64_t)>;

// Values of other boards count while they are confirmed.
bool is_fresh(const vars::Store& store, const DeclaredAlarm& alarm, std::int64_t now_ns) noexcept {
  void* const entry = store.entry(alarm.entry->name_hash, alarm.entry->type_hash);
  const std::int64_t confirmed =
      entry != nullptr ? abi::confirmed_of(entry, alarm.entry->kind).load(std::memory_order_acquire) : 0;
  return detail::is_valid(confirmed, alarm.variable->maxage_ns, [now_ns] { return now_ns; });
}

}  // namespace

bool AlarmCondition::look(const schema::Alarm& alarm, double value, std::int64_t now_ns, bool standing) noexcept {
  const bool met = schema::is_met(alarm, value, known_ ? met_ : standing);
  if (!known_ || met != met_) {
    since_ns_ = now_ns;
  }
  standing_ = known_ ? standing_ : standing;
  known_ = true;
  met_ = met;
  const std::int64_t wait = met ? alarm.delay_ns : kBackForNs;
  if (met != standing_ && now_ns - since_ns_ >= wait) {
    standing_ = met;
  }
  return standing_;
}

bool AlarmWatch::attach() {
  if (!store_ || store_->retired() || vars::store_number(node_) != number_) {
    const std::uint64_t number = vars::store_number(node_);
    auto fresh = vars::Store::attach(node_, vars::Mode::ReadOnly);
    if (!fresh.ok()) {
      store_.reset();
      return false;
    }
    store_ = std::move(fresh).value();
    number_ = number;
    alarms_ = declared_alarms(*store_);
    conditions_.assign(alarms_.size(), {});
    standing_.clear();
    for (const DeclaredAlarm& one : alarms_) {
      standing_.push_back(is_active(journal_.book().find(one.name).state) ? 1 : 0);
    }
    values_.assign(alarms_.size(), {});
  }
  const vars::BlockHeader& header = store_->header();
  return vars::process_alive(header.node_pid.load(std::memory_order_relaxed),
                             header.node_start_time.load(std::memory_order_relaxed));
}

std::string AlarmWatch::look() {
  journal_.refresh();
  if (!attach()) {
    return {};
  }
  if (idle() || !journal_.become_watcher()) {
    return {};
  }
  const std::int64_t now_ns = rt::to_ns(store_->now());
  for (std::size_t i = 0; i < alarms_.size(); ++i) {
    const DeclaredAlarm& one = alarms_[i];
    Bytes bytes{};
    const std::span<std::uint8_t> part(bytes.data(), one.type.element_size);
    const bool before = is_active(journal_.book().find(one.name).state);
    if (!is_fresh(*store_, one, now_ns) || !store_->read(*one.entry, one.offset, part).ok()) {
      continue;
    }
    const double value = schema::as_number<double>(one.type.base, bytes.data()).value_or(0);
    standing_[i] = conditions_[i].look(one.alarm, value, now_ns, before) ? 1 : 0;
    values_[i] = standing_[i] != 0 ? schema::format_value(one.type, part) : std::string();
  }
  if (decide(journal_.book()).empty()) {
    return {};
  }
  return journal_.change([this](const AlarmBook& book) { return decide(book); });
}

std::vector<AlarmEntry> AlarmWatch::decide(const AlarmBook& book) const {
  std::vector<AlarmEntry> all;
  const std::int64_t wall_ns = rt::wall_ns();
  std::set<std::string_view> declared;
  const auto add = [&](const DeclaredAlarm& one, AlarmEvent event, const std::string& value) {
    all.push_back({wall_ns, one.name, event, {}, one.alarm.text, one.alarm.priority, value, {}, {}, {}, 0, 0});
  };
  for (std::size_t i = 0; i < alarms_.size(); ++i) {
    const DeclaredAlarm& one = alarms_[i];
    declared.insert(one.name);
    const auto known = book.standing().find(one.name);
    AlarmState state = known == book.standing().end() ? AlarmState::Normal : known->second.state;
    if (state == AlarmState::Shelved && known->second.last.until_ns <= wall_ns) {
      add(one, AlarmEvent::Unshelved, {});
      state = AlarmState::Normal;
    }
    const AlarmEvent event = standing_[i] != 0 ? AlarmEvent::Raised : AlarmEvent::Cleared;
    if (state != AlarmState::Shelved && after(state, event)) {
      add(one, event, standing_[i] != 0 ? values_[i] : std::string());
    }
  }
  for (const auto& [name, record] : book.standing()) {
    if (!declared.contains(name)) {
      AlarmEntry entry = record.last;
      entry.wall_ns = wall_ns;
      entry.alarm = name;
      entry.event = AlarmEvent::Removed;
      entry.state.reset();
      all.push_back(std::move(entry));
    }
  }
  return all;
}

}  // namespace indurop::alarms
