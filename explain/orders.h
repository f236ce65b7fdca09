// SPDX-License-Identifier: Apache-2.0
// Who set, forced, stopped or started what of a node: lines of JSON in the node's folder, the newest few thousand.

#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "explain/facts.h"

namespace indurop::explain {

// Appends a line. `order` has what was done and the node's time; who did it, unless it is said, is the user of this
// process. Where the folder cannot be written nothing is noted.
void note_order(const std::string& node, OrderFact order);
// Those since a time (CLOCK_REALTIME), oldest first.
std::vector<OrderFact> read_orders(const std::string& node, std::int64_t since_wall_ns);

}  // namespace indurop::explain
