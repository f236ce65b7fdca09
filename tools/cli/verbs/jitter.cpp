// SPDX-License-Identifier: Apache-2.0
// indurop jitter: start lateness and execution times of modules, as table, histogram and picture.
#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "core/base/replace_file.h"
#include "tools/cli/command/repeat.h"
#include "tools/cli/pictures/histogram_bins.h"
#include "tools/cli/pictures/histogram_svg.h"
#include "tools/cli/plant/board_run.h"
#include "tools/cli/verbs/verbs.h"
#include "tools/client/text/units.h"

namespace indurop::tools {
namespace {

struct Quantity {
  const char* name;
  const char* key;  // in JSON, as in the report of `run`
  scheduler::Distribution scheduler::ModuleRecord::*distribution;
};
constexpr std::array<Quantity, 4> kQuantities{{{"jitter", "jitter_ns", &scheduler::ModuleRecord::jitter},
                                               {"latency", "latency_ns", &scheduler::ModuleRecord::latency},
                                               {"exec", "exec_ns", &scheduler::ModuleRecord::exec},
                                               {"response", "response_ns", &scheduler::ModuleRecord::response}}};

struct JitterOptions {
  BoardChoice board;
  std::string glob;
  std::string quantity = "all";
  std::string svg_file;
  bool histogram = false;
  bool no_histogram = false;
  Repeat repeat;
};

std::vector<Quantity> chosen(const JitterOptions& options) {
  std::vector<Quantity> out;
  for (const Quantity& quantity : kQuantities) {
    if (options.quantity == "all" || options.quantity == quantity.name) {
      out.push_back(quantity);
    }
  }
  return out;
}

std::vector<std::uint32_t> chosen_modules(const RunView& run, const JitterOptions& options) {
  std::vector<std::uint32_t> out;
  for (std::uint32_t i = 0; i < run.module_count(); ++i) {
    if (options.glob.empty() || schema::glob_match(options.glob, fixed_text(run.module(i).name))) {
      out.push_back(i);
    }
  }
  return out;
}

Table table_of(const RunView& run, const std::vector<std::uint32_t>& modules, const JitterOptions& options) {
  constexpr Align kRight = Align::Right;
  Table table({{"MODULE", "module"},
               {"QUANTITY", "quantity"},
               {"RUNS", "count", kRight},
               {"LAST", "last_ns", kRight},
               {"MIN", "min_ns", kRight},
               {"MEAN", "mean_ns", kRight},
               {"P50", "p50_ns", kRight},
               {"P99", "p99_ns", kRight},
               {"P99.9", "p99_9_ns", kRight},
               {"MAX", "max_ns", kRight}});
  for (const std::uint32_t index : modules) {
    const auto& module = run.module(index);
    bool first = true;
    for (const Quantity& quantity : chosen(options)) {
      const auto summary = scheduler::summarize(module.*quantity.distribution);
      const auto cell = [&](std::int64_t ns) { return Cell(summary.count > 0 ? human_ns(ns) : "-", ns); };
      const bool has_last = quantity.distribution == &scheduler::ModuleRecord::exec && summary.count > 0;
      const std::int64_t last = module.last_exec_ns.load(std::memory_order_relaxed);
      const std::string name = fixed_text(module.name);
      table.add({{first ? name : "", name, Style::Bold},
                 Cell(quantity.name),
                 {std::to_string(summary.count), summary.count},
                 {has_last ? human_ns(last) : "", has_last ? JsonValue(last) : JsonValue()},
                 cell(summary.min),
                 cell(summary.mean),
                 cell(summary.p50),
                 cell(summary.p99),
                 cell(summary.p99_9),
                 cell(summary.max)});
      first = false;
    }
  }
  return table;
}

JsonValue summary_json(const scheduler::Distribution& distribution, bool histogram) {
  const auto summary = scheduler::summarize(distribution);
  JsonValue out{{"count", summary.count}, {"min", summary.min},     {"mean", summary.mean}, {"p50", summary.p50},
                {"p99", summary.p99},     {"p99_9", summary.p99_9}, {"max", summary.max}};
  if (histogram) {
    scheduler::HistogramCounts counts;
    scheduler::copy_counts(distribution.histogram, counts);
    JsonValue bins = JsonValue::array();
    for (std::size_t i = 0; i < scheduler::Histogram::kBuckets; ++i) {
      if (counts.counts[i] > 0) {
        bins.push_back({scheduler::Histogram::lower_bound(i), scheduler::Histogram::upper_bound(i), counts.counts[i]});
      }
    }
    out["histogram"] = std::move(bins);
  }
  return out;
}

JsonValue jitter_json(const RunView& run, const std::string& node, const std::vector<std::uint32_t>& modules,
                      const JitterOptions& options) {
  JsonValue list = JsonValue::array();
  for (const std::uint32_t index : modules) {
    const auto& module = run.module(index);
    JsonValue entry{{"name", fixed_text(module.name)},        {"type", to_text(module.type)},
                    {"operation", to_text(module.operation)}, {"period_ns", module.period_ns.load()},
                    {"priority", module.priority.load()},     {"runs", module.runs.load(std::memory_order_relaxed)}};
    for (const Quantity& quantity : chosen(options)) {
      entry[quantity.key] = summary_json(module.*quantity.distribution, options.histogram);
    }
    list.push_back(std::move(entry));
  }
  JsonValue whole = document();
  whole["node"] = node;
  whole["running"] = run.node_alive();
  whole["modules"] = std::move(list);
  return whole;
}

void print_histograms(Context& context, const RunView& run, const std::vector<std::uint32_t>& modules,
                      const JitterOptions& options) {
  constexpr std::size_t kMostRows = 20;
  constexpr std::size_t kLineWithoutBar = 46;
  const auto columns = static_cast<std::size_t>(std::max(60, context.out.extent().columns));
  const std::size_t width = std::min<std::size_t>(60, columns - kLineWithoutBar);
  const std::string wanted = options.quantity == "all" ? "jitter" : options.quantity;
  for (const Quantity& quantity : kQuantities) {
    for (const std::uint32_t index : modules) {
      scheduler::HistogramCounts counts;
      scheduler::copy_counts((run.module(index).*quantity.distribution).histogram, counts);
      if (quantity.name != wanted || counts.total == 0) {
        continue;
      }
      context.out.line();
      context.out.line(context.out.paint(
          Style::Bold, fmt::format("{}  {}", printable(fixed_text(run.module(index).name)), quantity.name)));
      for (const std::string& line : bar_lines(gather(counts, kMostRows), width, context.out)) {
        context.out.line(line);
      }
    }
  }
}

std::string picture(const RunView& run, const std::string& node, const std::vector<std::uint32_t>& modules,
                    const JitterOptions& options) {
  std::vector<HistogramPanel> panels;
  for (const std::uint32_t index : modules) {
    for (const Quantity& quantity : kQuantities) {
      const auto& distribution = run.module(index).*quantity.distribution;
      const bool wanted = options.quantity == quantity.name ||
                          (options.quantity == "all" && quantity.distribution == &scheduler::ModuleRecord::jitter);
      if (wanted && distribution.count.load(std::memory_order_relaxed) > 0) {
        panels.push_back({fixed_text(run.module(index).name), quantity.name, scheduler::summarize(distribution), {}});
        scheduler::copy_counts(distribution.histogram, panels.back().counts);
      }
    }
  }
  return histogram_svg(
      fmt::format("Node {}: {} of its modules", node, options.quantity == "all" ? "jitter" : options.quantity), panels);
}

int show(Context& context, JitterOptions& options) {
  const auto chosen = open_run(context, options.board);
  if (!chosen) {
    return report(context.out, chosen.error());
  }
  const std::string& node = chosen->node;
  const RunView* run = &chosen->run;
  const auto modules = chosen_modules(*run, options);
  if (modules.empty() && !options.glob.empty()) {
    context.out.error(
        fmt::format("no module of node '{}' matches '{}' (indurop status lists all)", node, options.glob));
    return kFailed;
  }
  if (!options.svg_file.empty()) {
    const auto saved = base::replace_file(options.svg_file, picture(*run, node, modules, options), base::Durable::No);
    if (!saved) {
      context.out.error(base::cannot_write(options.svg_file, saved.error()));
      return kFailed;
    }
    context.out.note(fmt::format("wrote {}", options.svg_file));
    return kOk;
  }
  if (context.format == Format::Json) {
    context.out.line(jitter_json(*run, node, modules, options).dump());
  } else if (context.format == Format::Svg) {
    context.out.write(picture(*run, node, modules, options));
  } else {
    print_table(context, table_of(*run, modules, options), {}, "");
    if (context.format == Format::Table && !options.no_histogram && (options.histogram || context.out.terminal())) {
      print_histograms(context, *run, modules, options);
    }
  }
  if (!run->node_alive()) {
    context.out.note(fmt::format("node '{}' does not run: these are its last values", node));
  }
  return kOk;
}

Action declare_jitter(base::Options& app, Context& context) {
  auto options = std::make_shared<JitterOptions>();
  app.add("module", "GLOB", options->glob, "Only modules that match").completes(base::Completion::Module);
  app.add("--quantity", "WHAT", options->quantity, "jitter|latency|exec|response|all (default all)")
      .choices({"jitter", "latency", "exec", "response", "all"});
  app.flag("--histogram", options->histogram, "Draw histograms below the table in a pipe, too; buckets in JSON");
  app.flag("--no-histogram", options->no_histogram, "Only the table");
  app.add("--svg", "FILE", options->svg_file, "Write histograms as a picture to FILE");
  add_node_option(app, context);
  add_board_options(app, options->board);
  add_kept_option(app, options->board);
  add_format_option(app, context, {Format::Table, Format::Json, Format::Csv, Format::Svg});
  add_repeat_options(app, options->repeat);
  return [options](Context& c) {
    return repeat_rounds(c, options->repeat, [&c, &options = *options] { return show(c, options); });
  };
}

}  // namespace

const Verb kJitterVerb{"jitter", "Timing", "Show how precisely modules start and how long they run",
                       "jitter    |J_n|: how far a start was from its place on the grid (0 is perfect)\n"
                       "latency   from the release to the first instruction of run()\n"
                       "exec      run() itself\n"
                       "response  from the release to the end of run()\n"
                       "Statistics begin after the warm-up; quantiles are exact to 6 %.\n"
                       "Examples:\n"
                       "  indurop jitter\n"
                       "  indurop jitter wave --histogram\n"
                       "  indurop jitter --svg jitter.svg\n"
                       "  indurop jitter --board control\n",
                       &declare_jitter};

}  // namespace indurop::tools
