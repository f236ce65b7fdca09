// SPDX-License-Identifier: Apache-2.0
// Values written, held and let go in a store that was opened to write, as far as the node's write lock lets them, with
// messages for whoever asked. Each is noted with who did it and why.

#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "tools/values/assignment.h"
#include "vars/custody.h"
#include "vars/held_value.h"

namespace indurop::tools {

// False after an error message: the node's write lock forbids it. Boards elsewhere look themselves.
bool may(Context& context, const std::string& node, vars::Act act);
bool may_set(Context& context, const std::vector<Assignment>& assignments);

// One after the other. Returns the exit code.
int set_values(Context& context, vars::Store& store, const std::vector<Assignment>& assignments);
// Notes that this was written in another way, "set". Values of boards elsewhere are not noted here.
void note_order(const Context& context, const vars::Store& store, const char* action, const Assignment& one);

// How long a lease holds after it was renewed last.
inline constexpr std::int64_t kLeaseNs = 2'000'000'000;
// What is held as long as somebody says again and again that it still wants it. Its variables are those of the store.
struct Lease {
  std::vector<vars::HeldValue> values;
  rt::MonoTime until;
};
// All of them for `for_ns`, 0: until they are let go; a struct, an array, a text by its numbers. With `lease`, `for_ns`
// is how long it holds unless it is renewed. Returns the exit code.
int hold_values(Context& context, vars::Store& store, const std::vector<Assignment>& assignments, std::int64_t for_ns,
                Lease* lease = nullptr);
// For another `for_ns` from now. False: somebody else has let one of them go or forced it since, or it was too late;
// the others go on.
bool renew(Lease& lease, vars::Store& store, std::int64_t for_ns);
// What is still held by it is let go, and noted.
void end(const Context& context, Lease& lease, vars::Store& store);

// What is forced of these items, or everything; `gone` is what was. Returns the exit code.
int let_values_go(Context& context, vars::Store& store, const std::vector<Item>& items, std::vector<std::string>& gone);
int let_all_go(Context& context, vars::Store& store, std::vector<std::string>& gone);
// Writing to a forced value would be for nothing: says so of each that is.
bool any_forced(Context& context, const vars::Store& store, const std::vector<Assignment>& assignments);

}  // namespace indurop::tools
