// SPDX-License-Identifier: Apache-2.0
// The forced values of a node, with their names, and its write lock.

#pragma once

#include <string>
#include <vector>

#include "store/vars/custody.h"
#include "store/vars/store.h"
#include "tools/client/text/table.h"

namespace indurop::tools {

struct ForceView {
  std::string name;                     // "PLC_ROBOT::O[3]"
  std::string value;                    // in the format of get
  JsonValue raw;                        // for JSON
  std::optional<std::int64_t> left_ns;  // none: until released
  vars::ForceNote note;                 // empty: unknown
};

std::vector<ForceView> view_forces(const std::string& node, const vars::Store& store);
// Returns "anna on 10.0.0.7: valve stuck"; empty if nothing is known.
std::string who_and_why(const vars::Note& note);
// Returns the line in the output of status: "forced  2: PLC_ROBOT::O[3] = true (4.2 s left), ..."; empty if nothing is
// forced.
std::string force_line(const std::vector<ForceView>& forces);
JsonValue json_of(const std::vector<ForceView>& forces);
// Returns "tune (anna: production)"; empty if the node is not locked.
std::string lock_line(const vars::LockNote& note);
JsonValue json_of(const vars::LockNote& note);

}  // namespace indurop::tools
