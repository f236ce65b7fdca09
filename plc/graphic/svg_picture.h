// SPDX-License-Identifier: Apache-2.0
// Networks as an SVG picture, one below the other.

#pragma once

#include <string>
#include <vector>

#include "plc/graphic/picture.h"

namespace indurop::plc::graphic {

struct SvgNetwork {
  int number = 0;
  std::vector<std::string> remarks;  // title and comments, a line each
  std::vector<std::string> labels;
  Picture picture;
};
// What is drawn under one heading.
struct SvgSheet {
  std::string heading;
  std::vector<SvgNetwork> networks;
};

[[nodiscard]] std::string draw_svg(const std::vector<SvgSheet>& sheets);

}  // namespace indurop::plc::graphic
