// SPDX-License-Identifier: Apache-2.0
// Holds (forces) values against all writers, and releases them. Each command is noted with its user and reason. Not
// real-time safe.

#pragma once

#include <indurop/result.h>

#include <cstdint>
#include <string>
#include <vector>

#include "core/rt/clock.h"
#include "store/operate/item.h"
#include "store/operate/refusal.h"
#include "store/operate/who.h"
#include "store/vars/held_value.h"
#include "store/vars/store.h"

namespace indurop::operate {

// The values held and until when. Its variables are those of the store.
struct Lease {
  std::vector<vars::HeldValue> values;
  std::vector<std::string> names;  // names of the values, as noted
  rt::MonoTime until;
};
enum class Ends { AtTime, UnlessRenewed };

// Holds all of them for `for_ns`, 0: until they are released; a struct, an array or a text number by number. On error
// none is held.
Result<Lease, Refusal> hold(const std::string& node, vars::Store& store, const std::vector<Assignment>& assignments,
                            std::int64_t for_ns, Ends ends, const Who& who);
// Holds them for another `for_ns` from now. Error: Forced (another user released or re-forced one of them since, or it
// was too late; the others stay held).
Result<void, Refusal> renew(Lease& lease, vars::Store& store, std::int64_t for_ns);
// Releases the values still held by the lease, and notes it.
void end(const std::string& node, vars::Store& store, Lease& lease, const Who& who);

// Releases all forces on these items, or everything. Returns the names of the released ones.
Result<std::vector<std::string>, Refusal> release(const std::string& node, vars::Store& store,
                                                  const std::vector<Item>& items, const Who& who);
Result<std::vector<std::string>, Refusal> release_all(const std::string& node, vars::Store& store, const Who& who);

}  // namespace indurop::operate
