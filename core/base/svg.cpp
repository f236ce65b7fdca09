// SPDX-License-Identifier: Apache-2.0
#include "core/base/svg.h"

#include <fmt/format.h>

#include "core/base/xml_text.h"

namespace indurop::base {
namespace {

std::string dash_attribute(std::string_view dashes) {
  return dashes.empty() ? std::string() : fmt::format(" stroke-dasharray=\"{}\"", dashes);
}

}  // namespace

std::string svg_number(double value) {
  std::string text = fmt::format("{:.1f}", value);
  if (text.ends_with(".0")) {
    text.resize(text.size() - 2);
  }
  return text == "-0" ? "0" : text;
}

void SvgPart::line(double x1, double y1, double x2, double y2, std::string_view attributes) {
  out_ += fmt::format("<line x1=\"{}\" y1=\"{}\" x2=\"{}\" y2=\"{}\" {}/>\n", svg_number(x1), svg_number(y1),
                      svg_number(x2), svg_number(y2), attributes);
}

void SvgPart::rect(double x, double y, double width, double height, std::string_view attributes,
                   std::string_view title) {
  out_ += fmt::format("<rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" {}", svg_number(x), svg_number(y),
                      svg_number(width), svg_number(height), attributes);
  out_ += title.empty() ? "/>\n" : fmt::format("><title>{}</title></rect>\n", xml_text(title));
}

void SvgPart::circle(double x, double y, double radius, std::string_view attributes) {
  out_ += fmt::format("<circle cx=\"{}\" cy=\"{}\" r=\"{}\" {}/>\n", svg_number(x), svg_number(y), svg_number(radius),
                      attributes);
}

void SvgPart::path(std::string_view commands, std::string_view attributes) {
  out_ += fmt::format("<path d=\"{}\" {}/>\n", commands, attributes);
}

void SvgPart::text(double x, double y, std::string_view text, std::string_view attributes) {
  out_ +=
      fmt::format("<text x=\"{}\" y=\"{}\" {}>{}</text>\n", svg_number(x), svg_number(y), attributes, xml_text(text));
}

void SvgPart::part(int x, int y, const SvgPart& other) {
  out_ += fmt::format("<g transform=\"translate({},{})\">\n{}</g>\n", x, y, other.out_);
}

std::string svg_document(int width, int height, const SvgPart& content, std::string_view style) {
  return fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{1}\" viewBox=\"0 0 {0} {1}\" "
      "font-family=\"DejaVu Sans, Verdana, Arial, sans-serif\" font-size=\"12\">\n{2}"
      "<rect x=\"0\" y=\"0\" width=\"{0}\" height=\"{1}\" fill=\"#FFFFFF\"/>\n{3}</svg>\n",
      width, height, style.empty() ? std::string() : fmt::format("<style>{}</style>\n", style), content.elements());
}

void Svg::rect(int x, int y, int width, int height, std::string_view fill) {
  content_.rect(x, y, width, height, fmt::format("fill=\"{}\"", fill));
}

void Svg::box(int x, int y, int width, int height, std::string_view fill, std::string_view frame,
              std::string_view dashes, double frame_width) {
  content_.rect(x, y, width, height,
                fmt::format("rx=\"2\" fill=\"{}\" stroke=\"{}\" stroke-width=\"{}\"{}", fill, frame, frame_width,
                            dash_attribute(dashes)));
}

void Svg::line(int x1, int y1, int x2, int y2, std::string_view colour, double width, std::string_view dashes) {
  content_.line(x1, y1, x2, y2,
                fmt::format("stroke=\"{}\" stroke-width=\"{}\"{}", colour, width, dash_attribute(dashes)));
}

void Svg::text(int x, int y, std::string_view text, int size, std::string_view colour, std::string_view anchor,
               bool bold) {
  content_.text(x, y, text,
                fmt::format("font-size=\"{}\" fill=\"{}\" text-anchor=\"{}\"{}", size, colour, anchor,
                            bold ? " font-weight=\"bold\"" : ""));
}

}  // namespace indurop::base
