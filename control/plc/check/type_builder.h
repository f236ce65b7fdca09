// SPDX-License-Identifier: Apache-2.0
// Builds types from their declarations.

#pragma once

#include <string>

#include "control/plc/check/context.h"

namespace indurop::plc {

inline constexpr const char* kOpenArray =
    "ARRAY[*] is for VAR_IN_OUT of functions, methods and function blocks only, write the bounds";

// Declares all types of the project, in any order of the text, and the function blocks as types.
void declare_types(Context& context);
// Returns the type of a declaration, named `name`; null after an error.
const Type* build_type(Context& context, ast::TypeSpec& spec, const std::string& name = "");
// Adds the fields of a type, or of a variable of it, to the count of the whole program; returns false beyond the limit,
// and reports an error the first time.
bool count_fields(Context& context, const Place& at, const Type& type);
// As count_fields(), for the initial values of a variable.
bool count_values(Context& context, const Place& at, const Type& type, const ast::Initial* initial);

}  // namespace indurop::plc
