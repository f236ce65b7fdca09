// SPDX-License-Identifier: Apache-2.0
// Where the files are that a module's properties name: relative names begin at the folder of the node's module.xml.

#pragma once

#include <string>

namespace irp {

// `name` beside the module.xml this node runs; unchanged if it is absolute, or outside a node. Not real-time safe.
std::string file_beside_config(const std::string& name);

}  // namespace irp
