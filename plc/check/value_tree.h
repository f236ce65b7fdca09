// SPDX-License-Identifier: Apache-2.0
// What a variable begins with, every part of it, as the declaration and the defaults of its types say.

#pragma once

#include <vector>

#include "plc/check/program.h"

namespace indurop::plc {

struct ValueTree {
  bool zero = false;             // everything in it is 0, FALSE or empty; then it has no parts
  bool equal_parts = false;      // an array whose elements are all like parts[0]
  Constant value = false;        // of elementary types and enumerations
  std::vector<ValueTree> parts;  // fields, or elements of the outermost dimension
};

// `initial` may be null. Requires that it was checked against the type, and no function blocks in it.
[[nodiscard]] ValueTree initial_value(const Type& type, const ast::Initial* initial);

}  // namespace indurop::plc
