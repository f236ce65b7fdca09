// SPDX-License-Identifier: Apache-2.0
// Names that somebody wants and no variable has.

#pragma once

#include <string>
#include <vector>

#include "vars/store.h"

namespace indurop::vars {

// Of these names and globs, those that match no variable in use, in their order. Not real-time safe.
std::vector<std::string> names_of_nothing(const Store& store, const std::vector<std::string>& globs);

}  // namespace indurop::vars
