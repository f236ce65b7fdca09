// SPDX-License-Identifier: Apache-2.0
// Converts values in a .glb to the bytes of a type: initial values, fallbacks, typed constants.

#pragma once

#include <optional>
#include <string>
#include <vector>

#include "glb2idl/context.h"

namespace indurop::glb2idl {

// The range of an integer type, for example -128 to 127.
struct Limits {
  Wide min;
  Wide max;
};
[[nodiscard]] std::optional<Limits> limits_of(schema::Base base) noexcept;  // nullopt: not an integer

// Returns why `value` does not fit the type ("300 does not fit uint8_t (0 to 255)"), or nullopt. `value` is converted
// to what the type stores: a double rounded to float, a whole double as integer.
[[nodiscard]] std::optional<std::string> convert(Value& value, const schema::Type& type);

// Returns the bytes of `type` with the value of `initializer`; missing parts are zero. Reports and returns nullopt if
// something does not fit; `range` applies to every number that has no range of its own.
[[nodiscard]] std::optional<std::vector<std::uint8_t>> initial_bytes(Context& context, const schema::Type& type,
                                                                     const ast::Initializer& initializer,
                                                                     const std::optional<schema::Range>& range);

}  // namespace indurop::glb2idl
