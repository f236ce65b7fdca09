// SPDX-License-Identifier: Apache-2.0
// An expression as Structured Text that is read as the same expression again.

#pragma once

#include <string>

#include "plc/model/ast.h"

namespace indurop::plc {

[[nodiscard]] std::string expression_text(const ast::Expression& expression);
// T#1m30s
[[nodiscard]] std::string duration_text(std::int64_t ns);

}  // namespace indurop::plc
