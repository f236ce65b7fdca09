// SPDX-License-Identifier: Apache-2.0
// Prints an expression as Structured Text that parses to the same expression.

#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "control/plc/model/ast.h"

namespace indurop::plc {

[[nodiscard]] std::string expression_text(const ast::Expression& expression);
// Returns T#1m30s, D#2024-01-31 ...: for the types that count nanoseconds.
[[nodiscard]] std::string time_text(std::int64_t ns, Elementary type);
[[nodiscard]] std::string duration_text(std::int64_t ns);
// Returns 'it$'s', with every non-printable character as $0A.
[[nodiscard]] std::string quoted_text(std::string_view value);
// As quoted_text(), for a WSTRING: "it$"s".
[[nodiscard]] std::string wide_quoted_text(std::string_view utf8);

}  // namespace indurop::plc
