// SPDX-License-Identifier: Apache-2.0
// Shared by `check`, `plan`, `reload` and others: finds the file of a configuration or of a plant, and names files for
// other processes.

#pragma once

#include <string>

#include "tools/client/failure.h"

namespace indurop::tools {

// Returns the file to read: `file`, else ./module.xml, else ./plant.xml. Fails if there is no such file.
Result<std::string, Failure> find_config(const std::string& file);

// Returns the name of a file from the root on, for a process with another current folder. Fails if that of this process
// has been removed.
Result<std::string, Failure> absolute_name(const std::string& file);

}  // namespace indurop::tools
