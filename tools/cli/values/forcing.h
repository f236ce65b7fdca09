// SPDX-License-Identifier: Apache-2.0
// What verbs add to store/operate/: the user who gives the command, messages and exit codes of a refusal, and the line
// in the audit log.

#pragma once

#include <string>
#include <vector>

#include "store/operate/refusal.h"
#include "store/operate/who.h"
#include "store/vars/custody.h"
#include "tools/cli/command/verb.h"
#include "tools/cli/values/assignment.h"

namespace indurop::tools {

operate::Who who_orders(const Context& context);
// Prints each reason and returns the exit code.
int report(Context& context, const operate::Refusal& refusal);
// Adds a line to the audit log of this machine, of what was done in a node here.
void note_for_audit(const Context& context, const std::string& node, const char* action, const std::string& what);
// The same for the node of the context, if it is here; requests by HTTP are in the log of the server.
void note_for_audit(const Context& context, const char* action, const std::string& what);
// Returns "axis.x=1 axis.y=2".
std::string text_of(const std::vector<Assignment>& assignments);

// Returns false after an error message: the node's write lock forbids it. Remote boards check it themselves.
bool may(Context& context, const std::string& node, vars::Act act);
bool may_set(Context& context, const std::vector<Assignment>& assignments);
// Returns true after an error message for each forced variable: setting it would have no effect.
bool any_forced(Context& context, const vars::Store& store, const std::vector<Assignment>& assignments);

// Sets them one after the other, in the local node or on the boards that own them. Returns the exit code.
int set_values(Context& context, vars::Store& store, const std::vector<Assignment>& assignments);

}  // namespace indurop::tools
