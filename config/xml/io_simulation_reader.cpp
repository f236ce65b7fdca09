// SPDX-License-Identifier: Apache-2.0
#include "config/xml/io_simulation_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>

#include "config/xml/attributes.h"
#include "config/xml/element_rules.h"
#include "core/base/text.h"

namespace indurop::config {

void read_io_simulation(const base::Element& element, IoConfig& config, base::Diagnostics& report) {
  IoSimulation simulation;
  simulation.place = element.place;
  simulation.folder = config.file.parent_path();
  Attributes attributes(element, report);
  simulation.address = attributes.need("address", "address=\"eth1\"").value_or("");
  std::istringstream slaves(
      attributes.need("slaves", "slaves=\"drive drive terminals.xml:EL2004\"", &simulation.slaves_place).value_or(""));
  for (std::string word; slaves >> word;) {
    simulation.slaves.push_back(word);
  }
  if (const auto script = attributes.text("script", &simulation.script_place)) {
    simulation.script = (simulation.folder / *script).lexically_normal();
  }
  attributes.finish();
  check_no_text(element, report);
  for (const base::Element& child : element.children) {
    is_known(child, element, {}, report);
  }
  const auto same =
      std::find_if(config.simulations.begin(), config.simulations.end(),
                   [&simulation](const IoSimulation& other) { return other.address == simulation.address; });
  if (same != config.simulations.end()) {
    report.error(simulation.place,
                 fmt::format("{} has a <simulation> already, in line {}; name all of its slaves there",
                             base::in_quotes(simulation.address), same->place.line));
  }
  config.simulations.push_back(std::move(simulation));
}

void check_io_simulations(const IoConfig& config, base::Diagnostics& report) {
  std::vector<std::string> addresses;
  for (const IoDevice& device : config.devices) {
    if (device.driver == IoDriver::Ethercat) {
      addresses.push_back(device.address);
    }
  }
  for (const IoSimulation& simulation : config.simulations) {
    if (!simulation.address.empty() &&
        std::find(addresses.begin(), addresses.end(), simulation.address) == addresses.end()) {
      report.error(simulation.place,
                   fmt::format("no EtherCAT device has the address {}{}", base::in_quotes(simulation.address),
                               base::suggestion(simulation.address, addresses)));
    }
  }
}

}  // namespace indurop::config
