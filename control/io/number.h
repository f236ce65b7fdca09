// SPDX-License-Identifier: Apache-2.0
// Converts a number to a type that may be too small for it: gives the nearest value and whether the number fitted.
// Real-time safe.

#pragma once

#include <cmath>
#include <concepts>
#include <cstdint>
#include <limits>
#include <utility>

#include "control/io/sample.h"

namespace indurop::io {

// Rounds to nearest, ties to even. Returns false if the number is out of range: `into` is the nearest limit; NaN leaves
// it unchanged.
template <std::integral T>
bool to_whole(Number value, T& into) noexcept {
  using Limits = std::numeric_limits<T>;
  // Also after rounding it fits into 64 bits, for which one instruction is enough; nearbyint() takes twenty times as
  // long.
  if (std::fabs(value) < 0x1p62L) {
    const std::int64_t rounded = std::llrint(value);
    into = std::in_range<T>(rounded) ? static_cast<T>(rounded) : (rounded < 0 ? Limits::min() : Limits::max());
    return std::in_range<T>(rounded);
  }
  if (std::isnan(value)) {
    return false;
  }
  const Number rounded = std::nearbyint(value);
  if (rounded < static_cast<Number>(Limits::min())) {
    into = Limits::min();
    return false;
  }
  if (rounded > static_cast<Number>(Limits::max())) {
    into = Limits::max();
    return false;
  }
  into = static_cast<T>(rounded);
  return true;
}

// Returns false for a finite number out of range: `into` is the largest value of the type, with the number's sign.
template <std::floating_point T>
bool to_real(Number value, T& into) noexcept {
  constexpr Number kMaxValue = std::numeric_limits<T>::max();
  if (std::isfinite(value) && std::fabs(value) > kMaxValue) {
    into = static_cast<T>(std::copysign(kMaxValue, value));
    return false;
  }
  into = static_cast<T>(value);
  return true;
}

}  // namespace indurop::io
