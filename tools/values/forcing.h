// SPDX-License-Identifier: Apache-2.0
// Values written, held and let go in a store that was opened to write, with messages for whoever asked. Each is noted
// for `indurop explain`, with who did it.

#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "tools/values/assignment.h"

namespace indurop::tools {

// One after the other. Returns the exit code.
int set_values(Context& context, vars::Store& store, const std::vector<Assignment>& assignments);
// Notes that this was written in another way, "set". Values of boards elsewhere are not noted here.
void note_order(const Context& context, const vars::Store& store, const char* action, const Assignment& one);
// All of them for `for_ns`, 0: until they are let go. Only numbers can be held. Returns the exit code.
int hold_values(Context& context, vars::Store& store, const std::vector<Assignment>& assignments, std::int64_t for_ns);
// What is forced of these items, or everything; `gone` is what was. Returns the exit code.
int let_values_go(Context& context, vars::Store& store, const std::vector<Item>& items, std::vector<std::string>& gone);
int let_all_go(Context& context, vars::Store& store, std::vector<std::string>& gone);
// Writing to a forced value would be for nothing: says so of each that is.
bool any_forced(Context& context, const vars::Store& store, const std::vector<Assignment>& assignments);

}  // namespace indurop::tools
