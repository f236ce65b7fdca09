// SPDX-License-Identifier: Apache-2.0
// Writes values once into a store opened for writing, as far as the node's write lock allows it, and sets that lock.
// Each command is noted with its user and reason. Not real-time safe.

#pragma once

#include <indurop/result.h>

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "store/operate/item.h"
#include "store/operate/refusal.h"
#include "store/operate/who.h"
#include "store/vars/custody.h"
#include "store/vars/store.h"

namespace indurop::operate {

// Returns why the node's write lock forbids the action; nothing if it is allowed.
std::optional<Refusal> refusal(const std::string& node, vars::Act act);
// The same for values to set: under the lock "tune" only parameters may be set.
std::optional<Refusal> refusal_to_set(const std::string& node, const std::vector<Assignment>& assignments);
// Returns an error if any of them is forced: setting it would have no effect.
std::optional<Refusal> forced(const vars::Store& store, const std::vector<Assignment>& assignments);
// "axis.x is forced; release it first: indurop unforce 'axis.x'".
std::string is_forced(std::string_view name);

// Sets one after the other, after all have been checked against lock and forces: all are set, or none, unless one
// cannot be written. Assignments to parts of one value are combined.
Result<void, Refusal> set(const std::string& node, vars::Store& store, const std::vector<Assignment>& assignments,
                          const Who& who);
// Notes that a value was set by other means.
void note_set(const std::string& node, const vars::Store& store, const Assignment& one, const Who& who);

// Errors: Absent, Busy.
Result<void, Refusal> set_lock(const std::string& node, vars::WriteLock lock, const Who& who);

}  // namespace indurop::operate
