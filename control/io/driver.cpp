// SPDX-License-Identifier: Apache-2.0
// The only place with a list of all drivers.

#include "control/io/driver.h"

#include "config/check/io_mapping.h"
#include "control/io/cia402_driver.h"
#include "control/io/csv_driver.h"
#include "control/io/ethercat_driver.h"
#include "control/io/fmu_driver.h"
#include "control/io/modbus_driver.h"
#include "control/io/modbus_server.h"
#include "control/io/opcua_driver.h"

namespace indurop::io {

namespace {

// Of the maker's description, if the device names one.
Result<Excludes, std::vector<base::Diagnostic>> excludes_of(const config::IoDevice& device) {
  Excludes excludes;
  if (device.slave.description.empty()) {
    return excludes;
  }
  auto described = config::described_slave(device, {});
  if (!described) {
    return std::move(described).error();
  }
  for (const auto* const pdos : {&described->sii.outputs, &described->sii.inputs}) {
    for (const ethercat::Pdo& pdo : *pdos) {
      excludes[pdo.index] = pdo.excludes;
    }
  }
  return excludes;
}

}  // namespace

Result<std::unique_ptr<Driver>, std::vector<base::Diagnostic>> make_driver(const config::IoDevice& device,
                                                                           std::span<const config::IoPoint> outputs,
                                                                           std::span<const config::IoPoint> inputs,
                                                                           EthercatBuses& buses) {
  switch (device.driver) {
    case config::IoDriver::ModbusTcp:
    case config::IoDriver::ModbusRtu:
      return std::unique_ptr<Driver>(std::make_unique<ModbusDriver>(device, outputs, inputs));
    case config::IoDriver::ModbusServer:
      return std::unique_ptr<Driver>(std::make_unique<ModbusServer>(device, outputs, inputs));
    case config::IoDriver::Cia402:
      return std::unique_ptr<Driver>(std::make_unique<Cia402Driver>(device, outputs, inputs));
    case config::IoDriver::Ethercat: {
      auto& bus = buses.by_address[device.address];
      bus = bus != nullptr ? bus : std::make_shared<EthercatBus>(device.address, buses.wires);
      auto excludes = excludes_of(device);
      if (!excludes) {
        return std::move(excludes).error();
      }
      return std::unique_ptr<Driver>(
          std::make_unique<EthercatDriver>(device, outputs, inputs, std::move(*excludes), bus));
    }
    case config::IoDriver::Opcua:
      return std::unique_ptr<Driver>(std::make_unique<OpcuaDriver>(device, outputs, inputs));
    case config::IoDriver::Fmu: {
      auto model = FmuDriver::make(device, outputs, inputs);
      if (!model) {
        return std::move(model).error();
      }
      return std::unique_ptr<Driver>(std::move(model).value());
    }
    case config::IoDriver::Csv:
      break;
  }
  auto recorded = CsvDriver::make(device, inputs);
  if (!recorded) {
    return std::move(recorded).error();
  }
  return std::unique_ptr<Driver>(std::move(recorded).value());
}

}  // namespace indurop::io
