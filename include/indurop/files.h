// SPDX-License-Identifier: Apache-2.0
// Locates files named by a module's properties: relative names start at the folder of the node's module.xml.

#pragma once

#include <string>

namespace irp {

// Returns the path of `name` in the folder of the module.xml that this node runs; unchanged if it is absolute, or
// outside a node. Not real-time safe.
std::string file_beside_config(const std::string& name);

}  // namespace irp
