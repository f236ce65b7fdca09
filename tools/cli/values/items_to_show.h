// SPDX-License-Identifier: Apache-2.0
// Options of the verbs that print a table of given items.

#pragma once

#include <memory>
#include <string>
#include <vector>

#include "tools/cli/command/verb.h"

namespace indurop::tools {

// Adds the options of a verb that prints a table of given items, local or of boards in the network; returns their
// names.
std::shared_ptr<const std::vector<std::string>> add_items_to_show(base::Options& app, Context& context);

}  // namespace indurop::tools
