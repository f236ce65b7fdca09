// SPDX-License-Identifier: Apache-2.0
// Where the EtherCAT buses of a module get their wires from.

#pragma once

#include <functional>
#include <memory>
#include <string>

#include "control/io/ethercat/link/wire.h"

namespace indurop::io {

struct EthercatWires {
  // By the address in ioconfig.xml, once for each bus. Errors: what is wrong there.
  std::function<Result<std::unique_ptr<ethercat::Wire>, std::string>(const std::string& address)> open =
      ethercat::NetworkWire::open;
  // Of a simulation: slaves are there at once, so nothing has to wait for them.
  bool is_simulated = false;
};

}  // namespace indurop::io
