// SPDX-License-Identifier: Apache-2.0
// @alarm([condition,] "text" [, priority] [, delay] [, deadband]).

#pragma once

#include <optional>

#include "glb2idl/context.h"

namespace indurop::glb2idl {

// Returns nothing after an error message.
[[nodiscard]] std::optional<schema::Alarm> read_alarm(Context& context, const ast::Annotation& annotation,
                                                      const schema::Type& type);

}  // namespace indurop::glb2idl
