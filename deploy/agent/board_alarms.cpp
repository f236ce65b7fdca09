// SPDX-License-Identifier: Apache-2.0
#include "deploy/agent/board_alarms.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <chrono>
#include <cstring>
#include <optional>
#include <utility>

#include "core/rt/fixed_text.h"
#include "deploy/transaction/write_words.h"
#include "history/alarms/alarm_list.h"
#include "history/alarms/alarm_orders.h"
#include "scheduler/module_state_text.h"
#include "store/vars/run_file.h"
#include "store/vars/store.h"

namespace indurop::deploy {
namespace {

using alarms::AlarmEvent;
using base::Json;

constexpr std::chrono::milliseconds kAlarmPoll{100};
constexpr std::chrono::seconds kIdlePoll{1};
constexpr std::size_t kMaxEvents = 200;

// The result points into `store`.
std::vector<alarms::DeclaredAlarm> declared_in(const Result<vars::Store>& store) {
  return store ? alarms::declared_alarms(*store) : std::vector<alarms::DeclaredAlarm>();
}

// Returns nothing while the node is not running, or if its run block is invalid.
std::optional<std::vector<alarms::ModuleNow>> modules_of(const std::string& board) {
  using scheduler::ModuleRecord;
  const auto file = vars::RunFile::open(board, vars::Mode::ReadOnly, scheduler::kRunMagic, sizeof(scheduler::RunBlock));
  const auto* const block = file ? static_cast<const scheduler::RunBlock*>(file->data()) : nullptr;
  const std::uint64_t offset = block != nullptr ? block->modules_offset : 0;
  const std::uint32_t count = block != nullptr ? block->module_count.load() : 0;
  if (block == nullptr || block->abi != scheduler::kRunAbi || offset % alignof(ModuleRecord) != 0 ||
      offset > file->size() || count > (file->size() - offset) / sizeof(ModuleRecord) ||
      block->state.load(std::memory_order_relaxed) != scheduler::NodeState::Running) {
    return std::nullopt;
  }
  std::vector<alarms::ModuleNow> all;
  for (std::uint32_t i = 0; i < count; ++i) {
    const ModuleRecord& module = block->at<ModuleRecord>(offset)[i];
    const auto state = module.state.load(std::memory_order_acquire);
    const char* const down = scheduler::down_text(state);
    all.push_back({rt::text_of(module.name), down != nullptr ? down : "",
                   scheduler::is_down_by_fault(state) ? rt::text_of(module.last_fault) : std::string()});
  }
  return all;
}

AlarmEvent event_of(Action action) {
  return action == Action::AckAlarms      ? AlarmEvent::Acknowledged
         : action == Action::ShelveAlarms ? AlarmEvent::Shelved
                                          : AlarmEvent::Unshelved;
}

}  // namespace

void BoardAlarms::step(rt::MonoTime now) {
  if (now < next_check_) {
    return;
  }
  std::string problem = watch_.evaluate(modules_of(board_));
  next_check_ = now + (watch_.idle() ? rt::MonoTime::duration(kIdlePoll) : rt::MonoTime::duration(kAlarmPoll));
  if (problem != problem_ && !problem.empty()) {
    log_.error("alarms cannot be kept: {}", problem);
  }
  problem_ = std::move(problem);
}

std::string alarms_text(const std::string& board) {
  alarms::AlarmJournal journal(board);
  journal.refresh();
  const auto store = vars::Store::attach(board, vars::Mode::ReadOnly);
  const auto declared = declared_in(store);
  Json list = Json::array();
  for (const alarms::ListedAlarm& one : alarms::list_alarms(declared, journal.book(), true)) {
    list.push_back(json_of(one));
  }
  Json events = Json::array();
  for (const alarms::AlarmEntry& one : journal.history(kMaxEvents)) {
    events.push_back(json_of(one));
  }
  return Json{{"watched", journal.watched()},
              {"declared", declared.size()},
              {"counts", json_of(journal.book().counts())},
              {"alarms", std::move(list)},
              {"events", std::move(events)}}
      .dump();
}

Result<std::string, base::Problem> order_alarms(const std::string& board, const Command& command) {
  const auto words = parse_write_order(command.target);
  if (!words || (command.action == Action::ShelveAlarms && words->for_ns <= 0)) {
    return base::Problem{"the command cannot be understood"};
  }
  alarms::AlarmOrder order;
  order.what = event_of(command.action);
  order.names = words->lines;
  order.all = words->lines.empty();
  order.for_ns = words->for_ns;
  order.who = user_of(*words);
  order.from = command.host;
  order.reason = words->reason;
  alarms::AlarmJournal journal(board);
  const auto store = vars::Store::attach(board, vars::Mode::ReadOnly);
  const auto done = alarms::carry_out(journal, declared_in(store), order);
  if (!done) {
    return base::Problem{fmt::format("{}", fmt::join(done.error().texts, "; "))};
  }
  return Json(*done).dump();
}

}  // namespace indurop::deploy
