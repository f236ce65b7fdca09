// SPDX-License-Identifier: Apache-2.0
#include "tools/client/node/module_table.h"

#include <fmt/format.h>

#include "config/xml/reader.h"
#include "core/rt/relaxed.h"
#include "tools/client/text/units.h"

namespace indurop::tools {
namespace {

Style style_of(scheduler::ModuleState state) {
  switch (state) {
    case scheduler::ModuleState::Running:
      return Style::Good;
    case scheduler::ModuleState::Loaded:
    case scheduler::ModuleState::Starting:
    case scheduler::ModuleState::Restarting:
      return Style::Warn;
    case scheduler::ModuleState::Faulted:
      return Style::Bad;
    case scheduler::ModuleState::Stopped:
    case scheduler::ModuleState::Exited:
      return Style::Dim;
  }
  return Style::None;
}

Cell counter(std::uint64_t value, Style if_any = Style::None) {
  return {std::to_string(value), value, value > 0 ? if_any : Style::Dim};
}
Cell duration(std::int64_t ns, bool known = true) {
  return {known ? human_ns(ns) : "-", ns};
}

std::vector<Cell> module_row(const scheduler::ModuleRecord& module, bool alive) {
  using rt::kRelaxed;
  const auto state = module.state.load(kRelaxed);
  const auto exec = scheduler::summarize(module.exec);
  const auto jitter = scheduler::summarize(module.jitter);
  const bool ran = exec.count > 0;
  const std::uint64_t version = module.version.load(std::memory_order_acquire);
  const bool ended = module.ended && state == scheduler::ModuleState::Stopped;
  const std::string word = ended ? "ended" : to_text(state);
  const bool real = module.operation != scheduler::Operation::NonReal;
  const std::string period =
      module.period_ns > 0 ? base::format_duration(base::Nanos(module.period_ns)) : to_text(module.operation);
  return {Cell(fixed_text(module.name), Style::Bold),
          Cell(to_text(module.type)),
          {period, module.period_ns.load()},
          {"", to_text(module.operation)},
          {real ? std::to_string(module.priority.load()) : "-", module.priority.load()},
          {alive ? word : fmt::format("({})", word), word, alive ? style_of(state) : Style::Dim},
          {"", module.pid.load(kRelaxed)},
          counter(module.runs.load(kRelaxed)),
          counter(module.skipped.load(kRelaxed), Style::Warn),
          counter(module.overruns.load(kRelaxed), Style::Warn),
          counter(module.deadline_misses.load(kRelaxed), Style::Warn),
          duration(module.last_exec_ns.load(kRelaxed), ran),
          duration(exec.mean, ran),
          duration(exec.max, ran),
          duration(jitter.p50, jitter.count > 0),
          duration(jitter.p99, jitter.count > 0),
          duration(jitter.max, jitter.count > 0),
          counter(module.restarts.load(kRelaxed), Style::Warn),
          counter(module.lost_messages.load(kRelaxed), Style::Warn),
          {"", version},
          {"", fixed_text(module.digests[version % 2])},
          {"", module.version_tick.load(kRelaxed)},
          {fault_text(module), fault_text(module), Style::Bad}};
}

}  // namespace

std::string fault_text(const scheduler::ModuleRecord& module) {
  const auto kind = static_cast<scheduler::FaultKind>(module.fault_kind.load(std::memory_order_acquire));
  if (kind == scheduler::FaultKind::None) {
    return {};
  }
  return fmt::format("{} (tick {})", fixed_text(module.last_fault), module.fault_tick.load(std::memory_order_relaxed));
}

Table module_table(const RunView& run, bool alive) {
  constexpr Align kRight = Align::Right;
  Table table({{"MODULE", "name"},
               {"TYPE", "type", Align::Left, 4},
               {"PERIOD", "period_ns", kRight},
               {"", "operation"},
               {"PRIO", "priority", kRight, 2},
               {"STATE", "state"},
               {"", "pid"},
               {"RUNS", "runs", kRight},
               {"SKIPPED", "skipped", kRight, 1},
               {"OVERRUNS", "overruns", kRight},
               {"MISSES", "deadline_misses", kRight},
               {"EXEC LAST", "last_exec_ns", kRight, 6},
               {"EXEC AVG", "mean_exec_ns", kRight},
               {"MAX", "max_exec_ns", kRight},
               {"JITTER P50", "jitter_p50_ns", kRight, 3},
               {"JITTER P99", "jitter_p99_ns", kRight},
               {"MAX", "jitter_max_ns", kRight, 1},
               {"RESTARTS", "restarts", kRight, 5},
               {"", "lost_messages"},
               {"", "version"},
               {"", "version_digest"},
               {"", "version_tick"},
               {"LAST FAULT", "last_fault"}});
  for (std::uint32_t i = 0; i < run.module_count(); ++i) {
    table.add(module_row(run.module(i), alive));
  }
  return table;
}

}  // namespace indurop::tools
