// SPDX-License-Identifier: Apache-2.0
// A sequential function chart as a part of an SVG picture: steps with their actions, transitions, divergences.

#pragma once

#include "plc/graphic/svg_picture.h"
#include "plc/sfc/chart.h"

namespace indurop::plc {

[[nodiscard]] graphic::SvgPart draw_chart(const sfc::Chart& chart);

}  // namespace indurop::plc
