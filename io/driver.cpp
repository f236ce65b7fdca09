// SPDX-License-Identifier: Apache-2.0
// The one place that knows all drivers.

#include "io/driver.h"

#include "io/cia402_driver.h"
#include "io/csv_driver.h"
#include "io/modbus_driver.h"

namespace indurop::io {

std::unique_ptr<Driver> make_driver(const deploy::IoDevice& device, std::span<const deploy::IoPoint> outputs,
                                    std::span<const deploy::IoPoint> inputs, std::string& problem) {
  switch (device.driver) {
    case deploy::IoDriver::ModbusTcp:
    case deploy::IoDriver::ModbusRtu:
      return std::make_unique<ModbusDriver>(device, outputs, inputs);
    case deploy::IoDriver::Cia402:
      return std::make_unique<Cia402Driver>(device, outputs, inputs);
    case deploy::IoDriver::Csv:
      return CsvDriver::make(device, inputs, problem);
  }
  return nullptr;
}

}  // namespace indurop::io
