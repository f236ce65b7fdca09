// SPDX-License-Identifier: Apache-2.0
// Facts from module.xml, plant.xml and ioconfig.xml: who writes what, who waits for whom, which field devices there
// are.

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <system_error>
#include <utility>

#include "config/check/io_access.h"
#include "config/check/uses.h"
#include "config/xml/plant_reader.h"
#include "core/schema/leaf.h"
#include "scheduler/words.h"
#include "tools/cli/explain/gather.h"
#include "tools/client/config/checked_config.h"

namespace indurop::tools {
namespace {

using explain::Facts;

// Adds the properties of one board's modules, unless they are known from a run.
void add_modules(const config::Config& config, const config::CheckResult& check, bool known, Facts& facts) {
  for (const config::Module& module : config.modules) {
    const auto found = std::find_if(facts.modules.begin(), facts.modules.end(),
                                    [&](const explain::ModuleFact& one) { return one.name == module.name; });
    if (found == facts.modules.end() || known) {
      continue;
    }
    found->operation = to_text(module.operation);
    found->type = to_text(module.type);
    found->period_ns = module.operation == scheduler::Operation::Periodic ? module.period.count() : 0;
    found->offset_ns = module.offset.count();
    found->deadline_ns = module.deadline.count();
    found->priority = module.priority;
    found->core = module.core;
  }
  for (const config::Sharing& sharing : check.sharing) {
    const std::string& first = config.modules[sharing.first].name;
    const std::string& second = config.modules[sharing.second].name;
    for (explain::ModuleFact& module : facts.modules) {
      if (module.name == second) {
        module.after.push_back(first);
      }
    }
  }
}

std::string place_of(const config::IoDevice& device) {
  const std::string place = fmt::format("{} {}", name_of(device.driver), device.address);
  if (device.driver != config::IoDriver::Ethercat) {
    return place;
  }
  return device.slave.alias ? fmt::format("{}, alias {}", place, *device.slave.alias)
                            : fmt::format("{}, slave {}", place, device.slave.position);
}

// Adds a device, or a point of one that has a quality of its own.
void add_device(explain::DeviceFact device, const schema::Schema& schema, Facts& facts,
                std::vector<QualityPlace>& places) {
  const auto place = device.quality.empty() ? schema::Failure{} : schema::find_place(schema, device.quality);
  if (!place) {
    return;
  }
  for (std::string& name : device.variables) {
    const auto part = schema::find_place(schema, name);
    name = part ? part->variable->name : name;
  }
  places.push_back({facts.devices.size(), place->variable->name, place->type, place->offset});
  facts.devices.push_back(std::move(device));
}

void add_devices(const config::Config& config, const std::filesystem::path& folder, const schema::Schema& schema,
                 Facts& facts, std::vector<QualityPlace>& places) {
  for (const config::Module& module : config.modules) {
    for (const config::IoDevice& device : config::io_devices_of(module, folder)) {
      explain::DeviceFact whole{device.name, place_of(device), device.quality, {}, {}};
      for (const config::IoPoint& point : device.points) {
        whole.variables.push_back(point.variable);
        add_device({device.name, place_of(device), point.quality, {point.variable}, {}}, schema, facts, places);
      }
      for (const std::string* structure : {&device.axis.in, &device.axis.out}) {
        if (!structure->empty()) {
          whole.variables.push_back(*structure);
        }
      }
      add_device(std::move(whole), schema, facts, places);
    }
  }
}

void add_plant(const std::string& file, const config::CheckOptions& options, bool known, Facts& facts,
               std::vector<QualityPlace>& places) {
  const CheckedPlant checked = load_plant(file, options);
  facts.lease_ns = checked.plant.lease.count();
  const auto views = config::views_of(checked.plant, checked.check);
  const config::Uses uses(views);
  for (const auto& [name, users] : uses.variables()) {
    explain::VariableFact variable;
    variable.name = name;
    variable.writers = uses.names(users.writers);
    if (const auto owner = checked.check.owners.find(name); owner != checked.check.owners.end()) {
      variable.owner = checked.plant.boards[owner->second].name;
    }
    for (const config::Route& route : checked.check.routes) {
      variable.every_ns = route.variable == name ? route.every.count() : variable.every_ns;
    }
    facts.variables.push_back(std::move(variable));
  }
  for (const config::BoardView& view : views) {
    if (view.name == facts.board) {
      add_modules(view.config, view.result, known, facts);
      add_devices(view.config, std::filesystem::path(file).parent_path(), view.result.schema, facts, places);
    }
  }
}

}  // namespace

void QualityPlace::add(std::int64_t time_ns, std::span<const std::uint8_t> value, Facts& facts) const {
  if (offset + type.size() > value.size()) {
    return;
  }
  auto& known = facts.devices[device].qualities;
  auto number = schema::as_number<std::int64_t>(type.base, value.data() + offset);
  if (type.base == schema::Base::Bool && number == 0) {
    number = explain::DeviceFact::kNotGood;
  }
  if (number && (known.empty() || known.back().number != *number)) {
    known.push_back({time_ns, *number});
  }
}

std::vector<QualityPlace> add_config(const std::string& config, Facts& facts) {
  std::error_code error;
  std::vector<QualityPlace> places;
  if (config.empty() || !std::filesystem::exists(config, error)) {
    return places;
  }
  const config::CheckOptions options{.files = true, .adjust = true};
  const bool known = std::any_of(facts.modules.begin(), facts.modules.end(),
                                 [](const explain::ModuleFact& one) { return !one.operation.empty(); });
  if (config::is_plant_file(config)) {
    add_plant(config, options, known, facts, places);
    return places;
  }
  const CheckedConfig checked = load_config(config, options);
  for (const config::VariableUse& use : checked.check.uses) {
    facts.variables.push_back({use.name, use.writers, {}, 0, 0});
  }
  add_modules(checked.config, checked.check, known, facts);
  add_devices(checked.config, std::filesystem::path(config).parent_path(), checked.check.schema, facts, places);
  return places;
}

}  // namespace indurop::tools
