// SPDX-License-Identifier: Apache-2.0
// An expression as Structured Text that is read as the same expression again.

#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "plc/model/ast.h"

namespace indurop::plc {

[[nodiscard]] std::string expression_text(const ast::Expression& expression);
// T#1m30s, D#2024-01-31 ...: of the types that count nanoseconds.
[[nodiscard]] std::string time_text(std::int64_t ns, Elementary type);
[[nodiscard]] std::string duration_text(std::int64_t ns);
// 'it$'s', with every character that has no sign as $0A.
[[nodiscard]] std::string quoted_text(std::string_view value);
// The same for a WSTRING: "it$"s".
[[nodiscard]] std::string wide_quoted_text(std::string_view utf8);

}  // namespace indurop::plc
