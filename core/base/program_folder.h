// SPDX-License-Identifier: Apache-2.0
// The folder of this program, from which the files built or installed with it are found.

#pragma once

#include <filesystem>

namespace indurop::base {

// Returns the folder of the running program's file, links resolved. Empty if the system does not report it.
std::filesystem::path program_folder();

}  // namespace indurop::base
