// SPDX-License-Identifier: Apache-2.0
// What of a variable remains when its declaration changes, by the types alone. Load time only.

#pragma once

#include <string>
#include <vector>

#include "core/schema/schema.h"

namespace indurop::schema {

// Names of parts, "cell::axis.x": as deep as the declarations have fields; an array is one part unless its elements are
// structs that differ, "cell::axes[].x".
struct Conversion {
  std::vector<std::string> carried;  // in both, numbers perhaps of another type
  std::vector<std::string> added;    // in the new declaration only: initial values
  std::vector<std::string> lost;     // with the reason, "cell::axis.x: is no longer declared"
};

// What carry_value() carries of a value of `from`, if its values fit: a number that is beyond the new type, and an
// enumerator that this does not have, are lost nevertheless.
Conversion convert(const Variable& from, const Variable& to);

}  // namespace indurop::schema
