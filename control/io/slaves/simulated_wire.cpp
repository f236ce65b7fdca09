// SPDX-License-Identifier: Apache-2.0
#include "control/io/slaves/simulated_wire.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <map>
#include <string>

#include "control/io/slaves/script.h"
#include "core/base/diagnostics.h"
#include "core/base/read_file.h"
#include "core/base/text.h"

namespace indurop::io::slaves {

namespace {

using WireByAddress = std::map<std::string, std::unique_ptr<ethercat::Wire>>;

bool is_ring(const std::string& address) {
  return address.find(',') != std::string::npos;
}

std::vector<ethercat::Fault> faults_of(const config::IoSimulation& simulation, base::Diagnostics& report,
                                       std::vector<base::Diagnostic>& wrong) {
  if (simulation.script.empty()) {
    return {};
  }
  const auto text = base::read_file(simulation.script);
  if (!text) {
    report.error(simulation.script_place, base::cannot_read(simulation.script, text.error()));
    return {};
  }
  Script script = read_script(*text, simulation.script, simulation.slaves.size());
  std::move(script.diagnostics.begin(), script.diagnostics.end(), std::back_inserter(wrong));
  return std::move(script.faults);
}

std::unique_ptr<SimulatedWire> wire_of(const config::IoSimulation& simulation, const VirtualClock& clock,
                                       base::Diagnostics& report, std::vector<base::Diagnostic>& wrong) {
  auto wire = std::make_unique<SimulatedWire>(clock, is_ring(simulation.address));
  for (const std::string& word : simulation.slaves) {
    auto model = read_slave_word(word, simulation.folder);
    if (!model) {
      report.error(simulation.slaves_place, model.error());
      continue;
    }
    if (const std::string wrong_place = wire->add(std::move(*model)); !wrong_place.empty()) {
      report.error(simulation.slaves_place, wrong_place);
    }
  }
  wire->set_faults(faults_of(simulation, report, wrong));
  return wire;
}

}  // namespace

SimulatedWire::SimulatedWire(VirtualClock clock, bool is_ring) : clock_(std::move(clock)), seen_(clock_()) {
  if (is_ring) {
    ring_.emplace(bus_, bus_.make_ring());
  }
}

std::string SimulatedWire::add(SlaveModel model) {
  return add_slave(bus_.segment(), std::move(model), [this] { return time_; });
}

void SimulatedWire::pass(ethercat::Clock time) noexcept {
  time_ += time;
  bus_.segment().compute();
  bus_.advance(time_);
}

ethercat::Clock SimulatedWire::now() noexcept {
  const std::int64_t is = clock_();
  const std::int64_t passed = is - std::exchange(seen_, is);
  if (passed > 0) {
    pass(ethercat::Clock(passed));
    for (ethercat::Fault& fault : std::exchange(faults_, {})) {
      fault.at += time_;
      bus_.add_fault(fault);
    }
  }
  return time_;
}

Result<EthercatWires, std::vector<base::Diagnostic>> simulated_wires(const config::IoConfig& config,
                                                                     const VirtualClock& clock) {
  std::vector<base::Diagnostic> wrong;
  base::Diagnostics report(config.file.string(), wrong);
  const auto wires = std::make_shared<WireByAddress>();
  for (const config::IoSimulation& simulation : config.simulations) {
    (*wires)[simulation.address] = wire_of(simulation, clock, report, wrong);
  }
  for (const config::IoDevice& device : config.devices) {
    if (device.driver == config::IoDriver::Ethercat && wires->count(device.address) == 0) {
      report.error(device.place, fmt::format("a simulation has no cable; say which slaves it has instead: <simulation "
                                             "address=\"{}\" slaves=\"drive drive terminals.xml:EL2004\"/>",
                                             device.address));
      (*wires)[device.address] = nullptr;  // once is enough
    }
  }
  if (!wrong.empty()) {
    return wrong;
  }
  return EthercatWires{[wires](const std::string& address) -> Result<std::unique_ptr<ethercat::Wire>, std::string> {
                         std::unique_ptr<ethercat::Wire> wire = std::move((*wires)[address]);
                         if (wire == nullptr) {
                           return fmt::format("the simulated bus {} is in use already", address);
                         }
                         return wire;
                       },
                       true};
}

}  // namespace indurop::io::slaves
