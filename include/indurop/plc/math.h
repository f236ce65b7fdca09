// SPDX-License-Identifier: Apache-2.0
// Functions of REAL and LREAL. Where the result is not defined they return the C library's NaN or infinity: SQRT(-1.0),
// LN(0.0), ASIN(2.0). Real-time safe.

#pragma once

#include <indurop/plc/types.h>

#include <cmath>

namespace indurop::iec {

template <Real T>
T sqrt(T x) noexcept {
  return std::sqrt(x);
}
template <Real T>
T ln(T x) noexcept {
  return std::log(x);
}
template <Real T>
T log(T x) noexcept {
  return std::log10(x);
}
template <Real T>
T exp(T x) noexcept {
  return std::exp(x);
}
// Angles in radians.
template <Real T>
T sin(T x) noexcept {
  return std::sin(x);
}
template <Real T>
T cos(T x) noexcept {
  return std::cos(x);
}
template <Real T>
T tan(T x) noexcept {
  return std::tan(x);
}
template <Real T>
T asin(T x) noexcept {
  return std::asin(x);
}
template <Real T>
T acos(T x) noexcept {
  return std::acos(x);
}
template <Real T>
T atan(T x) noexcept {
  return std::atan(x);
}
// The angle of the point (x, y), from -pi to pi, in radians.
template <Real T>
T atan2(T y, T x) noexcept {
  return std::atan2(y, x);
}

// x to the power of n; 0 ** 0 is 1.
template <Real T, Number N>
T expt(T x, N n) noexcept {
  return static_cast<T>(std::pow(static_cast<double>(x), static_cast<double>(n)));
}

// Returns true if x is neither NaN nor infinite.
template <Real T>
bool is_valid(T x) noexcept {
  return std::isfinite(x);
}

}  // namespace indurop::iec
