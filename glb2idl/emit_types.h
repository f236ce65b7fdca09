// SPDX-License-Identifier: Apache-2.0
// Writes the declarations of a .glb other than variables as C++: constants, enums, structs, type aliases, function
// arguments.

#pragma once

#include "glb2idl/header_text.h"
#include "glb2idl/program.h"

namespace indurop::glb2idl {

// Writes them in the order of the .glb; variables are left out.
void emit_types(const GlbFile& unit, HeaderText& out);
// Returns "  // description [unit]".
[[nodiscard]] std::string about(const std::string& description, const std::string& unit);

// Returns the type of a constant that is no text and no enum value, and its value as a literal.
[[nodiscard]] schema::Base base_of(const Constant& constant);
[[nodiscard]] std::string literal_of(const Constant& constant);

}  // namespace indurop::glb2idl
