// SPDX-License-Identifier: Apache-2.0
// indurop check: finds all errors that can be found before anything runs, and lists who reads and writes what.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "config/measured_times.h"
#include "config/xml/plant_reader.h"
#include "config/xml/reader.h"
#include "core/schema/place_index.h"
#include "tools/cli/command/config_file.h"
#include "tools/cli/plant/check_chain.h"
#include "tools/cli/plant/check_plant.h"
#include "tools/cli/plant/pool_tables.h"
#include "tools/cli/verbs/verbs.h"
#include "tools/client/config/checked_config.h"
#include "tools/console/diagnostics.h"
#include "tools/console/table_text.h"

namespace indurop::tools {
namespace {

struct CheckOptions {
  std::string file;
  bool adjust = false;
  bool simulation = false;
  std::vector<std::string> chain;
  std::int64_t network_ns = 0;  // 0: not given
  config::CheckOptions::Times times;
};

std::string summary_line(const CheckedConfig& checked) {
  const auto& table = checked.check.table;
  std::string line = counted(checked.config.modules.size(), "module");
  if (!checked.check.periodic.empty()) {
    line += fmt::format(", basic period {}, macro period {}, {}", base::format_duration(table.basic_period),
                        base::format_duration(table.macro_period), counted(table.slot_count, "slot"));
  }
  return line + ", " + counted(checked.check.schema.variables.size(), "shared variable") +
         counted_pools(checked.check.schema.pools.size()) + without_state(checked.check.undeclared.size());
}

Table variable_table(const CheckedConfig& checked) {
  Table table({{"VARIABLE", "name"}, {"TYPE", "type"}, {"WRITTEN BY", "writers"}, {"READ BY", "readers"}});
  const schema::PlaceIndex index(checked.check.schema);
  for (const auto& use : checked.check.uses) {
    const auto place = index.find(use.name, schema::NearestName::Skip);
    const std::string type = place ? schema::display_name(place->type) : "?";
    const auto names = [](const std::vector<std::string>& list) {
      return Cell(list.empty() ? "-" : fmt::format("{}", fmt::join(list, ", ")), JsonValue(list), Style::None);
    };
    table.add({Cell(use.name), Cell(type), names(use.writers), names(use.readers)});
  }
  return table;
}

// Names of the modules that do not declare what they keep.
std::vector<std::string> undeclared_modules(const CheckedConfig& checked) {
  std::vector<std::string> names;
  for (const std::size_t i : checked.check.undeclared) {
    names.push_back(checked.config.modules[i].name);
  }
  return names;
}

JsonValue summary_json(const CheckedConfig& checked) {
  return {{"ok", checked.ok()},
          {"file", checked.config.file.string()},
          {"modules", checked.config.modules.size()},
          {"basic_period_ns", checked.check.table.basic_period.count()},
          {"macro_period_ns", checked.check.table.macro_period.count()},
          {"slots", checked.check.table.slot_count},
          {"undeclared", undeclared_modules(checked)},
          {"pools", pool_table(checked).json()},
          {"diagnostics", diagnostics_json(checked.diagnostics)}};
}

int check_one(Context& context, const std::string& file, const config::CheckOptions& options) {
  const CheckedConfig checked = load_config(file, options);
  const Table variables = variable_table(checked);
  if (context.format == Format::Csv) {
    print_diagnostics(context, checked.diagnostics, false);
    context.out.write(variables.csv());
  } else if (context.format == Format::Json) {
    print_table(context, variables, summary_json(checked), "variables");
  } else {
    print_diagnostics(context, checked.diagnostics, true);
    for (const Table& table : {variables, pool_table(checked)}) {
      if (!context.out.quiet() && !table.empty()) {
        context.out.write(table_text(table, context.out));
        context.out.line();
      }
    }
    print_verdict(context, checked.diagnostics, summary_line(checked));
  }
  return checked.ok() ? kOk : kCheckFailed;
}

int check(Context& context, const CheckOptions& options) {
  const auto file = find_config(options.file);
  if (!file) {
    return report(context.out, file.error());
  }
  const config::CheckOptions all{
      .files = true, .adjust = options.adjust, .simulation = options.simulation, .kept = true, .times = &options.times};
  if (!options.chain.empty()) {
    if (options.chain.size() != 2) {
      context.out.error("--chain needs two variables: where it begins and where it ends");
      return kUsage;
    }
    ChainQuestion question{options.chain[0], options.chain[1], {}};
    if (options.network_ns > 0) {
      question.network = base::Nanos(options.network_ns);
    }
    return check_chain(context, *file, all, question);
  }
  return config::is_plant_file(*file) ? check_plant_file(context, *file, all) : check_one(context, *file, all);
}

Action declare_check(base::Options& app, Context& context) {
  auto options = std::make_shared<CheckOptions>();
  app.add("file", "FILE", options->file,
          "module.xml, or the manifest of a plant (default: module.xml, else plant.xml)");
  app.flag("--adjust", options->adjust,
           "Round periods if the basic period would be too short, instead of reporting an error");
  app.flag("--sim", options->simulation, "Also report what a simulation (run --sim) cannot repeat");
  app.add("--chain", "NAME", options->chain,
          "Show the worst-case age of data from the first variable to the second, over modules and boards")
      .completes(base::Completion::Variable);
  add_time_option(app, "--network", options->network_ns,
                  "With --chain: maximum time from board to board (default: as measured by the boards of this "
                  "host, else 1 ms)");
  config::add_times_option(app, options->times);
  add_format_option(app, context, {Format::Table, Format::Json, Format::Csv});
  return [options](Context& c) { return check(c, *options); };
}

}  // namespace

const Verb kCheckVerb{
    "check", "Before it runs", "Check a configuration, and show which modules read and write each variable",
    "Prints every error, warning and note as file:line:col, the shared variables with the modules that write and\n"
    "read them, pools, and one summary line. With -q it prints only diagnostics and the summary; -o csv prints the\n"
    "variables. For a plant it shows the boards and the variables that travel between them; -o csv prints these\n"
    "variables. Modules that do not declare what they keep from run to run (INDUROP_STATE) are named and counted.\n"
    "If the execution times of modules are known (<wcet>, or --times), a deadline that a module can miss is an\n"
    "error.\n"
    "Exit code 0 if there are no errors (warnings are allowed), 4 if there are errors.\n"
    "Examples:\n"
    "  indurop check\n"
    "  indurop check plant.xml\n"
    "  indurop check plant.xml --chain cell::encoder cell::torque\n"
    "  indurop check module.xml -o json\n",
    &declare_check};

}  // namespace indurop::tools
