// SPDX-License-Identifier: Apache-2.0
// A device as an EtherCAT slave whose outputs become values of its objects and whose inputs are values of its objects:
// what stands in a script, or what an SDO has written.

#pragma once

#include <optional>
#include <vector>

#include "control/io/ethercat/simulator/mapped_objects.h"
#include "control/io/ethercat/simulator/slave.h"

namespace indurop::io::slaves {

class Terminal {
 public:
  // The slave, with an object for each entry of its PDOs. Its EEPROM is this image, or made of what is in it.
  static ethercat::SlaveConfig slave(const ethercat::Sii& sii, std::vector<std::uint8_t> image = {});
  // The slave that it is part of, before compute(); borrowed until the end.
  void attach(ethercat::Slave& slave) { mapped_.emplace(slave.objects(), slave.sii()); }
  void compute(ethercat::Bytes outputs, std::span<std::uint8_t> inputs);

 private:
  std::optional<ethercat::MappedObjects> mapped_;
};

}  // namespace indurop::io::slaves
