// SPDX-License-Identifier: Apache-2.0
// The forced values of a node, with their names.

#pragma once

#include <string>
#include <vector>

#include "tools/command/table.h"
#include "vars/store.h"

namespace indurop::tools {

struct ForceView {
  std::string name;                     // "PLC_ROBOT::O[3]"
  std::string value;                    // as get prints it
  JsonValue raw;                        // for JSON
  std::optional<std::int64_t> left_ns;  // none: until it is let go
};

std::vector<ForceView> view_forces(const vars::Store& store);
// "forced  2: PLC_ROBOT::O[3] = true (4.2 s left), ...": what status says; empty if nothing is.
std::string force_line(const std::vector<ForceView>& forces);
JsonValue json_of(const std::vector<ForceView>& forces);

}  // namespace indurop::tools
