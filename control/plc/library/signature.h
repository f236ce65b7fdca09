// SPDX-License-Identifier: Apache-2.0
// Reads the rows of the library's table: "LIMIT(MN ANY_NUM, IN ANY_NUM, MX ANY_NUM): ANY_NUM".

#pragma once

#include <string_view>

#include "control/plc/library/standard.h"

namespace indurop::plc {

// "NAME(IN1 TYPE, IN2 TYPE...): TYPE". Dots: extensible. `cpp` is the name without iec::; '!' in front: may fault.
// Requires a well-formed signature.
[[nodiscard]] LibraryFunction make_function(std::string_view signature, std::string_view cpp);

// "NAME(IN TYPE, R/RESET TYPE): Q TYPE, ET TYPE"
[[nodiscard]] LibraryBlock make_block(std::string_view signature, std::string_view cpp);

}  // namespace indurop::plc
