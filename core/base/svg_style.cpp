// SPDX-License-Identifier: Apache-2.0
#include "core/base/svg_style.h"

#include <fmt/format.h>

#include "core/base/printable.h"

namespace indurop::base {

std::string svg_class(std::string_view kind) {
  return fmt::format("class=\"{}\"", kind);
}

void svg_text(SvgPart& out, double x, double y, const char* anchor, const char* kind, std::string_view content) {
  out.text(x, y, printable(content), fmt::format("text-anchor=\"{}\" {}", anchor, svg_class(kind)));
}

void svg_line(SvgPart& out, double x1, double y1, double x2, double y2, const char* kind) {
  out.line(x1, y1, x2, y2, svg_class(kind));
}

}  // namespace indurop::base
