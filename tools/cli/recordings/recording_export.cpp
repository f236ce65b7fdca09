// SPDX-License-Identifier: Apache-2.0
#include "tools/cli/recordings/recording_export.h"

#include <fmt/format.h>

#include "core/base/replace_file.h"
#include "tools/cli/recordings/recorded_csv.h"
#include "tools/cli/recordings/recorded_trace.h"

namespace indurop::tools {
namespace {

// Returns false after an error message.
bool save(Context& context, const std::string& file, const Result<Exported, base::Problem>& made, const char* what,
          const char* hint) {
  if (!made) {
    context.out.error(made.error().text);
    return false;
  }
  for (const std::string& damage : made->damages) {
    context.out.note(damage);
  }
  if (const auto saved = base::replace_file(file, made->text, base::Durable::No); !saved) {
    context.out.error(base::cannot_write(file, saved.error()));
    return false;
  }
  context.out.note(fmt::format("wrote {} {} to {}{}", made->count, what, file, hint));
  return true;
}

}  // namespace

int export_recording(Context& context, const ExportOptions& options) {
  if (options.csv.empty() && options.trace.empty()) {
    context.out.error("name the output: --csv FILE, --trace FILE, or both");
    return kUsage;
  }
  bool good = true;
  if (!options.csv.empty()) {
    const CsvOptions csv{options.names, options.every_ns, options.units};
    good = save(context, options.csv, recorded_csv(options.file, csv), "rows", "") && good;
  }
  if (!options.trace.empty()) {
    good =
        save(context, options.trace, recorded_trace(options.file), "runs", "; open it with https://ui.perfetto.dev") &&
        good;
  }
  return good ? kOk : kFailed;
}

void add_recording_export(base::Options& app, const std::shared_ptr<Action>& chosen) {
  auto options = std::make_shared<ExportOptions>();
  base::Options& verb =
      app.command("export", "Write values as CSV, or runs as a trace for Perfetto",
                  [options, chosen] { *chosen = [options](Context& c) { return export_recording(c, *options); }; });
  verb.add("file", "FILE.mcap", options->file, "The recording").required().completes(base::Completion::File);
  verb.add("names", "GLOB", options->names, "With --csv: variables, or globs; none: all");
  verb.add("--csv", "FILE", options->csv, "Write values, with a row for each time at which one changed");
  verb.add("--trace", "FILE", options->trace, "Write when each module ran, for https://ui.perfetto.dev");
  add_time_option(verb, "--every", options->every_ns,
                  "With --csv: interval of the rows (default: a row whenever a value changed)");
  verb.flag("--units", options->units, "With --csv: headings as \"NAME [unit]\", for chart");
  verb.details(
      "Each number of a variable is a column, such as joints[1].y; a value is valid until it changes. time_ns is\n"
      "wall-clock time, or virtual time for simulations. indurop chart draws such a file. Enumerators are numbers.\n");
}

}  // namespace indurop::tools
