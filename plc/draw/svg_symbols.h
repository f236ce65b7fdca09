// SPDX-License-Identifier: Apache-2.0
// Contacts, coils, blocks and values as SVG, in the coordinates of a Picture.

#pragma once

#include <string>
#include <string_view>

#include "plc/draw/picture.h"

namespace indurop::plc::draw {

inline constexpr int kCellWidth = 9;
inline constexpr int kCellHeight = 20;

// Halves of characters and lines in pixels.
[[nodiscard]] constexpr double half_x(int x) noexcept {
  return x * kCellWidth / 2.0;
}
[[nodiscard]] constexpr double half_y(int y) noexcept {
  return y * kCellHeight / 2.0;
}

[[nodiscard]] std::string svg_symbol(const Symbol& symbol);

}  // namespace indurop::plc::draw
