// SPDX-License-Identifier: Apache-2.0
// The option --network delay=200us,jitter=50us,loss=0.001,seed=7 of a simulated plant.

#pragma once

#include <string>
#include <string_view>

#include "config/model/simulated_network.h"

namespace indurop::config {

// Changes the settings that `text` names. Returns the error in the text; empty on success.
std::string read_network(std::string_view text, SimulatedNetwork& network);

}  // namespace indurop::config
