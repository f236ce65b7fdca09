// SPDX-License-Identifier: Apache-2.0
// Types from their declarations.

#pragma once

#include <string>

#include "plc/check/context.h"

namespace indurop::plc {

inline constexpr const char* kOpenArray =
    "ARRAY[*] is for VAR_IN_OUT of functions, methods and function blocks only, write the bounds";

// Declares all types of the project, in any order of the text, and the function blocks as types.
void declare_types(Context& context);
// The type of a declaration, with the name it gets; null after an error.
const Type* build_type(Context& context, ast::TypeSpec& spec, const std::string& name = "");

}  // namespace indurop::plc
