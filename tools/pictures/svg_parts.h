// SPDX-License-Identifier: Apache-2.0
// The few elements of SVG our pictures are made of.

#pragma once

#include <string>
#include <string_view>

namespace indurop::tools {

// `anchor` start|middle|end; `kind` is the class of the picture's style sheet.
std::string svg_text(double x, double y, const char* anchor, const char* kind, std::string_view content);
std::string svg_line(double x1, double y1, double x2, double y2, const char* kind);

}  // namespace indurop::tools
