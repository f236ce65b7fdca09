// SPDX-License-Identifier: Apache-2.0
// The families of functions whose names contain types: X_TO_Y, TO_Y, X_TRUNC_Y, BCD.

#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "control/plc/library/standard.h"

namespace indurop::plc {

void append_conversions(std::vector<LibraryFunction>& all);

// Returns the name of a function in capitals and with the type names of the table: "tod_to_string" becomes
// "TIME_OF_DAY_TO_STRING", "LTIME_TO_DINT" becomes "TIME_TO_DINT". Other names only become capitals.
[[nodiscard]] std::string with_long_type_names(std::string_view name);

}  // namespace indurop::plc
