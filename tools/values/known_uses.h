// SPDX-License-Identifier: Apache-2.0
// Which modules write and read each variable, from the module files of the configuration a node runs: no question is
// put to the node.

#pragma once

#include <map>
#include <string>

#include "config/check/check.h"

namespace indurop::tools {

using KnownUses = std::map<std::string, config::VariableUse>;

// Of all boards of a plant, "control@sensor". Empty if the files cannot be read. Takes as long as reading them does.
KnownUses known_uses(const std::string& node);

}  // namespace indurop::tools
