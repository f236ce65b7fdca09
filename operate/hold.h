// SPDX-License-Identifier: Apache-2.0
// Values held (forced) whoever writes them, and released. Each order is noted with who gave it and why. Not real-time
// safe.

#pragma once

#include <indurop/result.h>

#include <cstdint>
#include <string>
#include <vector>

#include "operate/item.h"
#include "operate/refusal.h"
#include "operate/who.h"
#include "rt/clock.h"
#include "vars/held_value.h"
#include "vars/store.h"

namespace indurop::operate {

// What is held, until when. Its variables are those of the store.
struct Lease {
  std::vector<vars::HeldValue> values;
  std::vector<std::string> names;  // of the same, as they are noted
  rt::MonoTime until;
};
enum class Ends { ByItself, UnlessRenewed };

// All of them for `for_ns`, 0: until they are released; a struct, an array, a text by its numbers. Or none.
Result<Lease, Refusal> hold(const std::string& node, vars::Store& store, const std::vector<Assignment>& assignments,
                            std::int64_t for_ns, Ends ends, const Who& who);
// For another `for_ns` from now. Why: Forced (another user released or forced one of them since, or it was too late;
// the others go on).
Result<void, Refusal> renew(Lease& lease, vars::Store& store, std::int64_t for_ns);
// What is still held by the lease is released, and noted.
void end(const std::string& node, vars::Store& store, Lease& lease, const Who& who);

// Releases what is forced of these items, or everything. Returns the names of what was.
Result<std::vector<std::string>, Refusal> release(const std::string& node, vars::Store& store,
                                                  const std::vector<Item>& items, const Who& who);
Result<std::vector<std::string>, Refusal> release_all(const std::string& node, vars::Store& store, const Who& who);

}  // namespace indurop::operate
