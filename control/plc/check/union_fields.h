// SPDX-License-Identifier: Apache-2.0
// Types whose values may lie in the same bytes, as the fields of a UNION do.

#pragma once

#include <string>

#include "control/plc/check/type.h"

namespace indurop::plc {

// Returns why a field of the type must not share its bytes with another field; empty if it may, because any bytes are a
// value of the type.
[[nodiscard]] std::string why_no_overlap(const Type& type);

}  // namespace indurop::plc
