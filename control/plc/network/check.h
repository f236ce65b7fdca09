// SPDX-License-Identifier: Apache-2.0
// Checks the drawing of a ladder or function block diagram, independent of the meaning of its names.

#pragma once

#include "control/plc/model/diagnostics.h"
#include "control/plc/network/networks.h"
#include "control/plc/network/order.h"

namespace indurop::plc::network {

// Reports pins and contacts without a connection, connections to nothing, several sources of one value, circles, and
// jumps without a label. The places of the elements must be named (split_networks).
void check_networks(const Diagram& diagram, const std::vector<Network>& networks, const Index& index,
                    const Order& order, Body::Language language, Diagnostics& diagnostics);

}  // namespace indurop::plc::network
