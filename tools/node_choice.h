// SPDX-License-Identifier: Apache-2.0
// Which node a verb talks to, and opening its shared memory with messages that say what to do.

#pragma once

#include <optional>
#include <string>

#include "tools/run_view.h"
#include "tools/verb.h"
#include "vars/store.h"

namespace indurop::tools {

// --node, $INDUROP_NODE, "local", or the only node there is. Empty after an error message; `code` is then the exit
// code.
std::optional<std::string> choose_node(Context& context, int& code);

// The chosen node's store. Empty after an error message.
std::optional<vars::Store> open_store(Context& context, vars::Mode mode, int& code);
// "not running, ..." of its node, or the boards that are not heard; empty if all is well.
std::string values_absence(const Context& context, const vars::Store& store);
// Whose values they are, for messages: "node 'local'", "plant cell".
std::string values_of(const Context& context);
std::string name_of_source(const Context& context);  // for JSON: "local", "plant cell"

// The chosen node's run block. Empty after an error message.
std::optional<RunView> open_run(Context& context, std::string& node, int& code);

// "not running, last seen 3.2 s ago", for a store whose node is gone; empty if it runs.
std::string store_absence(const vars::BlockHeader& header);
bool store_alive(const vars::BlockHeader& header);

// Text and exit code for an error met when opening a node's memory.
std::string explain_open_error(const Error& error, const std::string& node, bool for_writing);
int exit_code_of(const Error& error);

}  // namespace indurop::tools
