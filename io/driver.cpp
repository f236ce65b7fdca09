// SPDX-License-Identifier: Apache-2.0
// The one place that knows all drivers.

#include "io/driver.h"

#include "io/cia402_driver.h"
#include "io/csv_driver.h"
#include "io/modbus_driver.h"

namespace indurop::io {

std::unique_ptr<Driver> make_driver(const config::IoDevice& device, std::span<const config::IoPoint> outputs,
                                    std::span<const config::IoPoint> inputs, std::string& problem) {
  switch (device.driver) {
    case config::IoDriver::ModbusTcp:
    case config::IoDriver::ModbusRtu:
      return std::make_unique<ModbusDriver>(device, outputs, inputs);
    case config::IoDriver::Cia402:
      return std::make_unique<Cia402Driver>(device, outputs, inputs);
    case config::IoDriver::Csv:
      return CsvDriver::make(device, inputs, problem);
  }
  return nullptr;
}

}  // namespace indurop::io
