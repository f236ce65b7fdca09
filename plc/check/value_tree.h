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
  std::vector<ValueTree> parts;  // fields, or elements of the outermost dimension up to the last that is not zero
};

// `initial` may be null. Requires that it was checked against the type, and no function blocks in it.
[[nodiscard]] ValueTree initial_value(const Type& type, const ast::Initial* initial);
// How many values that tree writes out, about; 0: it is zero. Saturates, and costs no more than the text is long.
[[nodiscard]] std::uint64_t values_of(const Type& type, const ast::Initial* initial);

// Elements in all dimensions: [1, 2, 3, 4] fills ARRAY[1..2, 1..2] row by row.
[[nodiscard]] std::uint64_t elements_of(const Type& array) noexcept;
// The list of an array with its repetitions written out, as long as the elements last, row after row.
[[nodiscard]] std::vector<const ast::Initial*> initial_elements(const ast::Initial& list, std::uint64_t most);

}  // namespace indurop::plc
