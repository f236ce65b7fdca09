// SPDX-License-Identifier: Apache-2.0
#include "history/alarms/alarm_watch.h"

#include <fmt/format.h>
#include <indurop/detail/freshness.h>

#include <array>
#include <set>
#include <span>
#include <string_view>

#include "core/rt/clock.h"
#include "core/schema/leaf.h"
#include "store/vars/node_lock.h"
#include "store/vars/shm_file.h"

namespace indurop::alarms {
namespace {

// Room for the largest value of one element.
using Bytes = std::array<std::uint8_t, sizeof(std::uint64_t)>;

// Values of other boards count only while they are confirmed.
bool is_fresh(const vars::Store& store, const DeclaredAlarm& alarm, std::int64_t now_ns) noexcept {
  void* const entry = store.entry(alarm.entry->name_hash, alarm.entry->type_hash);
  const std::int64_t confirmed =
      entry != nullptr ? abi::confirmed_of(entry, alarm.entry->kind).load(std::memory_order_acquire) : 0;
  return detail::is_valid(confirmed, alarm.variable->maxage_ns, [now_ns] { return now_ns; });
}

// The alarm rule for every module that is down.
schema::Alarm rule_of_modules() {
  schema::Alarm alarm;
  alarm.priority = schema::Priority::High;
  alarm.delay_ns = kModuleDelayNs;
  return alarm;
}

}  // namespace

std::string module_alarm(const std::string& module) {
  return "module " + module;
}

bool AlarmCondition::evaluate(const schema::Alarm& alarm, double value, std::int64_t now_ns, bool standing) noexcept {
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
  if (!store_ || store_->retired() || store_->grown() || vars::store_number(node_) != number_) {
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
  const pid_t pid = vars::running_node(node_);
  return pid != 0 && pid == store_->header().node_pid.load(std::memory_order_relaxed);
}

std::string AlarmWatch::evaluate(const std::optional<std::vector<ModuleNow>>& modules) {
  journal_.refresh();
  if (!attach()) {
    return {};
  }
  modules_known_ = modules.has_value();
  if (modules_known_) {
    evaluate_modules(*modules);
  }
  if (idle() || !journal_.become_watcher()) {
    return {};
  }
  evaluate_variables();
  if (decide(journal_.book()).empty()) {
    return {};
  }
  return journal_.change([this](const AlarmBook& book) { return decide(book); });
}

void AlarmWatch::evaluate_variables() {
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
    standing_[i] = conditions_[i].evaluate(one.alarm, value, now_ns, before) ? 1 : 0;
    values_[i] = standing_[i] != 0 ? schema::format_value(one.type, part) : std::string();
  }
}

// Keeps only modules that are down, or whose alarm is raised.
void AlarmWatch::evaluate_modules(const std::vector<ModuleNow>& modules) {
  const schema::Alarm rule = rule_of_modules();
  const std::int64_t now_ns = rt::now_ns();
  for (const ModuleNow& one : modules) {
    const std::string name = module_alarm(one.name);
    const AlarmState state = journal_.book().find(name).state;
    const bool down = !one.down.empty();
    if (!down && state == AlarmState::Normal) {
      modules_.erase(name);
      continue;
    }
    Module& module = modules_[name];
    module.standing = module.condition.evaluate(rule, down ? 1 : 0, now_ns, is_active(state));
    if (down) {
      module.text = fmt::format("module {} {}", one.name, one.down);
      module.value = one.why;
    }
  }
}

std::vector<AlarmEntry> AlarmWatch::decide(const AlarmBook& book) const {
  std::vector<AlarmEntry> all;
  const std::int64_t wall_ns = rt::wall_ns();
  std::set<std::string_view> known;
  const auto judge = [&](const std::string& name, const AlarmEntry& now, bool stands) {
    known.insert(name);
    const auto found = book.standing().find(name);
    AlarmState state = found == book.standing().end() ? AlarmState::Normal : found->second.state;
    AlarmEntry entry = now;
    entry.wall_ns = wall_ns;
    entry.alarm = name;
    if (state == AlarmState::Shelved && found->second.last.until_ns <= wall_ns) {
      entry.event = AlarmEvent::Unshelved;
      all.push_back(entry);
      state = AlarmState::Normal;
    }
    const AlarmEvent event = stands ? AlarmEvent::Raised : AlarmEvent::Cleared;
    if (state != AlarmState::Shelved && after(state, event)) {
      entry.event = event;
      all.push_back(std::move(entry));
    }
  };
  for (std::size_t i = 0; i < alarms_.size(); ++i) {
    AlarmEntry entry;
    entry.text = alarms_[i].alarm.text;
    entry.priority = alarms_[i].alarm.priority;
    entry.value = values_[i];
    judge(alarms_[i].name, entry, standing_[i] != 0);
  }
  for (const auto& [name, module] : modules_) {
    AlarmEntry entry;
    entry.text = module.text.empty() ? book.find(name).last.text : module.text;
    entry.priority = schema::Priority::High;
    entry.value = module.standing ? module.value : std::string();
    judge(name, entry, module.standing);
  }
  for (const auto& [name, record] : book.standing()) {
    const bool kept = !modules_known_ && name.starts_with(module_alarm(""));
    if (!known.contains(name) && !kept) {
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
