// SPDX-License-Identifier: Apache-2.0
// The reference mark of an encoder, once in every turn of its shaft.

#pragma once

#include <algorithm>
#include <cmath>
#include <optional>

namespace indurop::io {

// Where the shaft passed a mark, degrees, on its way between two positions; the mark it starts at does not count.
// `mark`: where one of them is. Real-time safe.
inline std::optional<double> mark_passed(double mark, double before, double now) noexcept {
  constexpr double kTurn = 360;
  const double at = mark + std::ceil((std::min(before, now) - mark) / kTurn) * kTurn;
  return at <= std::max(before, now) && at != before ? std::optional(at) : std::nullopt;
}

}  // namespace indurop::io
