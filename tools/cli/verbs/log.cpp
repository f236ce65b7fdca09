// SPDX-License-Identifier: Apache-2.0
// indurop log: which module ran when, from the ring that the real-time threads write.
#include <fmt/format.h>

#include "core/base/replace_file.h"
#include "tools/cli/pictures/trace.h"
#include "tools/cli/plant/board_run.h"
#include "tools/cli/verbs/verbs.h"
#include "tools/client/text/units.h"

namespace indurop::tools {
namespace {

struct LogOptions {
  BoardChoice board;
  std::string glob;
  std::string trace_file;
  std::uint64_t count = 0;
};
constexpr std::uint64_t kDefaultLines = 40;
constexpr std::uint64_t kAllRuns = UINT64_MAX;

Table table_of(const RunView& run, const std::vector<SlotSample>& samples) {
  constexpr Align kRight = Align::Right;
  Table table({{"TICK", "tick", kRight},
               {"SLOT", "slot", kRight},
               {"MODULE", "module"},
               {"TIME", "release_ns", kRight},
               {"LATENCY", "latency_ns", kRight},
               {"EXEC", "exec_ns", kRight},
               {"RESPONSE", "response_ns", kRight}});
  constexpr double kNsPerMs = 1e6;
  const std::int64_t epoch = run.block().epoch_ns;
  for (const auto& sample : samples) {
    const std::int64_t release = sample.release_ns - epoch;
    const auto cell = [](std::int64_t ns) { return Cell(human_ns(ns), ns); };
    table.add({{std::to_string(sample.tick), sample.tick},
               {std::to_string(sample.slot), sample.slot},
               Cell(run.module_name(sample.module)),
               {fmt::format("{:.3f} ms", static_cast<double>(release) / kNsPerMs), release},
               cell(sample.start_ns - sample.release_ns),
               cell(sample.end_ns - sample.start_ns),
               cell(sample.end_ns - sample.release_ns)});
  }
  return table;
}

int show_log(Context& context, LogOptions& options) {
  const auto chosen = open_run(context, options.board);
  if (!chosen) {
    return report(context.out, chosen.error());
  }
  const std::string& node = chosen->node;
  const RunView* run = &chosen->run;
  auto samples = run->slot_log(kAllRuns);
  std::erase_if(samples, [&](const SlotSample& sample) {
    return !options.glob.empty() && !schema::glob_match(options.glob, run->module_name(sample.module));
  });
  // A trace is for zooming: contains everything available, unless less was requested.
  const std::uint64_t most = options.count > 0 ? options.count : options.trace_file.empty() ? kDefaultLines : kAllRuns;
  if (samples.size() > most) {
    samples.erase(samples.begin(), samples.end() - static_cast<std::ptrdiff_t>(most));
  }
  if (!options.trace_file.empty()) {
    const auto saved = base::replace_file(options.trace_file, trace_json(*run, node, samples), base::Durable::No);
    if (!saved) {
      context.out.error(base::cannot_write(options.trace_file, saved.error()));
      return kFailed;
    }
    context.out.note(
        fmt::format("wrote {} runs to {}; open it with https://ui.perfetto.dev", samples.size(), options.trace_file));
    return kOk;
  }
  print_table(context, table_of(*run, samples), {{"node", node}}, "runs");
  if (samples.empty()) {
    context.out.note("nothing ran yet");
  }
  return kOk;
}

Action declare_log(base::Options& app, Context& context) {
  auto options = std::make_shared<LogOptions>();
  app.add("module", "GLOB", options->glob, "Only modules that match").completes(base::Completion::Module);
  app.add("-n,--count", "COUNT", options->count, "The newest COUNT runs (default 40)");
  app.add("--trace", "FILE", options->trace_file, "Write a trace for Perfetto (all runs in the log) to FILE");
  app.moved("--audit", "indurop audit");
  app.moved("--audit-file", "indurop audit --file");
  add_node_option(app, context);
  add_board_options(app, options->board);
  add_kept_option(app, options->board);
  add_format_option(app, context, {Format::Table, Format::Json, Format::Csv});
  return [options](Context& c) { return show_log(c, *options); };
}

}  // namespace

const Verb kLogVerb{
    "log", "Timing", "Show which module ran when, as a table or as a trace for Perfetto",
    "TIME is the release, counted from tick 0; LATENCY is from there to the first instruction of run(); EXEC is\n"
    "run() itself; RESPONSE is from the release to the end. The node keeps the newest 8192 runs.\n"
    "Examples:\n"
    "  indurop log -n 50\n"
    "  indurop log --trace trace.json   # for ui.perfetto.dev\n"
    "  indurop log --board control\n",
    &declare_log};

}  // namespace indurop::tools
