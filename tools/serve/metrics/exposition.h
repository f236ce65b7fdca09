// SPDX-License-Identifier: Apache-2.0
// Metrics in the text format of Prometheus, version 0.0.4: all samples of a metric together, after what it means.

#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "scheduler/run_block.h"

namespace indurop::serve {

// In the order in which they are written; docs/metrics.md lists them.
enum class Metric : std::uint8_t {
  ServerInfo,
  BoardUp,
  Ticks,
  LostTicks,
  BasicPeriod,
  Lateness,
  LatenessMax,
  Overruns,
  Faults,
  ModuleRunning,
  ModulePeriod,
  ModuleRuns,
  ModuleSkipped,
  ModuleOverruns,
  ModuleMisses,
  ModuleFaults,
  ModuleRestarts,
  ModuleExecution,
  ModuleJitter,
  Alarms,
  ForcedValues,
  Variables,
  PeerUp,
  PeerAge,
  PeerLost,
  DeviceQuality,
  VariableValue,
};

// Metrics have seconds.
constexpr double in_seconds(std::int64_t ns) noexcept {
  return static_cast<double>(ns) / 1e9;
}

class Exposition {
 public:
  using Labels = std::vector<std::pair<std::string_view, std::string>>;

  Exposition();
  void add(Metric metric, const Labels& labels, std::uint64_t value);
  void add(Metric metric, const Labels& labels, double value);
  // A summary in seconds: the quantiles 0.5, 0.99 and 0.999, the sum and the count.
  void add(Metric metric, const Labels& labels, const scheduler::Distribution& distribution);

  // Metrics without samples are left out.
  [[nodiscard]] std::string text() const;

 private:
  void add_line(Metric metric, std::string_view suffix, const Labels& labels, const std::string& value);

  std::vector<std::string> samples_;  // by metric
};

}  // namespace indurop::serve
