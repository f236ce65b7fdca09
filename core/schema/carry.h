// SPDX-License-Identifier: Apache-2.0
// Converts a stored value to a type that has changed since, as far as possible. Load time only.

#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/schema/schema.h"

namespace indurop::schema {

// Type and unit of a stored variable.
struct Kept {
  Type type;
  std::string unit;
};

// Copies into `now` the parts of `old` that fit: numbers in range, texts, array elements by index, fields and
// enumerators by name. The rest of `now` stays unchanged. Returns one line for each part that is lost or changed,
// prefixed with `name`; at most a few. `old` and `now` have the sizes of their types.
std::vector<std::string> carry_value(const std::string& name, const Kept& from, std::span<const std::uint8_t> old,
                                     const Kept& to, std::span<std::uint8_t> now);
// The same, but returns only lines for what depends on the value: a number, text or enumerator that does not fit. The
// others follow from the declarations; see convert().
std::vector<std::string> carry_what_fits(const std::string& name, const Kept& from, std::span<const std::uint8_t> old,
                                         const Kept& to, std::span<std::uint8_t> now);

}  // namespace indurop::schema
