// SPDX-License-Identifier: Apache-2.0
// How the program takes part in the network of its board.

#pragma once

#include <indurop/result.h>

#include <string>

#include "doors/pools/options.h"
#include "tools/client/failure.h"

namespace indurop::pool_door {

// The settings of the command line, completed: with the keys of the node's board if its plant has keys and none were
// given. Errors: the plant has keys, or may have some, and they cannot be used. Without them, any program in the
// network would see its images.
Result<dds::NetworkSettings, tools::Failure> own_network(const DoorOptions& options, const std::string& node);

}  // namespace indurop::pool_door
