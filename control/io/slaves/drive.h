// SPDX-License-Identifier: Apache-2.0
// A servo drive as an EtherCAT slave: the simulated CiA 402 drive after a mailbox and process data that its master
// maps. What it is, its master reads in its EEPROM.

#pragma once

#include <optional>

#include "control/io/cia402_drive.h"
#include "control/io/ethercat/simulator/mapped_objects.h"
#include "control/io/ethercat/simulator/slave.h"

namespace indurop::io::slaves {

class Drive {
 public:
  explicit Drive(const config::IoAxis& axis) : drive_(axis) {}

  // The slave, without its application. `alias`: a number by which a master can find it; 0: none.
  static ethercat::SlaveConfig slave(std::uint16_t alias = 0);
  // The slave that it is part of, before compute(); borrowed until the end.
  void attach(ethercat::Slave& slave);
  // The application of the slave: moves the axis up to this time, with what it has got, and fills in where it is then.
  void compute(ethercat::Bytes outputs, std::span<std::uint8_t> inputs, ethercat::Time now);

 private:
  Cia402Drive drive_;
  ethercat::ObjectDictionary* objects_ = nullptr;
  std::optional<ethercat::MappedObjects> mapped_;
  ethercat::Time last_{0};
};

}  // namespace indurop::io::slaves
