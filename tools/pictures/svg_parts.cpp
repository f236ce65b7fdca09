// SPDX-License-Identifier: Apache-2.0
#include "tools/pictures/svg_parts.h"

#include <fmt/format.h>

#include "base/xml_text.h"
#include "tools/command/units.h"

namespace indurop::tools {

std::string svg_text(double x, double y, const char* anchor, const char* kind, std::string_view content) {
  return fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\" class=\"{}\">{}</text>\n", x, y, anchor, kind,
                     base::xml_text(printable(content)));
}

std::string svg_line(double x1, double y1, double x2, double y2, const char* kind) {
  return fmt::format("<line x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\" class=\"{}\"/>\n", x1, y1, x2, y2,
                     kind);
}

}  // namespace indurop::tools
