// SPDX-License-Identifier: Apache-2.0
// indurop plan: the schedule as table, JSON, CSV or timing diagram.
#include <fmt/format.h>

#include "deploy/plan.h"
#include "tools/config_file.h"
#include "tools/save_file.h"
#include "tools/verbs.h"

namespace indurop::tools {
namespace {

struct Options {
  std::string file;
  std::string svg_file;
  bool adjust = false;
};

std::string with_line_end(std::string text) {
  if (!text.empty() && text.back() != '\n') {
    text += '\n';
  }
  return text;
}

// `Content` and `Check`: Config and CheckResult, or Plant and PlantCheck.
template <class Content, class Check>
int show(Context& context, const Options& options, const Content& content, const Check& check) {
  if (!options.svg_file.empty()) {
    const std::string problem = save_file(options.svg_file, deploy::plan_svg(content, check));
    if (!problem.empty()) {
      context.out.error(problem);
      return kFailed;
    }
    context.out.note(fmt::format("wrote {}", options.svg_file));
    return kOk;
  }
  switch (context.format) {
    case Format::Table:
      context.out.write(with_line_end(deploy::plan_table(content, check)));
      break;
    case Format::Json:
      context.out.write(with_line_end(deploy::plan_json(content, check)));
      break;
    case Format::Csv:
      context.out.write(with_line_end(deploy::plan_csv(content, check)));
      break;
    case Format::Svg:
      context.out.write(with_line_end(deploy::plan_svg(content, check)));
      break;
  }
  return kOk;
}

int plan(Context& context, const Options& options) {
  int code = kOk;
  const auto file = find_config(context, options.file, code);
  if (!file) {
    return code;
  }
  const deploy::CheckOptions schedule{.files = false, .adjust = options.adjust};
  if (deploy::is_plant_file(*file)) {
    const CheckedPlant checked = load_plant(*file, schedule);
    print_diagnostics(context, checked.diagnostics, false);
    return checked.ok() ? show(context, options, checked.plant, checked.check) : kCheckFailed;
  }
  const CheckedConfig checked = load_config(*file, schedule);
  print_diagnostics(context, checked.diagnostics, false);
  return checked.ok() ? show(context, options, checked.config, checked.check) : kCheckFailed;
}

Action declare(CLI::App& app, Context& context) {
  auto options = std::make_shared<Options>();
  app.add_option("file", options->file, "module.xml, or the manifest of a plant (default: module.xml, else plant.xml)")
      ->type_name("FILE");
  app.add_option("--svg", options->svg_file, "Write the timing diagram to FILE")->type_name("FILE");
  app.add_flag("--adjust", options->adjust,
               "Round periods so that the basic period is not too small, instead of an error");
  add_format_option(app, context, {Format::Table, Format::Json, Format::Csv, Format::Svg});
  return [options](Context& c) { return plan(c, *options); };
}

}  // namespace

const Verb kPlanVerb{"plan", "Before it runs",
                     "Show the schedule: which module runs in which basic period, in which order",
                     "Works without the module files: only the periods, offsets and priorities count.\n"
                     "-o svg prints a timing diagram for a browser or a document. Of a plant, all boards are shown.\n",
                     &declare};

}  // namespace indurop::tools
