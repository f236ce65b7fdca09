// SPDX-License-Identifier: Apache-2.0
// How far two values of one variable are apart. Not real-time safe.

#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "core/schema/schema.h"

namespace indurop::node {

struct Distance {
  double largest = 0;  // between two numbers of the values; infinite: a text differs, or one of them is no number (NaN)
  std::string part;    // "joints[1].y", where that is; the variable's name if they are equal
};

// Both have the size of the variable. Padding does not count. true is 1, an enumerator its number.
Distance distance(const schema::Variable& variable, std::span<const std::uint8_t> a, std::span<const std::uint8_t> b);

}  // namespace indurop::node
