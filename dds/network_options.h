// SPDX-License-Identifier: Apache-2.0
// How users say where the others are: the same options in all programs.

#pragma once

#include <string>

#include "base/options.h"
#include "dds/network_settings.h"

namespace indurop::dds {

// Adds --domain (of `whose`), --interface and --one-host. What `network` holds is the default. `implied` (may be null)
// becomes true if one of them is given, and help says that it implies `implied_option`.
void add_network_options(base::Options& line, NetworkSettings& network, const std::string& whose,
                         bool* implied = nullptr, const std::string& implied_option = "");

}  // namespace indurop::dds
