// SPDX-License-Identifier: Apache-2.0
// What the body of a FOR does with the loop's variable.

#pragma once

#include "plc/check/program.h"

namespace indurop::plc {

// Whether the body only reads the variable, as far as it names it, and ends the loop, if at all, with EXIT: then it can
// be a constant inside, unless it is Variable::aliased.
[[nodiscard]] bool only_reads(const ast::Body& body, const Variable& variable);

}  // namespace indurop::plc
