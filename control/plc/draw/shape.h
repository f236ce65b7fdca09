// SPDX-License-Identifier: Apache-2.0
// Size and pin positions of the symbol of an element, in characters and lines.

#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "control/plc/network/diagram.h"

namespace indurop::plc::draw {

using network::Connection;
using network::Element;
using network::Pin;
using network::Storage;

struct Shape {
  int width = 0;
  int height = 1;
  std::vector<int> inputs;   // lines of the pins; blocks: inputs, then in-outs; others: at most one
  std::vector<int> outputs;  // blocks: outputs, then in-outs
};

[[nodiscard]] Shape shape_of(const Element& element);

// Returns the width on a terminal, in characters of UTF-8 text without wide ones.
[[nodiscard]] int text_width(std::string_view text) noexcept;

// Returns the text at the element: variables, with NOT if they are negated.
[[nodiscard]] std::string shown_text(const Element& element);

// Returns the mark in the middle of a contact or coil: "/", "P", "S", " ".
[[nodiscard]] const char* mark_of(const Element& element) noexcept;

// Returns the column where the symbol of a contact or coil begins within the width of the shape.
inline constexpr int kSymbolWidth = 3;  // ( )
[[nodiscard]] constexpr int symbol_begin(const Shape& shape) noexcept {
  return (shape.width - kSymbolWidth) / 2;
}

// Returns the line of the upper border of a block: 1 below the name of its instance.
[[nodiscard]] int border_line(const Element& block) noexcept;

}  // namespace indurop::plc::draw
