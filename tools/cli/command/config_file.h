// SPDX-License-Identifier: Apache-2.0
// Shared by `check`, `plan` and others: finds the file of a configuration or of a plant.

#pragma once

#include <string>

#include "tools/client/failure.h"

namespace indurop::tools {

// Returns the file to read: `file`, else ./module.xml, else ./plant.xml. Fails if there is no such file.
Result<std::string, Failure> find_config(const std::string& file);

}  // namespace indurop::tools
