// SPDX-License-Identifier: Apache-2.0
// The reference mark of an encoder, one per turn of its shaft.

#pragma once

#include <algorithm>
#include <cmath>
#include <optional>

namespace indurop::io {

// Returns the position at which the shaft passed a mark between two positions, degrees; a mark at the start does not
// count. `mark`: position of any of the marks. Real-time safe.
inline std::optional<double> mark_passed(double mark, double before, double now) noexcept {
  constexpr double kTurn = 360;
  const double at = mark + std::ceil((std::min(before, now) - mark) / kTurn) * kTurn;
  return at <= std::max(before, now) && at != before ? std::optional(at) : std::nullopt;
}

}  // namespace indurop::io
