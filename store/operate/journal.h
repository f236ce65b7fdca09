// SPDX-License-Identifier: Apache-2.0
// The journal of commands: which user set, forced, released, locked, stopped or started what of a node. Lines of JSON
// in the node's folder, the newest few thousand. Not real-time safe.

#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/base/json.h"

namespace indurop::operate {

struct Order {
  std::int64_t node_ns = 0;  // the node's time; 0: not known
  std::int64_t wall_ns = 0;  // CLOCK_REALTIME
  std::string who;           // user
  std::string from;          // host, or address
  std::string action;        // "set", "force", "unforce", "lock", "stop", "start", "restart"
  std::string what;          // full name of the variable or part, or name of the module
  std::string value;
  std::int64_t until_ns = 0;  // when a force ends; INT64_MAX: when it is released; 0: not known
  std::string reason;
};

// Appends a line. `order` has the action and the node's time; the journal adds the wall time and, if `who` is empty,
// the user of this process. If the folder cannot be written nothing is noted.
void note(const std::string& node, Order order);
// Returns the commands since a time (CLOCK_REALTIME), oldest first.
std::vector<Order> read_orders(const std::string& node, std::int64_t since_wall_ns);

base::Json json_of(const Order& order);
// Returns false if it is no command; missing fields stay unchanged.
bool read_order(const base::Json& json, Order& order);

}  // namespace indurop::operate
