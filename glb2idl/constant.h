// SPDX-License-Identifier: Apache-2.0
// Evaluates constant expressions: exact integers of up to 64 bits, doubles, texts, bools, durations.

#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "glb2idl/ast.h"
#include "glb2idl/diagnostics.h"

namespace indurop::glb2idl {

__extension__ using Wide = __int128;  // holds int64_t and uint64_t; results must fit one of them

struct Value {
  enum class Kind { Bool, Integer, Real, Text, Duration };
  Kind kind = Kind::Integer;
  Wide integer = 0;  // Bool: 0 or 1; Duration: nanoseconds
  double real = 0;
  std::string text;
  std::string enum_type;  // full name of the enum the value belongs to, else empty

  [[nodiscard]] bool is_number() const noexcept { return kind != Kind::Text && kind != Kind::Duration; }
  [[nodiscard]] double as_double() const noexcept { return kind == Kind::Real ? real : static_cast<double>(integer); }
};

[[nodiscard]] std::string to_text(Wide value);
// Text for messages and tables: 5, 0.5, "text", true, 10ms.
[[nodiscard]] std::string to_text(const Value& value);

// Finds the constant with this path; reports and returns nullopt if there is none.
using ConstantLookup = std::function<std::optional<Value>(const ast::Path&)>;

// Errors (reported, nullopt): overflow, division by zero, a shift out of range, texts in arithmetic, malformed numbers.
[[nodiscard]] std::optional<Value> evaluate(const ast::Expression& expression, const ConstantLookup& lookup,
                                            Diagnostics& diagnostics);

}  // namespace indurop::glb2idl
