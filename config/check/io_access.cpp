// SPDX-License-Identifier: Apache-2.0
#include "config/check/io_access.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <system_error>
#include <utility>

#include "config/check/csv_table.h"
#include "config/check/io_binding.h"
#include "config/check/io_fmu.h"
#include "config/check/io_mapping.h"
#include "config/xml/io_reader.h"
#include "core/base/text.h"

namespace indurop::config {
namespace {

const Property* find_property(const Module& module, std::string_view name) {
  const auto found = std::find_if(module.properties.begin(), module.properties.end(),
                                  [name](const Property& p) { return p.name == name; });
  return found == module.properties.end() ? nullptr : &*found;
}

void add(const std::optional<schema::Place>& place, std::vector<const schema::Variable*>& to) {
  if (place) {
    to.push_back(place->variable);
  }
}

// Reports the errors in recorded values that a node would report at its start.
void check_csv(const BoundDevice& bound, CheckContext& context) {
  const IoDevice& device = bound.device;
  std::error_code ignored;
  if (device.driver != IoDriver::Csv ||
      (!context.options.machine && !std::filesystem::exists(device.csv.file, ignored))) {
    return;
  }
  std::vector<IoPoint> inputs;
  for (const BoundPoint& point : bound.points) {
    inputs.push_back(point.point);
  }
  if (auto source = read_csv_device(device, inputs); !source) {
    auto& all = context.result.diagnostics;
    all.insert(all.end(), source.error().begin(), source.error().end());
  }
}

}  // namespace

bool is_io_module(const schema::ModuleFile& file) noexcept {
  return std::find(file.exports.begin(), file.exports.end(), kIoModuleSymbol) != file.exports.end();
}

std::optional<std::filesystem::path> io_config_of(const Module& module, const std::filesystem::path& folder) {
  const Property* config = find_property(module, kIoConfigProperty);
  if (config == nullptr || config->value.empty()) {
    return std::nullopt;
  }
  return (folder / config->value).lexically_normal();
}

std::vector<IoDevice> io_devices_of(const Module& module, const std::filesystem::path& folder) {
  const auto file = io_config_of(module, folder);
  ReadIo read = file ? read_io_config(*file) : ReadIo();
  return read.ok() ? std::move(read.config.devices) : std::vector<IoDevice>();
}

std::vector<std::filesystem::path> io_files_of(const Module& module, const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> files;
  const auto config = io_config_of(module, folder);
  const auto file = schema::read_module_file(module.file);
  // Files of the board itself cannot be read here; then the name decides.
  const bool is_io = file ? is_io_module(file.value()) : module.file.filename() == "libiodispat.so";
  if (!config || !is_io || std::filesystem::path(find_property(module, kIoConfigProperty)->value).is_absolute()) {
    return files;
  }
  files.push_back(*config);
  for (const IoDevice& device : read_io_config(*config).config.devices) {
    if (!device.csv.as_written.empty() && !std::filesystem::path(device.csv.as_written).is_absolute()) {
      files.push_back(device.csv.file);
    }
    if (!device.fmu.as_written.empty() && !std::filesystem::path(device.fmu.as_written).is_absolute()) {
      files.push_back(device.fmu.file);
    }
    const std::string& description = device.slave.description_as_written;
    if (!description.empty() && !std::filesystem::path(description).is_absolute()) {
      files.push_back(device.slave.description);
    }
  }
  return files;
}

schema::Schema io_variables_of(const Module& module, const std::filesystem::path& folder) {
  const auto file = io_config_of(module, folder);
  return file ? fmu_variables(read_io_config(*file).config) : schema::Schema();
}

IoAccess io_access_of(const Module& module, CheckContext& context) {
  IoAccess access;
  const auto file = io_config_of(module, context.config.file.parent_path());
  if (!file) {
    context.report.error(module.place, "module " + module.name +
                                           " needs an ioconfig.xml; add <property><value "
                                           "name=\"config\">ioconfig.xml</value></property>");
    return access;
  }
  const Property* phase = find_property(module, "phase");
  const std::string word = phase == nullptr ? "both" : phase->value;
  if (word != "both" && word != "inputs" && word != "outputs") {
    context.report.error(module.place, "module " + module.name + ": phase is " + base::in_quotes(word) +
                                           "; write both, inputs or outputs");
  }
  if (!context.options.machine && !std::filesystem::exists(*file)) {
    context.report.note(module.places.file,
                        fmt::format("{} does not exist; the variables that {} reads and writes are unknown",
                                    file->string(), module.name));
    return access;
  }
  ReadIo read = read_io_config(*file);
  const auto devices = bind_io(read.config, context.result.schema, read.diagnostics);
  context.result.diagnostics.insert(context.result.diagnostics.end(), read.diagnostics.begin(), read.diagnostics.end());
  std::vector<const BoundDevice*> described;
  for (const BoundDevice& device : devices) {
    if (word != "outputs") {
      check_csv(device, context);
    }
    if (device.device.driver == IoDriver::Fmu && context.options.machine && !context.options.simulation) {
      context.report.warning(module.places.file, fmt::format("device {} is an FMU and runs in simulations only "
                                                             "(indurop run --sim)",
                                                             device.device.name));
    }
    const std::filesystem::path& description = device.device.slave.description;
    if (!description.empty() && (context.options.machine || std::filesystem::exists(description))) {
      described.push_back(&device);
    }
    add(device.quality, access.writes);
    add(device.errors, access.writes);
    add(device.cut, access.writes);
    add(device.cable_errors, access.writes);
    for (const BoundPoint& bound : device.points) {
      if (word == (bound.point.output ? "inputs" : "outputs")) {
        continue;
      }
      (bound.point.output ? access.reads : access.writes).push_back(bound.variable.variable);
      add(bound.quality, access.writes);
    }
  }
  check_mappings(described, *file, context.result.diagnostics);
  return access;
}

}  // namespace indurop::config
