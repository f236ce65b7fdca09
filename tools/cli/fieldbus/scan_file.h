// SPDX-License-Identifier: Apache-2.0
// Devices of an ioconfig.xml for slaves of an EtherCAT bus: for those that a scan has found, or that files describe.

#pragma once

#include <string>
#include <vector>

#include "control/io/ethercat/master/scan.h"

namespace indurop::tools {

// Where a device is, and what its variables are called.
struct DevicePlace {
  std::string interface;
  std::size_t slave = 0;
  std::string space;  // names of variables begin with it; the user of the file declares them
};

// The device for a slave: a drive gets structs for its objects, another slave a point for each object. `children` are
// lines that come before its points. Empty if the slave exchanges nothing.
std::string device_text(const io::ethercat::Sii& sii, const DevicePlace& place, const std::string& children);

// A device for each slave with process data.
std::string scan_file(const std::vector<io::ethercat::FoundSlave>& slaves, const std::string& interface,
                      const std::string& space);

}  // namespace indurop::tools
