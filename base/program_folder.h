// SPDX-License-Identifier: Apache-2.0
// Where this program lies: what was built or installed with it is found from there.

#pragma once

#include <filesystem>

namespace indurop::base {

// Folder of the running program's file, links resolved. Empty if the system does not say.
std::filesystem::path program_folder();

}  // namespace indurop::base
