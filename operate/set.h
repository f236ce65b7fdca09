// SPDX-License-Identifier: Apache-2.0
// Values written once into a store that was opened to write, as far as the node's write lock lets them, and that lock
// itself. Each order is noted with who gave it and why. Not real-time safe.

#pragma once

#include <indurop/result.h>

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "operate/item.h"
#include "operate/refusal.h"
#include "operate/who.h"
#include "vars/custody.h"
#include "vars/store.h"

namespace indurop::operate {

// Why the node's write lock forbids it; nothing if it does not.
std::optional<Refusal> refusal(const std::string& node, vars::Act act);
// The same for values to set: parameters alone may be set under the lock "tune".
std::optional<Refusal> refusal_to_set(const std::string& node, const std::vector<Assignment>& assignments);
// Those of them that are forced: to set them would have no effect.
std::optional<Refusal> forced(const vars::Store& store, const std::vector<Assignment>& assignments);
// "axis.x is forced; release it first: indurop unforce 'axis.x'".
std::string is_forced(std::string_view name);

// One after the other, after all have been checked against lock and forces: all are set, or none, unless one cannot be
// written. Assignments of parts of one value add up.
Result<void, Refusal> set(const std::string& node, vars::Store& store, const std::vector<Assignment>& assignments,
                          const Who& who);
// Notes that a value was set in another way.
void note_set(const std::string& node, const vars::Store& store, const Assignment& one, const Who& who);

// Why: Absent, Busy.
Result<void, Refusal> set_lock(const std::string& node, vars::WriteLock lock, const Who& who);

}  // namespace indurop::operate
