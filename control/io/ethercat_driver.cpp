// SPDX-License-Identifier: Apache-2.0
#include "control/io/ethercat_driver.h"

#include <algorithm>
#include <utility>

namespace indurop::io {

EthercatDriver::EthercatDriver(const config::IoDevice& device, std::span<const config::IoPoint> outputs,
                               std::span<const config::IoPoint> inputs, Excludes excludes,
                               std::shared_ptr<EthercatBus> bus)
    : bus_(std::move(bus)),
      member_(bus_->add({device.name,
                         device.slave,
                         {outputs.begin(), outputs.end()},
                         {inputs.begin(), inputs.end()},
                         std::move(excludes)})) {}

Driver::Outcome EthercatDriver::exchange(std::span<Sample> outputs, std::span<Sample> inputs,
                                         std::chrono::nanoseconds /*elapsed*/) {
  ethercat::Master* const master = bus_->begin_turn();
  const Outcome outcome = master != nullptr ? exchange(*master, outputs, inputs) : Outcome::Lost;
  if (master != nullptr) {
    cable_errors_ = master->slave(bus_->place(member_)).port_errors();
  }
  bus_->end_turn();
  if (outcome == Outcome::Lost) {
    for (const std::span<Sample> samples : {outputs, inputs}) {
      std::for_each(samples.begin(), samples.end(), [](Sample& sample) { sample.quality = Quality::Lost; });
    }
  }
  return outcome;
}

Driver::Outcome EthercatDriver::exchange(ethercat::Master& master, std::span<Sample> outputs,
                                         std::span<Sample> inputs) const noexcept {
  const std::size_t place = bus_->place(member_);
  bool is_whole = true;
  const auto& output_fields = bus_->outputs(member_);
  const auto to = master.outputs(place);
  for (std::size_t i = 0; i < outputs.size(); ++i) {
    Sample& sample = outputs[i];
    if (!output_fields[i]) {
      sample.quality = Quality::Refused;
      is_whole = false;
    } else if (sample.quality == Quality::Good && !write_field(*output_fields[i], sample.value, to)) {
      sample.quality = Quality::OutOfRange;
    }
  }
  master.set_outputs_good(place, true);
  if (!master.is_fresh(place)) {
    return Outcome::Lost;
  }
  const auto& input_fields = bus_->inputs(member_);
  const auto from = master.inputs(place);
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    if (!input_fields[i]) {
      inputs[i].quality = Quality::Refused;
      is_whole = false;
    } else {
      inputs[i] = {read_field(*input_fields[i], from), Quality::Good};
    }
  }
  return is_whole ? Outcome::Good : Outcome::Partly;
}

}  // namespace indurop::io
