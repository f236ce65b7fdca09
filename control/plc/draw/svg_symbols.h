// SPDX-License-Identifier: Apache-2.0
// Contacts, coils, blocks and values as SVG, in the coordinates of a Picture.

#pragma once

#include "control/plc/draw/picture.h"
#include "core/base/svg.h"

namespace indurop::plc::draw {

inline constexpr int kCellWidth = 9;
inline constexpr int kCellHeight = 20;

// Convert halves of characters and lines to pixels.
[[nodiscard]] constexpr double half_x(int x) noexcept {
  return x * kCellWidth / 2.0;
}
[[nodiscard]] constexpr double half_y(int y) noexcept {
  return y * kCellHeight / 2.0;
}

void svg_symbol(const Symbol& symbol, base::SvgPart& out);

}  // namespace indurop::plc::draw
