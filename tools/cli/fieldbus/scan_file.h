// SPDX-License-Identifier: Apache-2.0
// An ioconfig.xml for the slaves that a scan of an EtherCAT bus has found.

#pragma once

#include <string>
#include <vector>

#include "control/io/ethercat/master/scan.h"

namespace indurop::tools {

// A device for each slave with process data: a drive gets structs for its objects, another slave a point for each
// object. Names of variables begin with `space`; the user of the file declares them.
std::string scan_file(const std::vector<io::ethercat::FoundSlave>& slaves, const std::string& interface,
                      const std::string& space);

}  // namespace indurop::tools
