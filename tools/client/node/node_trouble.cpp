// SPDX-License-Identifier: Apache-2.0
#include "tools/client/node/node_trouble.h"

#include <fmt/format.h>

#include <cstdint>
#include <cstdlib>

#include "scheduler/module_state_text.h"
#include "tools/client/text/units.h"

namespace indurop::tools {
namespace {

constexpr std::int64_t kShareOfPeriod = 10;  // ticks that begin further apart do not begin together

}  // namespace

std::optional<std::vector<alarms::ModuleNow>> modules_now(const RunView& run) {
  if (!run.node_alive() || run.block().state.load(std::memory_order_relaxed) != scheduler::NodeState::Running) {
    return std::nullopt;
  }
  std::vector<alarms::ModuleNow> all;
  for (std::uint32_t i = 0; i < run.module_count(); ++i) {
    const scheduler::ModuleRecord& module = run.module(i);
    const auto state = module.state.load(std::memory_order_acquire);
    const char* const down = scheduler::down_text(state);
    all.push_back({printable(fixed_text(module.name)), down != nullptr ? down : "",
                   scheduler::is_down_by_fault(state) ? printable(fixed_text(module.last_fault)) : std::string()});
  }
  return all;
}

std::optional<std::vector<alarms::ModuleNow>> modules_now(const std::string& node) {
  const auto run = RunView::open(node);
  return run.ok() ? modules_now(*run) : std::nullopt;
}

std::optional<std::string> clocks_apart(const MirrorView& mirror, const PeerView& peer, std::int64_t basic_period_ns) {
  const std::int64_t apart = std::abs(peer.clock_offset_ns);
  const bool claimed = mirror.clock_synchronised && peer.clock_synchronised && peer.clock_known;
  if (!claimed || basic_period_ns <= 0 || apart - peer.clock_bound_ns <= basic_period_ns / kShareOfPeriod) {
    return std::nullopt;
  }
  return fmt::format("the clock of board {} is {} {} this one (+-{}) although both are synchronized: check PTP or NTP",
                     printable(peer.name), human_ns(apart), peer.clock_offset_ns < 0 ? "ahead of" : "behind",
                     human_ns(peer.clock_bound_ns));
}

std::string unsaved_text(const RunView& run) {
  const std::string why = printable(fixed_text(run.block().unsaved));
  return why.empty() || !run.node_alive() ? std::string() : fmt::format("retained variables cannot be saved: {}", why);
}

std::vector<std::string> trouble_now(const RunView& run, const std::optional<MirrorView>& mirror) {
  std::vector<std::string> all;
  const auto modules = modules_now(run);
  for (const alarms::ModuleNow& one : modules ? *modules : std::vector<alarms::ModuleNow>()) {
    if (!one.down.empty()) {
      all.push_back(fmt::format("module {} {}{}{}", one.name, one.down, one.why.empty() ? "" : ": ", one.why));
    }
  }
  if (const std::string text = unsaved_text(run); !text.empty()) {
    all.push_back(text);
  }
  if (mirror && !mirror->problem.empty()) {
    all.push_back(fmt::format("not connected with other boards: {}", printable(mirror->problem)));
  }
  for (const PeerView& peer : mirror ? mirror->peers : std::vector<PeerView>()) {
    if (peer.state != "alive" || !peer.problem.empty()) {
      all.push_back(printable(
          fmt::format("board {} is {}{}{}", peer.name, peer.state, peer.problem.empty() ? "" : ": ", peer.problem)));
    } else if (const auto apart = clocks_apart(*mirror, peer, run.block().basic_period_ns); apart) {
      all.push_back(*apart);
    }
  }
  return all;
}

}  // namespace indurop::tools
