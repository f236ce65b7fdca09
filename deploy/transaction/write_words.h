// SPDX-License-Identifier: Apache-2.0
// The data of commands to variables, modules and nodes in addition to their lines: duration, user and reason. One text,
// of which older agents understand the fields they know.

#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace indurop::deploy {

struct WriteOrder {
  std::int64_t for_ns = 0;  // duration of a force, 0: until it is released
  bool lease = false;       // the force ends unless it is renewed within that time
  bool renew = false;       // only extends the same commander's lease by for_ns; no lines
  bool end = false;         // with renew: ends the lease now instead
  std::string who;
  std::string reason;
  // NAME=VALUE; SetLock: the name of the lock; Unforce: names, none: all; for modules its name, none: the node
  std::vector<std::string> lines;
};

std::string text_of(const WriteOrder& order);
// The user who gave it, as it is noted.
std::string user_of(const WriteOrder& order);
// Returns nothing if the text is not a valid order.
std::optional<WriteOrder> parse_write_order(std::string_view text);

// The target of a command to a module or to the node, for an agent of this release: 0.1 knows the module's name only.
std::string module_target(const WriteOrder& order, std::string_view release);
// Parses it; also the bare name that clients of 0.1 send.
WriteOrder parse_module_target(std::string_view target);

}  // namespace indurop::deploy
