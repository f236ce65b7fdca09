// SPDX-License-Identifier: Apache-2.0
// A table as text for a terminal.

#pragma once

#include <string>

#include "tools/client/text/table.h"
#include "tools/console/output.h"

namespace indurop::tools {

// Returns heading and rows, columns separated by two spaces, no trailing spaces, columns without any text left out;
// empty if there are no rows.
std::string table_text(const Table& table, const Output& output);

}  // namespace indurop::tools
