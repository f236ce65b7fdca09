// SPDX-License-Identifier: Apache-2.0
// The families of functions whose names are made of types: X_TO_Y, TO_Y, X_TRUNC_Y, BCD.

#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "plc/library/standard.h"

namespace indurop::plc {

void append_conversions(std::vector<LibraryFunction>& all);

// The name of a function in capitals and with the names that types have in the table: "tod_to_string" is
// "TIME_OF_DAY_TO_STRING", "LTIME_TO_DINT" is "TIME_TO_DINT". Other names are only made capitals.
[[nodiscard]] std::string with_long_type_names(std::string_view name);

}  // namespace indurop::plc
