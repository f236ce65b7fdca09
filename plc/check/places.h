// SPDX-License-Identifier: Apache-2.0
// What lies in an instance: other instances, and variables AT %I*, which are a place of their own for each instance.

#pragma once

#include "plc/check/program.h"

namespace indurop::plc {

// An instance of a function block, or an array of them.
[[nodiscard]] bool holds_instances(const Type& type) noexcept;
// AT %I* or %Q* in a function block: a shared variable for each instance.
[[nodiscard]] bool is_placeless(const Variable& variable) noexcept;
// Whether an instance of the type has such a variable, at any depth.
[[nodiscard]] bool holds_places(const Type& type);
// The first function block of the library in it, at any depth, of which RETAIN keeps the inputs and outputs only, not
// its memory; null: there is none.
[[nodiscard]] const LibraryBlock* forgetful_block(const Type& type);

}  // namespace indurop::plc
