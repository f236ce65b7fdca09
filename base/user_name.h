// SPDX-License-Identifier: Apache-2.0
// Who runs this program.

#pragma once

#include <string>

namespace indurop::base {

// "ana"; "user 1000" where the system has no name for it.
std::string user_name();

}  // namespace indurop::base
