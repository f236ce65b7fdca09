// SPDX-License-Identifier: Apache-2.0
// How large elements are in a file where nobody said it, and where lines meet them.

#pragma once

#include "plc/network/diagram.h"

namespace indurop::plc::plcopen {

inline constexpr int kCharacter = 10;
inline constexpr int kLine = 20;

// Width and height, where they are 0.
void give_size(network::Element& element);
// Spots of inputs and outputs that have none; `ends` lines leave it.
void give_spots(network::Element& element, std::size_t ends);
// Lines leave and enter it above and below, as in a chart.
[[nodiscard]] bool is_upright(network::Element::Kind kind) noexcept;

}  // namespace indurop::plc::plcopen
