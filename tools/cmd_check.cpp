// SPDX-License-Identifier: Apache-2.0
// indurop check: everything that can be known to be wrong before anything runs, who reads and writes what.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "deploy/reader.h"
#include "tools/config_file.h"
#include "tools/verbs.h"

namespace indurop::tools {
namespace {

struct Options {
  std::string file;
  bool adjust = false;
};

using Severity = deploy::Diagnostic::Severity;

std::string counted(std::size_t n, const char* noun) {
  return fmt::format("{} {}{}", n, noun, n == 1 ? "" : "s");
}

std::string summary_line(const CheckedConfig& checked) {
  const auto count = [&checked](Severity severity) {
    return static_cast<std::size_t>(std::count_if(checked.diagnostics.begin(), checked.diagnostics.end(),
                                                  [severity](const auto& d) { return d.severity == severity; }));
  };
  const std::size_t warnings = count(Severity::Warning);
  const std::string warned = warnings > 0 ? ", " + counted(warnings, "warning") : "";
  if (!checked.ok()) {
    return fmt::format("{}{}", counted(count(Severity::Error), "error"), warned);
  }
  const auto& table = checked.check.table;
  std::string line = counted(checked.config.modules.size(), "module");
  if (!checked.check.periodic.empty()) {
    line += fmt::format(", basic period {}, macro period {}, {}", deploy::format_duration(table.basic_period),
                        deploy::format_duration(table.macro_period), counted(table.slot_count, "slot"));
  }
  return line + ", " + counted(checked.check.schema.variables.size(), "shared variable") + warned;
}

const schema::Variable* find_variable(const schema::Schema& schema, const std::string& name) {
  for (const auto& variable : schema.variables) {
    if (variable.name == name) {
      return &variable;
    }
  }
  return nullptr;
}

Table variable_table(const CheckedConfig& checked) {
  Table table({{"VARIABLE", "name"}, {"TYPE", "type"}, {"WRITTEN BY", "writers"}, {"READ BY", "readers"}});
  for (const auto& use : checked.check.uses) {
    const auto* variable = find_variable(checked.check.schema, use.name);
    const std::string type = variable != nullptr ? schema::display_name(variable->type) : "?";
    const auto names = [](const std::vector<std::string>& list) {
      return Cell(list.empty() ? "-" : fmt::format("{}", fmt::join(list, ", ")), JsonValue(list), Style::None);
    };
    table.add({Cell(use.name), Cell(type), names(use.writers), names(use.readers)});
  }
  return table;
}

JsonValue summary_json(const CheckedConfig& checked) {
  return {{"ok", checked.ok()},
          {"file", checked.config.file.string()},
          {"modules", checked.config.modules.size()},
          {"basic_period_ns", checked.check.table.basic_period.count()},
          {"macro_period_ns", checked.check.table.macro_period.count()},
          {"slots", checked.check.table.slot_count},
          {"diagnostics", diagnostics_json(checked.diagnostics)}};
}

int check(Context& context, const Options& options) {
  int code = kOk;
  const auto checked = load_config(context, options.file, {.files = true, .adjust = options.adjust}, code);
  if (!checked) {
    return code;
  }
  code = checked->ok() ? kOk : kCheckFailed;
  const Table variables = variable_table(*checked);
  if (context.format == Format::Csv) {
    print_diagnostics(context, checked->diagnostics, false);
    context.out.write(variables.csv());
    return code;
  }
  if (context.format == Format::Json) {
    print_table(context, variables, summary_json(*checked), "variables");
    return code;
  }
  print_diagnostics(context, checked->diagnostics, true);
  if (!context.out.quiet() && !variables.empty()) {
    context.out.write(variables.text(context.out));
    context.out.line();
  }
  context.out.line(fmt::format(
      "{}  {}", checked->ok() ? context.out.paint(Style::Good, "OK") : context.out.paint(Style::Bad, "FAILED"),
      summary_line(*checked)));
  return code;
}

Action declare(CLI::App& app, Context& context) {
  auto options = std::make_shared<Options>();
  app.add_option("file", options->file, "Configuration (default: module.xml)")->type_name("FILE");
  app.add_flag("--adjust", options->adjust,
               "Round periods so that the basic period is not too small, instead of an error");
  add_format_option(app, context, {Format::Table, Format::Json, Format::Csv});
  return [options](Context& c) { return check(c, *options); };
}

}  // namespace

const Verb kCheckVerb{
    "check", "Before it runs", "Say what is wrong with a configuration and who reads and writes what",
    "Prints every error, warning and note as file:line:col, the shared variables with the modules that write and\n"
    "read them, and one summary line. With -q only diagnostics and summary; -o csv prints the variables.\n"
    "Exit code 0 if there are no errors (warnings allowed), 4 if there are.\n",
    &declare};

}  // namespace indurop::tools
