// SPDX-License-Identifier: Apache-2.0
// Networks as an SVG picture, one below the other.

#pragma once

#include <string>
#include <vector>

#include "base/svg.h"
#include "plc/draw/picture.h"

namespace indurop::plc::draw {

struct SvgNetwork {
  int number = 0;
  std::vector<std::string> remarks;  // title and comments, a line each
  std::vector<std::string> labels;
  Picture picture;
};
// Something drawn already, from 0, 0.
struct SvgPart {
  base::SvgPart elements;
  int width = 0;
  int height = 0;
};
// What is drawn under one heading.
struct SvgSheet {
  std::string heading;
  SvgPart chart;  // above the networks
  std::vector<SvgNetwork> networks;
};

[[nodiscard]] std::string draw_svg(const std::vector<SvgSheet>& sheets);

}  // namespace indurop::plc::draw
