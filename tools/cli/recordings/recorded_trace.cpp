// SPDX-License-Identifier: Apache-2.0
#include "tools/cli/recordings/recorded_trace.h"

#include <fmt/format.h>

#include <cstdint>
#include <string>
#include <utility>

#include "history/recorder/run_words.h"
#include "history/recorder/sources.h"
#include "history/recording/mcap_reader.h"
#include "tools/client/text/table.h"

namespace indurop::tools {
namespace {

using base::Problem;

void name_tracks(const recorder::Sources& sources, std::string& out) {
  for (std::size_t i = 0; i < sources.all.size(); ++i) {
    const recorder::Source& source = sources.all[i];
    const std::string node = source.text("node");
    const std::string name = node.empty() ? source.prefix : "node " + node;
    out += (i == 0 ? "" : ",\n") +
           JsonValue{{"ph", "M"}, {"name", "process_name"}, {"pid", i + 1}, {"args", {{"name", name}}}}.dump();
    for (std::size_t module = 0; module < source.modules.size(); ++module) {
      out += ",\n" + JsonValue{{"ph", "M"},
                               {"name", "thread_name"},
                               {"pid", i + 1},
                               {"tid", module + 1},
                               {"args", {{"name", source.modules[module]}}}}
                         .dump();
    }
  }
}

// Log times are on the common clock of all nodes; a run's own times are on its node's clock.
void add_run(const recorder::Source& source, std::size_t pid, const recorder::RunWords& run, std::int64_t since_ns,
             std::string& out) {
  constexpr double kNsPerUs = 1000.0;
  const auto us = [](std::int64_t ns) { return static_cast<double>(ns) / kNsPerUs; };
  out += ",\n" + JsonValue{{"ph", "X"},
                           {"cat", "module"},
                           {"name", recorder::module_name(source, run.module)},
                           {"pid", pid},
                           {"tid", run.module + 1},
                           {"ts", us(since_ns - (run.tail.end_ns - run.tail.start_ns))},
                           {"dur", us(run.tail.end_ns - run.tail.start_ns)},
                           {"args",
                            {{"tick", run.tail.tick},
                             {"latency_ns", run.tail.start_ns - run.tail.release_ns},
                             {"faulted", run.faulted}}}}
                     .dump();
}

}  // namespace

Result<Exported, Problem> recorded_trace(const std::filesystem::path& file) {
  auto reader = recording::McapReader::open(file);
  if (!reader) {
    return std::move(reader).error();
  }
  const recorder::Sources sources = recorder::find_sources(*reader);
  if (sources.all.empty()) {
    return Problem{fmt::format("{} has no runs: only recordings of indurop record and run --record do", file.string())};
  }
  Exported out;
  out.text = "{\"displayTimeUnit\":\"ns\",\"traceEvents\":[\n";
  name_tracks(sources, out.text);
  std::uint64_t begin = 0;
  out.damages = reader->each([&](const recording::McapMessage& message) {
    begin = begin == 0 ? message.log_time_ns : begin;
    const auto place = sources.channels.find(message.channel);
    if (place == sources.channels.end() || place->second.kind != recorder::ChannelKind::Run) {
      return;
    }
    const auto run = recorder::run_from_cdr(message.data.view);
    if (run && run->module != recorder::kOthers) {
      add_run(sources.all[place->second.source], place->second.source + 1, *run,
              static_cast<std::int64_t>(message.log_time_ns - begin), out.text);
      ++out.count;
    }
  });
  out.text += "\n]}\n";
  return out;
}

}  // namespace indurop::tools
