// SPDX-License-Identifier: Apache-2.0
// Sizes of elements for which the file has none, and the points where lines meet them.

#pragma once

#include "control/plc/network/diagram.h"

namespace indurop::plc::plcopen {

inline constexpr int kCharacter = 10;
inline constexpr int kLine = 20;

// Sets width and height where they are 0.
void give_size(network::Element& element);
// Sets the missing spots of inputs and outputs; `ends`: number of lines that leave it.
void give_spots(network::Element& element, std::size_t ends);
// Returns whether lines leave the element at the bottom and enter it at the top, as in a chart.
[[nodiscard]] bool is_upright(network::Element::Kind kind) noexcept;

}  // namespace indurop::plc::plcopen
