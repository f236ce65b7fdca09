// SPDX-License-Identifier: Apache-2.0
// The code of a running PLC program and its values as lines for a terminal.

#pragma once

#include <string>
#include <vector>

#include "tools/client/plc/plc_view.h"
#include "tools/console/output.h"

namespace indurop::tools {

std::string heading_of(const PlcView& view, const Output& out);
std::vector<std::string> lines_of(const PlcView& view, const Output& out);

}  // namespace indurop::tools
