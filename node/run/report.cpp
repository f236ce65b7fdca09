// SPDX-License-Identifier: Apache-2.0
#include "node/run/report.h"

#include <fmt/format.h>

#include <cstring>

#include "core/base/json.h"
#include "core/base/replace_file.h"
#include "scheduler/quantile.h"
#include "scheduler/words.h"

namespace indurop::node {
namespace {

using base::Json;

Json to_json(const scheduler::Distribution& distribution) {
  const scheduler::Summary s = scheduler::summarize(distribution);
  return {{"min", s.min}, {"mean", s.mean}, {"p50", s.p50}, {"p99", s.p99}, {"p99_9", s.p99_9}, {"max", s.max}};
}

Json module_json(const scheduler::ModuleRecord& module) {
  Json json{{"name", module.name},
            {"type", to_text(module.type)},
            {"operation", to_text(module.operation)},
            {"period_ns", module.period_ns.load()},
            {"priority", module.priority.load()},
            {"runs", module.runs.load()},
            {"skipped", module.skipped.load()},
            {"overruns", module.overruns.load()},
            {"deadline_misses", module.deadline_misses.load()},
            {"jitter_ns", to_json(module.jitter)},
            {"exec_ns", to_json(module.exec)},
            {"response_ns", to_json(module.response)},
            {"latency_ns", to_json(module.latency)},
            {"state", to_text(module.state.load())},
            {"faults", module.faults.load()},
            {"restarts", module.restarts.load()},
            {"lost_messages", module.lost_messages.load()}};
  if (module.faults.load() > 0) {
    json["last_fault"] = {{"text", module.last_fault}, {"tick", module.fault_tick.load()}};
  }
  return json;
}

double microseconds(std::int64_t ns) noexcept {
  return static_cast<double>(ns) / 1000;
}

}  // namespace

std::string report_json(const scheduler::RunBlock& run) {
  const scheduler::Obtained& got = run.obtained;
  Json json{{"schema_version", 1},
            {"node", run.node_name},
            {"config", run.config_file},
            {"basic_period_ns", run.basic_period_ns},
            {"macro_period_ns", run.macro_period_ns.load()},
            {"ticks", run.tick.load()},
            {"lost_ticks", run.lost_ticks.load()},
            {"stop_reason", run.stop_reason},
            {"rt",
             {{"fifo", got.fifo != 0},
              {"priority", got.tick_priority},
              {"core", got.tick_core},
              {"pinned", got.pinned != 0},
              {"memory_locked", got.memory_locked != 0},
              {"cpu_dma_latency", got.cpu_dma_latency != 0},
              {"preempt_rt", got.preempt_rt != 0},
              {"throttle_permille", got.throttle_permille},
              {"spin_margin_ns", run.spin_margin_ns.load()},
              {"why", got.why}}},
            {"tick_lateness_ns", to_json(run.tick_lateness)},
            {"modules", Json::array()}};
  for (std::uint32_t i = 0; i < run.module_count; ++i) {
    json["modules"].push_back(module_json(run.modules()[i]));
  }
  return json.dump(2) + "\n";
}

Result<void, base::Problem> write_report(const scheduler::RunBlock& run, const std::filesystem::path& file) {
  if (const auto written = base::replace_file(file, report_json(run), base::Durable::No); !written) {
    return base::Problem{fmt::format("cannot write the report {}: {}", file.string(), written.error().text)};
  }
  return {};
}

std::string summary_table(const scheduler::RunBlock& run) {
  std::size_t width = 6;
  for (std::uint32_t i = 0; i < run.module_count; ++i) {
    width = std::max(width, std::strlen(run.modules()[i].name));
  }
  std::string out =
      fmt::format("{:<{}} {:>9} {:>7} {:>8} {:>7}  {:>9} {:>9} {:>9}  {:>9} {:>9} {:>9}\n", "module", width, "runs",
                  "skipped", "overruns", "misses", "jit p50", "jit p99", "jit max", "exec p50", "exec p99", "exec max");
  for (std::uint32_t i = 0; i < run.module_count; ++i) {
    const scheduler::ModuleRecord& module = run.modules()[i];
    const auto jitter = scheduler::summarize(module.jitter);
    const auto exec = scheduler::summarize(module.exec);
    out += fmt::format("{:<{}} {:>9} {:>7} {:>8} {:>7}", module.name, width, module.runs.load(), module.skipped.load(),
                       module.overruns.load(), module.deadline_misses.load());
    if (jitter.count > 0) {
      out += fmt::format("  {:>9.2f} {:>9.2f} {:>9.2f}  {:>9.2f} {:>9.2f} {:>9.2f}", microseconds(jitter.p50),
                         microseconds(jitter.p99), microseconds(jitter.max), microseconds(exec.p50),
                         microseconds(exec.p99), microseconds(exec.max));
    } else {
      out += fmt::format("  {}", to_text(module.state.load()));
    }
    out += '\n';
  }
  return out + "times in us; jitter is |J_n| of Eq. (1)\n";
}

}  // namespace indurop::node
