// SPDX-License-Identifier: Apache-2.0
// What a .glb declares besides variables, as C++: constants, enums, structs, other names of types, arguments of
// functions.

#pragma once

#include "glb2idl/header_text.h"
#include "glb2idl/program.h"

namespace indurop::glb2idl {

// In the order of the .glb; variables are left out.
void emit_types(const GlbFile& unit, HeaderText& out);
// "  // description [unit]"
[[nodiscard]] std::string about(const std::string& description, const std::string& unit);

}  // namespace indurop::glb2idl
