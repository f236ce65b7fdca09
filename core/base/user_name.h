// SPDX-License-Identifier: Apache-2.0
// The user who runs this program.

#pragma once

#include <string>

namespace indurop::base {

// Returns "ana"; "user 1000" if the system has no name for the user.
std::string user_name();

}  // namespace indurop::base
