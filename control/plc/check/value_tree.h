// SPDX-License-Identifier: Apache-2.0
// The initial value of a variable with all its parts, from the declaration and the defaults of its types.

#pragma once

#include <vector>

#include "control/plc/check/program.h"

namespace indurop::plc {

struct ValueTree {
  bool zero = false;             // all of it is 0, FALSE or empty; then it has no parts
  bool equal_parts = false;      // an array whose elements all equal parts[0]
  Constant value = false;        // for elementary types and enumerations
  std::vector<ValueTree> parts;  // fields, or elements of the outermost dimension up to the last non-zero one
};

// Returns the initial value. `initial` may be null. Requires that it was checked against the type, and that the type
// contains no function blocks.
[[nodiscard]] ValueTree initial_value(const Type& type, const ast::Initial* initial);
// Returns roughly how many values that tree writes out; 0: it is zero. Saturates; the time is limited by the length of
// the text.
[[nodiscard]] std::uint64_t values_of(const Type& type, const ast::Initial* initial);

// Returns the number of elements in all dimensions: [1, 2, 3, 4] fills ARRAY[1..2, 1..2] row by row.
[[nodiscard]] std::uint64_t elements_of(const Type& array) noexcept;
// Returns the list of an array with its repetitions expanded, row after row, until all elements have a value.
[[nodiscard]] std::vector<const ast::Initial*> initial_elements(const ast::Initial& list, std::uint64_t most);

}  // namespace indurop::plc
