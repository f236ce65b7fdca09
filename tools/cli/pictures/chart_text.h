// SPDX-License-Identifier: Apache-2.0
// Draws a recording as lines of text: each column, or element of an array, is a row of blocks between its minimum and
// maximum.

#pragma once

#include <string>
#include <vector>

#include "tools/client/recordings/recording.h"

namespace indurop::tools {

// Returns lines of at most `columns` characters. Without `unicode` the blocks are digits 0 to 9.
std::vector<std::string> chart_lines(const Recording& recording, int columns, bool unicode);

}  // namespace indurop::tools
