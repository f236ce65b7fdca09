// SPDX-License-Identifier: Apache-2.0
// Draws a sequential function chart as a part of an SVG picture: steps with their actions, transitions, divergences.

#pragma once

#include <vector>

#include "control/plc/draw/svg_picture.h"
#include "control/plc/network/chart.h"

namespace indurop::plc {

// The position of a step; boxes are in the order of the steps.
struct StepBox {
  int x = 0;
  int y = 0;
  int width = 0;
  int height = 0;
};

// `boxes` may be null.
[[nodiscard]] draw::SvgPart draw_chart(const network::Chart& chart, std::vector<StepBox>* boxes = nullptr);

}  // namespace indurop::plc
