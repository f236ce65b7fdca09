// SPDX-License-Identifier: Apache-2.0
// Parses .glb (docs/glb.md). Recovers at the next declaration, so that one run shows all errors.

#pragma once

#include "glb2idl/ast.h"
#include "glb2idl/diagnostics.h"
#include "glb2idl/lexer.h"

namespace indurop::glb2idl {

// Parses the `tokens` of file `file`. Parts that cannot be parsed are reported and left out.
[[nodiscard]] ast::File parse(const Sources& sources, std::uint32_t file, const Tokens& tokens,
                              Diagnostics& diagnostics);

}  // namespace indurop::glb2idl
