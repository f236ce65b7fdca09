// SPDX-License-Identifier: Apache-2.0
#include "tools/cli/pictures/trace.h"

#include <fmt/format.h>

#include "tools/client/text/table.h"

namespace indurop::tools {

std::string trace_json(const RunView& run, const std::string& node, std::span<const SlotSample> samples) {
  constexpr double kNsPerUs = 1000.0;
  const std::int64_t epoch = run.block().epoch_ns;
  const auto us = [](std::int64_t ns) { return static_cast<double>(ns) / kNsPerUs; };
  const std::int32_t pid = run.block().node_pid.load(std::memory_order_relaxed);
  std::string out = "{\"displayTimeUnit\":\"ns\",\"traceEvents\":[\n";
  out += JsonValue{{"ph", "M"}, {"name", "process_name"}, {"pid", pid}, {"args", {{"name", "node " + node}}}}.dump();
  for (std::uint32_t i = 0; i < run.module_count(); ++i) {
    const auto& module = run.module(i);
    out += ",\n" + JsonValue{{"ph", "M"},
                             {"name", "thread_name"},
                             {"pid", pid},
                             {"tid", i + 1},
                             {"args", {{"name", fixed_text(module.name)}}}}
                       .dump();
    out += ",\n" + JsonValue{{"ph", "M"},
                             {"name", "thread_sort_index"},
                             {"pid", pid},
                             {"tid", i + 1},
                             {"args", {{"sort_index", module.priority.load()}}}}
                       .dump();
  }
  for (const SlotSample& sample : samples) {
    out +=
        ",\n" +
        JsonValue{{"ph", "X"},
                  {"cat", "module"},
                  {"name", run.module_name(sample.module)},
                  {"pid", pid},
                  {"tid", sample.module + 1},
                  {"ts", us(sample.start_ns - epoch)},
                  {"dur", us(sample.end_ns - sample.start_ns)},
                  {"args",
                   {{"tick", sample.tick}, {"slot", sample.slot}, {"latency_ns", sample.start_ns - sample.release_ns}}}}
            .dump();
  }
  return out + "\n]}\n";
}

}  // namespace indurop::tools
