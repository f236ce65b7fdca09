// SPDX-License-Identifier: Apache-2.0
// `indurop-fmu`: makes an FMU of a board or a plant, for co-simulation in other tools.

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "config/xml/plant_reader.h"
#include "core/base/duration.h"
#include "core/base/options.h"
#include "doors/fmi/configuration.h"
#include "doors/fmi/description/choice.h"
#include "doors/fmi/make_fmu.h"
#include "tools/client/text/units.h"
#include "tools/console/diagnostics.h"

namespace indurop::fmi {
namespace {

constexpr const char* kDetails = R"(Checks a module.xml or the manifest of a plant and writes an FMU for co-simulation,
which runs it in virtual time, as indurop run --sim does. It has the modules and the
files that the configuration names; where it runs, the package indurop is needed.
Inputs are the shared variables that no module writes, outputs all others. A GLOB
matches names of variables or of their parts: 'cell::*', 'joints[1].y'.
  indurop-fmu module.xml
  indurop-fmu plant.xml -o cell.fmu --fmi 3
  indurop-fmu plant.xml --inputs 'cell::target' --outputs 'cell::encoder.*'
)";

struct Arguments {
  std::string file = "module.xml";
  std::filesystem::path output;
  std::string version = "2";
  std::vector<std::string> inputs;
  std::vector<std::string> outputs;
  std::vector<std::string> also;
  bool quiet = false;
};

int failed(tools::Context& context, const std::string& text, int code) {
  context.out.error(text);
  return code;
}

// Names modules that an FMU cannot have with it.
void warn_of_absolute_names(tools::Context& context, const config::Plant& plant) {
  for (const config::Board& board : plant.boards) {
    for (const config::Module& module : board.config.modules) {
      if (std::filesystem::path(module.file_as_written).is_absolute()) {
        context.out.message_line(fmt::format(
            "warning: {} is named by an absolute path and is not in the FMU: it has to be there where the FMU runs",
            module.file_as_written));
      }
    }
  }
}

int run(tools::Context& context, const Arguments& arguments) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(arguments.file, error)) {
    return failed(context,
                  fmt::format("'{}' does not exist: name a module.xml, or the manifest of a plant", arguments.file),
                  kUsage);
  }
  Configuration configuration = load_configuration(arguments.file);
  // What the check says about variables that no module writes is what makes them inputs.
  std::erase_if(configuration.diagnostics,
                [](const auto& one) { return one.severity != base::Diagnostic::Severity::Error; });
  tools::print_diagnostics(context, configuration.diagnostics, false);
  if (base::has_error(configuration.diagnostics)) {
    return failed(context, "no FMU was made", kCheckFailed);
  }
  if (configuration.basic_period == base::Nanos::zero()) {
    return failed(context, fmt::format("{} has no periodic module: without ticks no time passes", arguments.file),
                  kCheckFailed);
  }
  const auto choice = choose(configuration.variables, arguments.inputs, arguments.outputs);
  if (!choice) {
    return failed(context, choice.error().text, kUsage);
  }
  for (const std::string& warning : choice->warnings) {
    context.out.message_line("warning: " + warning);
  }
  warn_of_absolute_names(context, configuration.plant);
  FmuRequest request{
      arguments.version == "3" ? Version::Fmi3 : Version::Fmi2,
      arguments.output.empty() ? std::filesystem::path(configuration.plant.name + ".fmu") : arguments.output,
      {arguments.also.begin(), arguments.also.end()},
      "InduRoP " INDUROP_VERSION};
  if (const auto made = make_fmu(configuration, *choice, request); !made) {
    return failed(context, made.error().text, kFailed);
  }
  if (!arguments.quiet) {
    const auto inputs = static_cast<std::size_t>(std::count_if(choice->variables.begin(), choice->variables.end(),
                                                               [](const ChosenVariable& one) { return one.input; }));
    context.out.line(fmt::format("{}: FMI {}.0, {}, {}, basic period {}, {}", request.output.string(),
                                 arguments.version, tools::counted(inputs, "input"),
                                 tools::counted(choice->variables.size() - inputs, "output"),
                                 base::format_duration(configuration.basic_period),
                                 tools::human_bytes(std::filesystem::file_size(request.output, error))));
  }
  return kOk;
}

}  // namespace
}  // namespace indurop::fmi

int main(int argc, char** argv) {
  using namespace indurop;
  tools::Context context;
  fmi::Arguments arguments;
  base::Options app("indurop-fmu", "Create an FMU of a board or a plant, for co-simulation");
  app.version(INDUROP_VERSION);
  app.add("file", "FILE", arguments.file, "A module.xml, or the manifest of a plant (default: module.xml)")
      .completes(base::Completion::File);
  app.add("-o,--output", "FILE", arguments.output,
          "FMU to write (default: NAME.fmu, named after the plant or the file)")
      .completes(base::Completion::File);
  app.add("--fmi", "VERSION", arguments.version, "Version of the standard (default 2)").choices({"2", "3"});
  app.add("--inputs", "GLOB", arguments.inputs, "Variables that are inputs (default: those that no module writes)")
      .one_at_a_time();
  app.add("--outputs", "GLOB", arguments.outputs, "Variables that are outputs (default: all that are not inputs)")
      .one_at_a_time();
  app.add("--also", "FOLDER", arguments.also, "Also allow data from this folder, not only from that of FILE")
      .one_at_a_time()
      .completes(base::Completion::Folder);
  app.flag("-q,--quiet", arguments.quiet, "Print warnings and errors only");
  app.details(fmi::kDetails);
  app.exit_codes({kOk, kFailed, kUsage, kCheckFailed});
  if (const auto code = app.parse_program(argc, argv)) {
    return *code;
  }
  const int code = fmi::run(context, arguments);
  return context.out.flush() ? code : kFailed;
}
