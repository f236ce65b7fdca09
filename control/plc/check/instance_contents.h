// SPDX-License-Identifier: Apache-2.0
// The contents of an instance: other instances, and variables AT %I*, which have their own address in each instance.

#pragma once

#include "control/plc/check/program.h"

namespace indurop::plc {

// Returns whether the type is a function block, or an array of them.
[[nodiscard]] bool holds_instances(const Type& type) noexcept;
// Returns whether the variable is declared AT %I* or %Q* in a function block: a shared variable for each instance.
[[nodiscard]] bool is_placeless(const Variable& variable) noexcept;
// Returns whether an instance of the type has such a variable, at any depth.
[[nodiscard]] bool holds_places(const Type& type);
// Returns the first library function block in it, at any depth, of which RETAIN keeps only the inputs and outputs, not
// its internal memory; null if there is none.
[[nodiscard]] const LibraryBlock* forgetful_block(const Type& type);

}  // namespace indurop::plc
