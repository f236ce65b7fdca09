// SPDX-License-Identifier: Apache-2.0
// A network laid out: where its symbols stand and where lines run, in characters and lines. Text, SVG and the running
// view are drawn from it. The layout is the compiler's own: files of some editors have no places.

#pragma once

#include <string>
#include <vector>

#include "plc/draw/shape.h"
#include "plc/network/sheet.h"

namespace indurop::plc::draw {

using network::Body;
using network::Index;
using network::Network;
using network::Order;
using network::Sheet;
using network::Source;

struct Symbol {
  const Element* element = nullptr;  // null: `text`, the value of the last scan that comes back to an input
  std::string text;
  Shape shape;
  int x = 0;
  int y = 0;
};

// A straight piece of a line, in halves of characters and lines: the middle of character x is 2 * x + 1. Power flows in
// it if it flows out of one of the sources.
struct Line {
  int x1 = 0;
  int y1 = 0;
  int x2 = 0;
  int y2 = 0;
  int net = 0;  // pieces of one net are joined where they meet, those of different ones cross
  std::vector<Source> sources;
};

struct Picture {
  int width = 0;   // of the sheet: characters from the left rail (at 0) to the right one (at width - 1)
  int height = 0;  // lines
  bool rails = false;
  std::vector<Symbol> symbols;
  std::vector<Line> lines;
};

// `rails`: a ladder; coils end at the right rail, which is at least `width` away. The network must be without errors.
[[nodiscard]] Picture lay_out(const Network& network, const Index& index, const Order& order, bool rails,
                              int width = 0);
// The pictures of all networks, ladders all as wide as the widest.
[[nodiscard]] std::vector<Picture> lay_out(const Sheet& sheet, Body::Language language);

}  // namespace indurop::plc::draw
