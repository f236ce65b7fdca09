// SPDX-License-Identifier: Apache-2.0
// A recording as lines of text: each column, or element of an array, a row of blocks between its smallest and its
// largest value.

#pragma once

#include <string>
#include <vector>

#include "tools/values/recording.h"

namespace indurop::tools {

// At most `columns` wide. Without `unicode` the blocks are digits 0 to 9.
std::vector<std::string> chart_lines(const Recording& recording, int columns, bool unicode);

}  // namespace indurop::tools
