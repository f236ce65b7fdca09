// SPDX-License-Identifier: Apache-2.0
#include "tools/cli/fieldbus/import_fmu.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "config/check/io_fmu.h"
#include "config/xml/io_reader.h"
#include "control/io/fmu/fmu_file.h"
#include "core/base/printable.h"
#include "core/base/read_file.h"
#include "core/base/replace_file.h"
#include "core/base/xml_text.h"
#include "glb2idl/names.h"
#include "tools/cli/fieldbus/import_file.h"
#include "tools/console/diagnostics.h"

namespace indurop::tools {

namespace {

namespace fs = std::filesystem;
using io::fmu::Causality;
using io::fmu::Variability;
using io::fmu::Variable;

std::string start_text(const Variable& variable) {
  return fmt::format("{}", fmt::join(variable.start, " "));
}

void print_variables(Context& context, const io::fmu::Description& description) {
  Table table({{"NAME", "name"},
               {"TYPE", "type"},
               {"CAUSALITY", "causality"},
               {"UNIT", "unit"},
               {"START", "start"},
               {"DESCRIPTION", "description"}});
  for (const Variable& variable : description.variables) {
    const std::string sizes =
        variable.dims.empty() ? std::string() : fmt::format("[{}]", fmt::join(variable.dims, ","));
    table.add(
        {Cell(variable.name, Style::Bold), Cell(io::fmu::name_of(variable.type) + sizes),
         Cell(std::string(io::fmu::name_of(variable.causality)) +
              (variable.causality == Causality::Parameter && variable.variability == Variability::Tunable ? " (tunable)"
                                                                                                          : "")),
         Cell(variable.unit), Cell(start_text(variable)), Cell(variable.description)});
  }
  print_table(context, table, JsonValue::object(), "variables");
}

std::string comment_line(std::string text) {
  for (std::size_t at = text.find("--"); at != std::string::npos; at = text.find("--")) {
    text.replace(at, 2, "- -");  // "--" ends a comment
  }
  return fmt::format("    <!-- {}-->\n", text);
}

// The parameters with their start values, for a user to change.
std::string parameters_text(const io::fmu::Description& description) {
  constexpr std::size_t kMaxShown = 100;
  std::string text;
  std::size_t shown = 0;
  for (const Variable& variable : description.variables) {
    if (variable.causality == Causality::Parameter && !variable.start.empty() && !start_text(variable).empty() &&
        shown++ < kMaxShown) {
      const std::string unit = variable.unit.empty() ? "" : base::xml_text(variable.unit) + " ";
      text += comment_line(fmt::format("<set at=\"{}\" value=\"{}\"/> {}", base::xml_text(variable.name),
                                       base::xml_text(start_text(variable)), unit));
    }
  }
  return text;
}

config::IoDevice device_of(const ImportRequest& request) {
  config::IoDevice device;
  device.driver = config::IoDriver::Fmu;
  device.fmu.file = request.files.front();
  device.fmu.as_written = device.fmu.file.filename().string();
  std::string name = device.fmu.file.stem().string();
  std::replace_if(
      name.begin(), name.end(), [](unsigned char c) { return c >= 0x80 || std::isalnum(c) == 0; }, '_');
  device.name = std::isdigit(static_cast<unsigned char>(name.front())) != 0 ? "_" + name : name;
  device.fmu.variables = request.space.empty() ? device.name : request.space;
  return device;
}

int write_device(Context& context, const ImportRequest& request, const io::fmu::Description& description) {
  const config::IoDevice device = device_of(request);
  std::string xml = kEmptyIoConfig;
  if (fs::exists(request.to)) {
    auto present = base::read_file(request.to);
    if (!present) {
      context.out.error(base::cannot_read(request.to, present.error()));
      return kFailed;
    }
    xml = std::move(*present);
  }
  const fs::path folder = fs::absolute(request.to).parent_path();
  const std::string parameters = parameters_text(description);
  const std::string head =
      fmt::format("  <device name=\"{}\" driver=\"fmu\" file=\"{}\" variables=\"{}\"", device.name,
                  base::xml_text(fs::proximate(fs::absolute(device.fmu.file), folder).string()), device.fmu.variables);
  const std::size_t end = xml.rfind(kIoConfigEnd);
  if (end == std::string::npos) {
    context.out.error(fmt::format("{} has no {}; name an ioconfig.xml", request.to.string(), kIoConfigEnd));
    return kFailed;
  }
  xml.insert(end, parameters.empty() ? head + "/>\n" : head + ">\n" + parameters + "  </device>\n");
  const config::ReadIo read = config::read_io_config_text(xml, request.to);
  print_diagnostics(context, read.diagnostics, false);
  if (!read.ok()) {
    return kFailed;
  }
  if (const auto written = base::replace_file(request.to, xml, base::Durable::No); !written) {
    context.out.error(base::cannot_write(request.to, written.error()));
    return kFailed;
  }
  context.out.note(
      fmt::format("{} is written: device {}, variables {}::*", request.to.string(), device.name, device.fmu.variables));
  return kOk;
}

std::string declaration_text(const schema::Variable& variable) {
  const std::string name = variable.name.substr(variable.name.rfind(':') + 1);
  const auto objection = glb2idl::objection(name, glb2idl::NameRole::Variable, false);
  std::string text = objection ? fmt::format("// not possible, the name {}: ", *objection) : "";
  text += fmt::format("{} {}", schema::name_of(variable.type.base), name);
  for (const std::uint32_t dim : variable.type.dims) {
    text += fmt::format("[{}]", dim);
  }
  text += variable.unit.empty() ? "" : fmt::format(" @unit(\"{}\")", variable.unit);
  text += variable.range ? fmt::format(" @range({}, {})", variable.range->min, variable.range->max) : "";
  if (variable.type.dims.empty() && !variable.initial.empty()) {
    text += " = " + schema::format_value(variable.type, variable.initial);
  }
  const std::string description = base::printable(variable.description);  // in one line
  return text + ";" + (description.empty() ? "" : "  // " + description) + "\n";
}

// The declarations of the device's variables, for modules that use them.
int write_glb(Context& context, const ImportRequest& request) {
  const config::IoDevice device = device_of(request);
  config::IoConfig config;
  config.devices.push_back(device);
  const schema::Schema schema = config::fmu_variables(config);
  std::string text = fmt::format(
      "// Inputs and outputs of {}, as its device in ioconfig.xml declares them.\n"
      "namespace {};\n\n",
      device.fmu.as_written, device.fmu.variables);
  for (const schema::Variable& variable : schema.variables) {
    text += declaration_text(variable);
  }
  if (const auto written = base::replace_file(request.glb, text, base::Durable::No); !written) {
    context.out.error(base::cannot_write(request.glb, written.error()));
    return kFailed;
  }
  context.out.note(fmt::format("{} is written: {} variables", request.glb.string(), schema.variables.size()));
  return kOk;
}

bool is_fmu(const std::string& file) {
  return fs::path(file).extension() == ".fmu";
}

}  // namespace

bool names_fmus(const ImportRequest& request) {
  return std::any_of(request.files.begin(), request.files.end(), is_fmu);
}

int import_fmu(Context& context, const ImportRequest& request) {
  if (request.files.size() > 1 || !request.devices.empty()) {
    context.out.error("name one FMU at a time, without --device");
    return kUsage;
  }
  const io::fmu::FmuFile fmu = io::fmu::read_fmu(request.files.front());
  print_diagnostics(context, fmu.diagnostics, false);
  if (!fmu.ok()) {
    return kFailed;
  }
  if (const std::string missing = io::fmu::missing_library(fmu); !missing.empty()) {
    context.out.message_line(fmt::format("warning: {}: {}", request.files.front(), missing));
  }
  int code = kOk;
  if (!request.to.empty()) {
    code = write_device(context, request, fmu.description);
  }
  if (code == kOk && !request.glb.empty()) {
    code = write_glb(context, request);
  }
  if (request.to.empty() && request.glb.empty()) {
    print_variables(context, fmu.description);
  }
  return code;
}

}  // namespace indurop::tools
