// SPDX-License-Identifier: Apache-2.0
// The modules that write and read each variable, from the module files of the configuration that a node runs; the node
// itself is not asked.

#pragma once

#include <map>
#include <string>

#include "config/check/check.h"

namespace indurop::tools {

using KnownUses = std::map<std::string, config::VariableUse>;

// For all boards of a plant, as "control@sensor". Empty if the files cannot be read. Takes as long as reading them.
KnownUses known_uses(const std::string& node);

}  // namespace indurop::tools
