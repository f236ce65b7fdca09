// SPDX-License-Identifier: Apache-2.0
#include "tools/serve/boards/trouble.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "core/rt/relaxed.h"
#include "history/alarms/alarm_list.h"
#include "scheduler/module_state_text.h"
#include "tools/client/node/mirror_view.h"
#include "tools/client/node/node_trouble.h"
#include "tools/client/text/units.h"
#include "tools/client/values/force_view.h"

namespace indurop::serve {
namespace {

using rt::kRelaxed;

// `runs`: the node runs; if it has ended, only earlier problems count.
void add_module(std::vector<Trouble>& all, const scheduler::ModuleRecord& module, bool runs) {
  const std::string name = tools::fixed_text(module.name);
  const auto kind = static_cast<scheduler::FaultKind>(module.fault_kind.load(std::memory_order_acquire));
  const auto state = module.state.load(kRelaxed);
  const std::string fault =
      kind != scheduler::FaultKind::None ? tools::printable(tools::fixed_text(module.last_fault)) : std::string();
  const std::optional<std::uint64_t> tick =
      fault.empty() ? std::nullopt : std::optional(module.fault_tick.load(kRelaxed));
  const char* const down = runs ? scheduler::down_text(state) : nullptr;
  if (down != nullptr) {
    const bool by_fault = scheduler::is_down_by_fault(state) && !fault.empty();
    const bool for_good = state == scheduler::ModuleState::Stopped || state == scheduler::ModuleState::Faulted;
    all.push_back({for_good ? Severity::Error : Severity::Warning, name,
                   fmt::format("module {} {}{}{}", name, down, by_fault ? ": " : "", by_fault ? fault : ""), tick});
  } else if (!fault.empty()) {
    all.push_back({Severity::Warning, name, fmt::format("module {} had a fault: {}", name, fault), tick});
  }
  if (const auto count = module.overruns.load(kRelaxed); count > 0) {
    all.push_back({Severity::Warning, name, fmt::format("module {} had {} overruns", name, count), {}});
  }
  if (const auto count = module.deadline_misses.load(kRelaxed); count > 0) {
    all.push_back({Severity::Warning, name, fmt::format("module {} missed {} deadlines", name, count), {}});
  }
}

void add_node(std::vector<Trouble>& all, const Board& board, const tools::RunView& run) {
  const auto& block = run.block();
  if (const std::string why = tools::printable(tools::fixed_text(block.stop_reason)); !why.empty()) {
    all.push_back({Severity::Error, "", fmt::format("the node ended: {}", why), {}});
  }
  if (const auto lost = block.lost_ticks.load(kRelaxed); lost > 0) {
    all.push_back({Severity::Warning, "", fmt::format("{} ticks were lost", lost), {}});
  }
  if (const std::string why = tools::printable(tools::fixed_text(block.obtained.why)); !why.empty()) {
    all.push_back({Severity::Note, "", fmt::format("not in real time: {}", why), {}});
  }
  if (const std::string text = tools::unsaved_text(run); !text.empty()) {
    all.push_back({Severity::Error, "", text, {}});
  }
  const auto mirror = tools::view_mirror(board.name());
  if (mirror && !mirror->problem.empty()) {
    all.push_back({Severity::Error, "", fmt::format("not connected with other boards: {}", mirror->problem), {}});
  }
  for (const auto& peer : mirror ? mirror->peers : std::vector<tools::PeerView>()) {
    if (peer.state != "alive" || !peer.problem.empty()) {
      all.push_back(
          {Severity::Warning,
           "",
           fmt::format("board {} is {}{}{}", peer.name, peer.state, peer.problem.empty() ? "" : ": ", peer.problem),
           {}});
    }
  }
}

}  // namespace

const char* word_of(Severity severity) noexcept {
  constexpr std::array kWords{"error", "warning", "note"};
  return kWords.at(static_cast<std::size_t>(severity));
}

std::vector<Trouble> troubles_of(const Board& board, const std::optional<tools::RunView>& run,
                                 const alarms::AlarmCounts& alarms) {
  std::vector<Trouble> all;
  if (!board.alive()) {
    all.push_back({Severity::Error, "", fmt::format("board {} is {}", board.name(), board.state()), {}});
  }
  if (run) {
    const bool runs = board.alive() && run->block().state.load(kRelaxed) == scheduler::NodeState::Running;
    add_node(all, board, *run);
    for (std::uint32_t i = 0; i < run->module_count(); ++i) {
      add_module(all, run->module(i), runs);
    }
  }
  if (alarms.active + alarms.unacknowledged > 0) {
    const bool bad = alarms.worst <= schema::Priority::High;
    all.push_back({bad ? Severity::Error : Severity::Warning, "", alarms::sentence_of(alarms), {}});
  }
  if (const auto lock = vars::lock_of(board.name()); lock.lock != vars::WriteLock::None) {
    all.push_back({Severity::Note, "", fmt::format("the write lock is {}", tools::lock_line(lock)), {}});
  }
  if (const auto* store = board.store(); store != nullptr && board.alive()) {
    for (const auto& force : tools::view_forces(board.name(), *store)) {
      const std::string who = tools::who_and_why(force.note);
      all.push_back(
          {Severity::Note,
           "",
           fmt::format("{} is forced to {}{}", force.name, force.value, who.empty() ? "" : fmt::format(" by {}", who)),
           {}});
    }
  }
  std::stable_sort(all.begin(), all.end(), [](const Trouble& a, const Trouble& b) { return a.severity < b.severity; });
  return all;
}

}  // namespace indurop::serve
