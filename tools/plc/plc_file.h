// SPDX-License-Identifier: Apache-2.0
// Reads the source of a PLC program.

#pragma once

#include <string>

#include "tools/command/verb.h"

namespace indurop::tools {

// All bytes of an ordinary file. False after an error message.
bool read_plc_file(Context& context, const std::string& file, std::string& bytes);

}  // namespace indurop::tools
