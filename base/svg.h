// SPDX-License-Identifier: Apache-2.0
// Writes SVG pictures: shapes and text with a white ground, readable with any viewer. Knows nothing of schedules.

#pragma once

#include <string>
#include <string_view>

namespace indurop::base {

class Svg {
 public:
  Svg(int width, int height);

  void rect(int x, int y, int width, int height, std::string_view fill);
  // A rectangle with rounded corners and a frame.
  void box(int x, int y, int width, int height, std::string_view fill, std::string_view frame,
           std::string_view dashes = "", double frame_width = 1);
  void line(int x1, int y1, int x2, int y2, std::string_view colour, double width, std::string_view dashes = "");
  // `anchor`: start, middle or end of the text lies at x.
  void text(int x, int y, std::string_view text, int size, std::string_view colour, std::string_view anchor = "start",
            bool bold = false);
  void raw(std::string_view svg) { out_ += svg; }
  // The whole document. Nothing may be drawn afterwards.
  std::string finish();

 private:
  std::string out_;
};

}  // namespace indurop::base
