// SPDX-License-Identifier: Apache-2.0
// Checks how the body of a FOR uses the loop variable.

#pragma once

#include "control/plc/check/program.h"

namespace indurop::plc {

// Returns whether the body, wherever it names the variable, only reads it, and leaves the loop only by EXIT: then it
// can be a constant inside, unless it is Variable::aliased.
[[nodiscard]] bool only_reads(const ast::Body& body, const Variable& variable);

}  // namespace indurop::plc
