// SPDX-License-Identifier: Apache-2.0
// A value whose type has changed since it was kept: what of it is a value of the new type, and what is not. Load time
// only.

#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "schema/schema.h"

namespace indurop::schema {

// What is kept of a variable.
struct Kept {
  Type type;
  std::string unit;
};

// Puts into `now` what of `old` can be: numbers that fit, texts, elements of arrays by their place, fields and
// enumerators by their name. The rest of `now` stays as it is. One line for each part that is lost or changed, with
// `name` in front; at most a few. `old` and `now` have the sizes of their types.
std::vector<std::string> carry_value(const std::string& name, const Kept& from, std::span<const std::uint8_t> old,
                                     const Kept& to, std::span<std::uint8_t> now);

}  // namespace indurop::schema
