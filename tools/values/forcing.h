// SPDX-License-Identifier: Apache-2.0
// What verbs add to operate/: who gives the order, errors and exit codes of a refusal, and the line in the audit log.

#pragma once

#include <string>
#include <vector>

#include "operate/refusal.h"
#include "operate/who.h"
#include "tools/values/assignment.h"
#include "vars/custody.h"

namespace indurop::tools {

operate::Who who_orders(const Context& context);
// Prints each reason and returns the exit code.
int report(Context& context, const operate::Refusal& refusal);
// For the audit log of this machine; what comes over HTTP is in that of the server.
void note_for_audit(const Context& context, const char* action, const std::string& what);
// "axis.x=1 axis.y=2".
std::string text_of(const std::vector<Assignment>& assignments);

// False after an error message: the node's write lock forbids it. Boards elsewhere check themselves.
bool may(Context& context, const std::string& node, vars::Act act);
bool may_set(Context& context, const std::vector<Assignment>& assignments);
// True after an error message for each that is forced: to set it would have no effect.
bool any_forced(Context& context, const vars::Store& store, const std::vector<Assignment>& assignments);

// One after the other, here or on the boards that own them. Returns the exit code.
int set_values(Context& context, vars::Store& store, const std::vector<Assignment>& assignments);

}  // namespace indurop::tools
