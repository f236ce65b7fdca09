// SPDX-License-Identifier: Apache-2.0
// A random word that cannot be guessed: for tokens and names of leases.

#pragma once

#include <string>

namespace indurop::tools {

// 32 letters, digits, '-' or '_'; empty if the system has no random numbers.
std::string random_word();

}  // namespace indurop::tools
