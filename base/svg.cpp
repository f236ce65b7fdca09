// SPDX-License-Identifier: Apache-2.0
#include "base/svg.h"

#include <fmt/format.h>

#include "base/xml_text.h"

namespace indurop::base {
namespace {

std::string dash_attribute(std::string_view dashes) {
  return dashes.empty() ? std::string() : fmt::format(" stroke-dasharray=\"{}\"", dashes);
}

}  // namespace

Svg::Svg(int width, int height)
    : out_(fmt::format("<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{1}\" viewBox=\"0 0 {0} {1}\" "
                       "font-family=\"DejaVu Sans, Verdana, Arial, sans-serif\">\n",
                       width, height)) {
  rect(0, 0, width, height, "#FFFFFF");
}

void Svg::rect(int x, int y, int width, int height, std::string_view fill) {
  out_ += fmt::format("<rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" fill=\"{}\"/>\n", x, y, width, height, fill);
}

void Svg::box(int x, int y, int width, int height, std::string_view fill, std::string_view frame,
              std::string_view dashes, double frame_width) {
  out_ += fmt::format(
      "<rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" rx=\"2\" fill=\"{}\" stroke=\"{}\" stroke-width=\"{}\"{}/>\n",
      x, y, width, height, fill, frame, frame_width, dash_attribute(dashes));
}

void Svg::line(int x1, int y1, int x2, int y2, std::string_view colour, double width, std::string_view dashes) {
  out_ += fmt::format("<line x1=\"{}\" y1=\"{}\" x2=\"{}\" y2=\"{}\" stroke=\"{}\" stroke-width=\"{}\"{}/>\n", x1, y1,
                      x2, y2, colour, width, dash_attribute(dashes));
}

void Svg::text(int x, int y, std::string_view text, int size, std::string_view colour, std::string_view anchor,
               bool bold) {
  out_ += fmt::format("<text x=\"{}\" y=\"{}\" font-size=\"{}\" fill=\"{}\" text-anchor=\"{}\"{}>{}</text>\n", x, y,
                      size, colour, anchor, bold ? " font-weight=\"bold\"" : "", xml_text(text));
}

std::string Svg::finish() {
  out_ += "</svg>\n";
  return std::move(out_);
}

}  // namespace indurop::base
