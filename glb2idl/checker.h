// SPDX-License-Identifier: Apache-2.0
// Gives one parsed file its meaning and adds it to the program.

#pragma once

#include "glb2idl/ast.h"
#include "glb2idl/context.h"

namespace indurop::glb2idl {

// `context` stands at the file's unit. Everything wrong is reported; what is right is added all the same, so that
// later declarations find it.
void check_file(Context& context, const ast::File& file);

// After the last file: which constants may also appear in IDL.
void choose_idl_constants(Context& context);

}  // namespace indurop::glb2idl
