// SPDX-License-Identifier: Apache-2.0
// Networks as an SVG picture, one below the other.

#pragma once

#include <string>
#include <vector>

#include "control/plc/draw/picture.h"
#include "core/base/svg.h"

namespace indurop::plc::draw {

struct SvgNetwork {
  int number = 0;
  std::vector<std::string> remarks;  // title and comments, one per line
  std::vector<std::string> labels;
  Picture picture;
};
// A finished drawing with its origin at 0, 0.
struct SvgPart {
  base::SvgPart elements;
  int width = 0;
  int height = 0;
};
// The drawings under one heading.
struct SvgSheet {
  std::string heading;
  SvgPart chart;  // above the networks
  std::vector<SvgNetwork> networks;
};

// Draws one network without power, in the coordinates of half_x() and half_y() of control/plc/draw/svg_symbols.h.
[[nodiscard]] SvgPart draw_network(const Picture& picture);

[[nodiscard]] std::string draw_svg(const std::vector<SvgSheet>& sheets);

}  // namespace indurop::plc::draw
