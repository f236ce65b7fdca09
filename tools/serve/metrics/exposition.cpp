// SPDX-License-Identifier: Apache-2.0
#include "tools/serve/metrics/exposition.h"

#include <fmt/format.h>

#include <array>
#include <cmath>

#include "core/base/printable.h"
#include "scheduler/quantile.h"

namespace indurop::serve {
namespace {

struct MetricText {
  const char* name;
  const char* type;
  const char* help;
};

constexpr std::array kMetrics{
    MetricText{"indurop_server_info", "gauge", "Always 1; the version of the server is a label."},
    MetricText{"indurop_up", "gauge", "1: the node of the board runs and is received."},
    MetricText{"indurop_ticks_total", "counter", "Ticks that have begun."},
    MetricText{"indurop_lost_ticks_total", "counter", "Ticks that were not begun in time and were left out."},
    MetricText{"indurop_basic_period_seconds", "gauge", "Time between two ticks."},
    MetricText{"indurop_tick_lateness_seconds", "summary", "Time from the planned begin of a tick to its begin."},
    MetricText{"indurop_tick_lateness_max_seconds", "gauge", "The largest lateness since the node started."},
    MetricText{"indurop_overruns_total", "counter", "Overruns of all modules of the board."},
    MetricText{"indurop_faults_total", "counter", "Faults of all modules of the board."},
    MetricText{"indurop_module_running", "gauge", "1: the module runs; 0: it is stopped, faulted or not started."},
    MetricText{"indurop_module_period_seconds", "gauge", "Period of a periodic module."},
    MetricText{"indurop_module_runs_total", "counter", "Completed runs."},
    MetricText{"indurop_module_skipped_runs_total", "counter", "Runs that were left out after an overrun."},
    MetricText{"indurop_module_overruns_total", "counter", "Releases at which the previous run had not ended."},
    MetricText{"indurop_module_deadline_misses_total", "counter", "Runs that ended after their deadline."},
    MetricText{"indurop_module_faults_total", "counter", "Crashes, exceptions and exceeded budgets."},
    MetricText{"indurop_module_restarts_total", "counter", "Restarts of a process module."},
    MetricText{"indurop_module_execution_seconds", "summary", "Execution time of a run."},
    MetricText{"indurop_module_jitter_seconds", "summary",
               "Distance of the start of a run from its place on the grid."},
    MetricText{"indurop_alarms", "gauge", "Alarms that are active, unacknowledged or shelved."},
    MetricText{"indurop_forced_values", "gauge", "Numbers that are held by a force."},
    MetricText{"indurop_variables", "gauge", "Variables by the quality of their value."},
    MetricText{"indurop_peer_up", "gauge", "1: this board receives the other board."},
    MetricText{"indurop_peer_age_seconds", "gauge", "Time since the last message of the other board."},
    MetricText{"indurop_peer_lost_updates_total", "counter", "Updates of the other board that were lost."},
    MetricText{"indurop_device_quality", "gauge",
               "Quality of a field device: 0 not exchanged yet, 1 good, above: bad."},
    MetricText{"indurop_variable_value", "gauge", "Value of a variable that was selected with --metrics."},
};
static_assert(kMetrics.size() == static_cast<std::size_t>(Metric::VariableValue) + 1);

std::string seconds(std::int64_t ns) {
  return fmt::format("{}", in_seconds(ns));
}

std::string escaped(std::string_view text) {
  std::string out;
  for (const char c : base::printable(text)) {
    out += c == '\\' || c == '"' ? std::string("\\") + c : std::string(1, c);
  }
  return out;
}

}  // namespace

Exposition::Exposition() : samples_(kMetrics.size()) {}

void Exposition::add(Metric metric, const Labels& labels, std::uint64_t value) {
  add_line(metric, "", labels, std::to_string(value));
}

void Exposition::add(Metric metric, const Labels& labels, double value) {
  const char* const infinite = value > 0 ? "+Inf" : "-Inf";
  add_line(metric, "", labels, std::isnan(value) ? "NaN" : std::isinf(value) ? infinite : fmt::format("{}", value));
}

void Exposition::add(Metric metric, const Labels& labels, const scheduler::Distribution& distribution) {
  const scheduler::Summary summary = scheduler::summarize(distribution);
  if (summary.count == 0) {
    return;
  }
  for (const auto& [quantile, ns] : {std::pair{"0.5", summary.p50}, {"0.99", summary.p99}, {"0.999", summary.p99_9}}) {
    Labels with = labels;
    with.emplace_back("quantile", quantile);
    add_line(metric, "", with, seconds(ns));
  }
  add_line(metric, "_sum", labels, seconds(distribution.sum.load(std::memory_order_relaxed)));
  add_line(metric, "_count", labels, std::to_string(summary.count));
}

void Exposition::add_line(Metric metric, std::string_view suffix, const Labels& labels, const std::string& value) {
  const auto index = static_cast<std::size_t>(metric);
  std::string written;
  for (const auto& [name, text] : labels) {
    written += fmt::format("{}{}=\"{}\"", written.empty() ? "" : ",", name, escaped(text));
  }
  samples_[index] += fmt::format("{}{}{{{}}} {}\n", kMetrics[index].name, suffix, written, value);
}

std::string Exposition::text() const {
  std::string out;
  for (std::size_t i = 0; i < kMetrics.size(); ++i) {
    if (!samples_[i].empty()) {
      const MetricText& metric = kMetrics[i];
      out += fmt::format("# HELP {0} {1}\n# TYPE {0} {2}\n", metric.name, metric.help, metric.type);
      out += samples_[i];
    }
  }
  return out;
}

}  // namespace indurop::serve
