// SPDX-License-Identifier: Apache-2.0
// indurop overruns: which module was late, when, what time it used itself, and which one ran before it.
#include <fmt/format.h>

#include "tools/cli/plant/board_run.h"
#include "tools/cli/verbs/verbs.h"
#include "tools/client/text/units.h"

namespace indurop::tools {
namespace {

struct OverrunsOptions {
  BoardChoice board;
  std::string glob;
  std::uint64_t count = 20;
};

// Returns the likely reason, from the data in the record.
std::string reason(const RunView& run, const OverrunSample& overrun) {
  const bool other_longer = overrun.previous >= 0 && overrun.previous_ns > overrun.own_ns;
  if (!overrun.started) {
    // Only a module that took a good part of the period explains it; else the cause was not one of the node's modules.
    const bool explains = overrun.previous >= 0 && 4 * overrun.previous_ns >= run.module(overrun.module).period_ns;
    return explains ? fmt::format("did not get its turn: {} took {}", run.module_name(overrun.previous),
                                  human_ns(overrun.previous_ns))
                    : "did not get its turn, and no module took so long: the machine was busy or stood still";
  }
  if (overrun.latency_ns > overrun.own_ns) {
    return other_longer ? fmt::format("started late, after {}", run.module_name(overrun.previous)) : "started late";
  }
  return "took too long itself";
}

int overruns(Context& context, OverrunsOptions& options) {
  const auto chosen = open_run(context, options.board);
  if (!chosen) {
    return report(context.out, chosen.error());
  }
  const std::string& node = chosen->node;
  const RunView* run = &chosen->run;
  constexpr Align kRight = Align::Right;
  Table table({{"TICK", "tick", kRight},
               {"SLOT", "slot", kRight},
               {"MODULE", "module"},
               {"OWN TIME", "own_ns", kRight},
               {"LATENCY", "latency_ns", kRight},
               {"BEFORE IT", "previous"},
               {"ITS TIME", "previous_ns", kRight},
               {"", "started"},
               {"WHY", ""}});
  constexpr std::uint64_t kAll = UINT64_MAX;
  auto samples = run->overrun_log(kAll);
  std::erase_if(samples, [&](const OverrunSample& sample) {
    return !options.glob.empty() && !schema::glob_match(options.glob, run->module_name(sample.module));
  });
  if (samples.size() > options.count) {
    samples.erase(samples.begin(), samples.end() - static_cast<std::ptrdiff_t>(options.count));
  }
  for (const auto& sample : samples) {
    const bool has_previous = sample.previous >= 0;
    const std::string previous = has_previous ? run->module_name(sample.previous) : "";
    table.add({{std::to_string(sample.tick), sample.tick},
               {std::to_string(sample.slot), sample.slot},
               Cell(run->module_name(sample.module), Style::Bold),
               {sample.started ? human_ns(sample.own_ns) : "-", sample.own_ns},
               {sample.started ? human_ns(sample.latency_ns) : "-", sample.latency_ns},
               {has_previous ? previous : "-", has_previous ? JsonValue(previous) : JsonValue()},
               {has_previous ? human_ns(sample.previous_ns) : "-",
                has_previous ? JsonValue(sample.previous_ns) : JsonValue()},
               {"", sample.started},
               {reason(*run, sample), JsonValue()}});
  }
  const std::uint64_t total = run->block().overrun_log_next.load(std::memory_order_relaxed);
  print_table(context, table, {{"node", node}, {"total", total}}, "overruns");
  if (context.format == Format::Table) {
    if (total == 0) {
      context.out.line("no overruns");
    } else if (total > samples.size()) {
      context.out.note(fmt::format("{} of {} overruns shown", samples.size(), total));
    }
  }
  return kOk;
}

Action declare_overruns(base::Options& app, Context& context) {
  auto options = std::make_shared<OverrunsOptions>();
  app.add("module", "GLOB", options->glob, "Only modules that match").completes(base::Completion::Module);
  app.add("-n,--count", "COUNT", options->count, "The newest COUNT records (default 20)");
  add_node_option(app, context);
  add_board_options(app, options->board);
  add_kept_option(app, options->board);
  add_format_option(app, context, {Format::Table, Format::Json, Format::Csv});
  return [options](Context& c) { return overruns(c, *options); };
}

}  // namespace

const Verb kOverrunsVerb{
    "overruns", "Timing", "Show the recorded overruns and their causes",
    "An overrun is a release at which the module's previous run had not ended. OWN TIME is the time that the\n"
    "module itself had used by then, LATENCY how late it had started, BEFORE IT the module that ran before it in\n"
    "that basic period. The newest 256 records are kept; the counters of `indurop status` count all overruns.\n"
    "Examples:\n"
    "  indurop overruns\n"
    "  indurop overruns control -n 100\n"
    "  indurop overruns --board control\n",
    &declare_overruns};

}  // namespace indurop::tools
