// SPDX-License-Identifier: Apache-2.0
// Writes SVG pictures: shapes and text on a white background, readable with any viewer. The only place that escapes
// text and writes numbers and the head of the document. Knows nothing of the content.

#pragma once

#include <string>
#include <string_view>

namespace indurop::base {

// Rounds to a tenth of a pixel: "12", "4.5".
[[nodiscard]] std::string svg_number(double value);

// A piece of a picture. `attributes` are written as they are: "fill=\"none\"", "class=\"grid\"".
class SvgPart {
 public:
  void line(double x1, double y1, double x2, double y2, std::string_view attributes);
  // `title` is shown by viewers while the pointer is over the rectangle.
  void rect(double x, double y, double width, double height, std::string_view attributes, std::string_view title = "");
  void circle(double x, double y, double radius, std::string_view attributes);
  // `commands`: "M4 5h8"; numbers that are not whole by svg_number().
  void path(std::string_view commands, std::string_view attributes);
  void text(double x, double y, std::string_view text, std::string_view attributes);
  void raw(std::string_view svg) { out_ += svg; }
  // Adds another piece, moved by (x, y).
  void part(int x, int y, const SvgPart& other);
  void add(const SvgPart& other) { out_ += other.out_; }

  [[nodiscard]] bool empty() const noexcept { return out_.empty(); }
  [[nodiscard]] const std::string& elements() const noexcept { return out_; }

 private:
  std::string out_;
};

// Returns the whole document; text has 12 pixels unless its attributes or the style sheet `style` set another size.
[[nodiscard]] std::string svg_document(int width, int height, const SvgPart& content, std::string_view style = "");

// A document whose shapes are described by their colours.
class Svg {
 public:
  Svg(int width, int height) : width_(width), height_(height) {}

  void rect(int x, int y, int width, int height, std::string_view fill);
  // A rectangle with rounded corners and a frame.
  void box(int x, int y, int width, int height, std::string_view fill, std::string_view frame,
           std::string_view dashes = "", double frame_width = 1);
  void line(int x1, int y1, int x2, int y2, std::string_view colour, double width, std::string_view dashes = "");
  // `anchor`: start, middle or end of the text lies at x.
  void text(int x, int y, std::string_view text, int size, std::string_view colour, std::string_view anchor = "start",
            bool bold = false);
  void raw(std::string_view svg) { content_.raw(svg); }
  [[nodiscard]] std::string finish() const { return svg_document(width_, height_, content_); }

 private:
  int width_;
  int height_;
  SvgPart content_;
};

}  // namespace indurop::base
