// SPDX-License-Identifier: Apache-2.0
// The field devices of a node of this host, from the files of its I/O modules, and the variables that have their
// quality.

#pragma once

#include <string>
#include <vector>

#include "tools/client/node/run_view.h"

namespace indurop::serve {

struct IoDeviceName {
  std::string name;
  std::string quality;  // variable; never empty
};

// Returns the devices that have a variable for their quality; none if the files cannot be read. Reads files.
std::vector<IoDeviceName> io_devices_of(const std::string& board, const tools::RunView& run);

}  // namespace indurop::serve
