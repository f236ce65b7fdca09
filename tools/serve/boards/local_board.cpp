// SPDX-License-Identifier: Apache-2.0
// The status of a local board; its changes are in local_changes.cpp.
#include "tools/serve/boards/local_board.h"

#include <fmt/format.h>

#include <algorithm>

#include "history/alarms/alarm_list.h"
#include "scheduler/words.h"
#include "tools/client/values/force_view.h"
#include "tools/serve/door/request.h"

namespace indurop::serve {

void LocalBoard::refresh() {
  if (store() == nullptr || store()->retired() || store()->grown() || source_.generation() != generation()) {
    const std::uint64_t current = source_.generation();
    auto fresh = source_.attach();
    if (fresh.ok()) {
      attach(std::move(fresh).value(), current);
    } else if (current == 0 && store() != nullptr) {
      detach();
    }
  }
  set_absence(source_.absence(store()));
}

std::string LocalBoard::state() const {
  if (!absence().empty()) {
    return absence();
  }
  const auto view = run();
  return view && view->node_alive() ? scheduler::to_text(view->block().state.load(std::memory_order_relaxed))
                                    : "starting";
}

std::string LocalBoard::steady_state() const {
  return alive() ? state() : "not running";
}

std::string LocalBoard::no_store() const {
  return fmt::format("the variables of board {} cannot be read; see indurop nodes", name());
}

std::optional<tools::RunView> LocalBoard::run() const {
  auto run = tools::RunView::open(name());
  return run.ok() ? std::optional(std::move(run).value()) : std::nullopt;
}

base::Json LocalBoard::forces() const {
  return store() != nullptr ? tools::json_of(tools::view_forces(name(), *store())) : base::Json::array();
}

base::Json LocalBoard::lock() const {
  return tools::json_of(vars::lock_of(name()));
}

Result<tools::RunView, Refused> LocalBoard::current_run() {
  auto now = run();
  if (!now) {
    return Refused{status::kConflict, {fmt::format("board {} has not run since its host was started", name())}};
  }
  return std::move(*now);
}

Board::Done LocalBoard::messages(std::uint64_t count) {
  auto run = current_run();
  if (!run) {
    return std::move(run).error();
  }
  const auto& block = run->block();
  base::Json list = base::Json::array();
  for (const tools::MessageSample& sample : run->messages(count)) {
    const std::int64_t since_epoch = std::max<std::int64_t>(sample.time_ns - block.epoch_ns, 0);
    list.push_back({{"who", sample.who},
                    {"tick", since_epoch / std::max<std::int64_t>(block.basic_period_ns, 1)},
                    {"time_ns", sample.time_ns},
                    {"text", sample.text}});
  }
  return base::Json{{"epoch_ns", block.epoch_ns.load()}, {"messages", std::move(list)}};
}

std::vector<alarms::DeclaredAlarm> LocalBoard::declared_alarms() const {
  return store() != nullptr ? alarms::declared_alarms(*store()) : std::vector<alarms::DeclaredAlarm>();
}

Board::Done LocalBoard::alarm_status(bool all) {
  alarms::AlarmJournal journal(name());
  journal.refresh();
  const auto declared = declared_alarms();
  base::Json list = base::Json::array();
  for (const auto& one : alarms::list_alarms(declared, journal.book(), all)) {
    list.push_back(json_of(one));
  }
  return base::Json{{"watched", journal.watched()},
                    {"declared", declared.size()},
                    {"counts", json_of(journal.book().counts())},
                    {"alarms", std::move(list)}};
}

Board::Done LocalBoard::alarm_history(std::uint64_t count) {
  base::Json list = base::Json::array();
  for (const alarms::AlarmEntry& one : alarms::AlarmJournal(name()).history(count)) {
    list.push_back(json_of(one));
  }
  return base::Json{{"events", std::move(list)}};
}

}  // namespace indurop::serve
