// SPDX-License-Identifier: Apache-2.0
// Values known when the program is compiled, and arithmetic with them.

#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <variant>

#include "plc/check/type.h"

namespace indurop::plc {

// Wide enough for all integer types; times are nanoseconds.
__extension__ using Integer = __int128;

using Constant = std::variant<bool, Integer, double, std::string>;

// The result of an operator on constants of one kind. None with `why` if it has no value (5 / 0); none without if the
// operands are of other kinds.
[[nodiscard]] std::optional<Constant> apply(ast::Operator op, const Constant& a, std::string& why);
[[nodiscard]] std::optional<Constant> apply(ast::Operator op, const Constant& a, const Constant& b, std::string& why);

// Whether the type can hold the value as it is; a whole number is fine for a real.
[[nodiscard]] bool fits(const Constant& value, const Type& type) noexcept;
// Whether a number without a type may become one of the type: as fits(), but a bare number says no unit of time.
[[nodiscard]] bool adapts(const Constant& value, const Type& type) noexcept;
// What a number without a type is where nothing wants another: INT, DINT, LINT or ULINT, the first that holds the
// number; LREAL; BOOL.
[[nodiscard]] Elementary default_type(const Constant& constant) noexcept;
// What to write instead where adapts() says no because of the unit: "; a number has no unit, write T#500ms". Else "".
[[nodiscard]] std::string unit_hint(const Type& type);
// The value as the type stores it: integers wrap, as they do at run time. Requires the same kind, or a number for a
// real.
[[nodiscard]] Constant stored(const Constant& value, const Type& type);
// "5", "TRUE", "1.5", "'text'"
[[nodiscard]] std::string to_string(const Constant& value);
// An integer, if it is one that fits.
[[nodiscard]] std::optional<std::int64_t> as_int64(const Constant& value) noexcept;

}  // namespace indurop::plc
