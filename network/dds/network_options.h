// SPDX-License-Identifier: Apache-2.0
// Command line options for the network, the same in all programs.

#pragma once

#include <string>

#include "core/base/options.h"
#include "network/dds/network_settings.h"

namespace indurop::dds {

// Adds --domain (of `whose`), --interface and --one-host. The values in `network` are the defaults. `implied` (may be
// null) becomes true if one of them is given; the help then states that it implies `implied_option`.
void add_network_options(base::Options& line, NetworkSettings& network, const std::string& whose,
                         bool* implied = nullptr, const std::string& implied_option = "");

}  // namespace indurop::dds
