// SPDX-License-Identifier: Apache-2.0
// Checks the meaning of one parsed file and adds it to the program.

#pragma once

#include "glb2idl/ast.h"
#include "glb2idl/context.h"

namespace indurop::glb2idl {

// `context` is at the file's unit. All errors are reported; valid parts are still added, so that later declarations
// find them.
void check_file(Context& context, const ast::File& file);

// Determines which constants may also appear in IDL. Call it after the last file.
void choose_idl_constants(Context& context);

}  // namespace indurop::glb2idl
