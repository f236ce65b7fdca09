// SPDX-License-Identifier: Apache-2.0
// indurop plan: the schedule as table, JSON, CSV or timing diagram.
#include <fmt/format.h>

#include "config/measured_times.h"
#include "config/plan/plan.h"
#include "config/xml/plant_reader.h"
#include "core/base/replace_file.h"
#include "tools/cli/command/config_file.h"
#include "tools/cli/verbs/verbs.h"
#include "tools/client/config/checked_config.h"
#include "tools/console/diagnostics.h"

namespace indurop::tools {
namespace {

struct PlanOptions {
  std::string file;
  std::string svg_file;
  bool adjust = false;
  bool why = false;
  config::CheckOptions::Times times;
};

std::string with_line_end(std::string text) {
  if (!text.empty() && text.back() != '\n') {
    text += '\n';
  }
  return text;
}

// Template parameters `Content` and `Check`: Config and CheckResult, or Plant and PlantCheck.
template <class Content, class Check>
int show(Context& context, const PlanOptions& options, const Content& content, const Check& check) {
  if (!options.svg_file.empty()) {
    const auto saved = base::replace_file(options.svg_file, config::plan_svg(content, check), base::Durable::No);
    if (!saved) {
      context.out.error(base::cannot_write(options.svg_file, saved.error()));
      return kFailed;
    }
    context.out.note(fmt::format("wrote {}", options.svg_file));
    return kOk;
  }
  switch (context.format) {
    case Format::Table:
      context.out.write(with_line_end(config::plan_table(content, check)) +
                        (options.why ? config::plan_why(content, check) : ""));
      break;
    case Format::Json:
      context.out.write(with_line_end(config::plan_json(content, check)));
      break;
    case Format::Csv:
      context.out.write(with_line_end(config::plan_csv(content, check)));
      break;
    case Format::Svg:
      context.out.write(with_line_end(config::plan_svg(content, check)));
      break;
  }
  return kOk;
}

int plan(Context& context, const PlanOptions& options) {
  const auto file = find_config(options.file);
  if (!file) {
    return report(context.out, file.error());
  }
  const config::CheckOptions schedule{.files = false, .adjust = options.adjust, .times = &options.times};
  if (config::is_plant_file(*file)) {
    const CheckedPlant checked = load_plant(*file, schedule);
    print_diagnostics(context, checked.diagnostics, false);
    return checked.ok() ? show(context, options, checked.plant, checked.check) : kCheckFailed;
  }
  const CheckedConfig checked = load_config(*file, schedule);
  print_diagnostics(context, checked.diagnostics, false);
  return checked.ok() ? show(context, options, checked.config, checked.check) : kCheckFailed;
}

Action declare_plan(base::Options& app, Context& context) {
  auto options = std::make_shared<PlanOptions>();
  app.add("file", "FILE", options->file,
          "module.xml, or the manifest of a plant (default: module.xml, else plant.xml)");
  app.add("--svg", "FILE", options->svg_file, "Write the timing diagram to FILE");
  app.flag("--adjust", options->adjust,
           "Round periods if the basic period would be too short, instead of reporting an error");
  app.flag("--why", options->why, "Explain which core each module runs on, and which module waits for which");
  config::add_times_option(app, options->times);
  add_format_option(app, context, {Format::Table, Format::Json, Format::Csv, Format::Svg});
  return [options](Context& c) { return plan(c, *options); };
}

}  // namespace

const Verb kPlanVerb{
    "plan", "Before it runs", "Show the schedule: which modules run in which basic period, and in which order",
    "Works without the module files, because only periods, offsets and priorities matter. For modules with\n"
    "<wcet>, or with --times, it shows the latest time at which each module ends. -o svg prints a timing diagram\n"
    "for a browser or a document. For a plant, all boards are shown.\n"
    "Examples:\n"
    "  indurop plan\n"
    "  indurop plan plant.xml -o svg > plan.svg\n"
    "  indurop plan module.xml --times report.json --why\n",
    &declare_plan};

}  // namespace indurop::tools
