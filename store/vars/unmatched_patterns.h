// SPDX-License-Identifier: Apache-2.0
// Requested names that match no variable.

#pragma once

#include <string>
#include <vector>

#include "store/vars/store.h"

namespace indurop::vars {

// Returns those of the names and globs that match no variable in use, in their order. Not real-time safe.
std::vector<std::string> unmatched_patterns(const Store& store, const std::vector<std::string>& globs);

}  // namespace indurop::vars
