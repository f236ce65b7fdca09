// SPDX-License-Identifier: Apache-2.0
// --network delay=200us,jitter=50us,loss=0.001,seed=7 of a simulated plant.

#pragma once

#include <string>
#include <string_view>

#include "config/model/simulated_network.h"

namespace indurop::config {

// Changes what is named. Returns what is wrong with the text; empty: nothing.
std::string read_network(std::string_view text, SimulatedNetwork& network);

}  // namespace indurop::config
