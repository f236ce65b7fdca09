// SPDX-License-Identifier: Apache-2.0
// A sequential function chart as a part of an SVG picture: steps with their actions, transitions, divergences.

#pragma once

#include "plc/draw/svg_picture.h"
#include "plc/network/chart.h"

namespace indurop::plc {

[[nodiscard]] draw::SvgPart draw_chart(const network::Chart& chart);

}  // namespace indurop::plc
