// SPDX-License-Identifier: Apache-2.0
// Checks pools: pool struct { uint8_t pixels[480][640]; } camera[4];

#pragma once

#include "glb2idl/ast.h"
#include "glb2idl/context.h"
#include "glb2idl/types.h"

namespace indurop::glb2idl {

// Adds the pools of a declaration that follows the word "pool" to the program, or reports what is wrong with them.
void check_pool(Context& context, TypeBuilder& types, const ast::Declaration& found);

}  // namespace indurop::glb2idl
