// SPDX-License-Identifier: Apache-2.0
// Values known when the program is compiled, and arithmetic with them.

#pragma once

#include <indurop/result.h>

#include <cstdint>
#include <optional>
#include <string>
#include <variant>

#include "control/plc/check/type.h"
#include "core/base/problem.h"

namespace indurop::plc {

// Wide enough for all integer types; times are nanoseconds.
__extension__ using Integer = __int128;

using Constant = std::variant<bool, Integer, double, std::string>;

// Returns the result of an operator on constants. Errors: it has no value (5 / 0), or the operands are not of one kind.
[[nodiscard]] Result<Constant, base::Problem> apply(ast::Operator op, const Constant& a);
[[nodiscard]] Result<Constant, base::Problem> apply(ast::Operator op, const Constant& a, const Constant& b);

// Returns whether the type can hold the value unchanged; a whole number fits a real.
[[nodiscard]] bool fits(const Constant& value, const Type& type) noexcept;
// Returns whether a number without a type can take this type: as fits(), but a bare number has no unit of time.
[[nodiscard]] bool adapts(const Constant& value, const Type& type) noexcept;
// Returns the type of a number without a type where the context requires none: INT, DINT, LINT or ULINT, the first that
// holds the number; LREAL; BOOL.
[[nodiscard]] Elementary default_type(const Constant& constant) noexcept;
// Returns a hint where adapts() is false because of the unit: "; a number has no unit, write T#500ms". Otherwise "".
[[nodiscard]] std::string unit_hint(const Type& type);
// Returns the value as the type stores it: integers wrap, as at run time. Requires the same kind, or a number for a
// real.
[[nodiscard]] Constant stored(const Constant& value, const Type& type);
// "5", "TRUE", "1.5", "'text'"
[[nodiscard]] std::string to_string(const Constant& value);
// Returns the value if it is an integer that fits into 64 bits.
[[nodiscard]] std::optional<std::int64_t> as_int64(const Constant& value) noexcept;

}  // namespace indurop::plc
