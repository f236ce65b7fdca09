// SPDX-License-Identifier: Apache-2.0
// The layout of a network: positions of its symbols and lines, in characters and lines. Text, SVG and the running view
// are drawn from it. The layout is the compiler's own, because files of some editors have no places.

#pragma once

#include <string>
#include <vector>

#include "control/plc/draw/shape.h"
#include "control/plc/network/sheet.h"

namespace indurop::plc::draw {

using network::Body;
using network::Index;
using network::Network;
using network::Order;
using network::Sheet;
using network::Source;

struct Symbol {
  const Element* element = nullptr;  // null: `text`, the value of the last scan fed back to an input
  std::string text;
  Shape shape;
  int x = 0;
  int y = 0;
};

// A straight piece of a line, in halves of characters and lines: the middle of character x is 2 * x + 1. It has power
// if one of the sources has.
struct Line {
  int x1 = 0;
  int y1 = 0;
  int x2 = 0;
  int y2 = 0;
  int net = 0;  // pieces of one net join where they meet, those of different nets cross
  std::vector<Source> sources;
};

struct Picture {
  int width = 0;   // of the sheet: characters from the left rail (at 0) to the right one (at width - 1)
  int height = 0;  // lines
  bool rails = false;
  std::vector<Symbol> symbols;
  std::vector<Line> lines;
};

// Lays out all networks of a body without errors; those of a chart are function block diagrams. In a ladder coils end
// at the right rail, and all rungs are as wide as the widest. Returns none, with an error, if the pictures were too
// large.
[[nodiscard]] std::vector<Picture> lay_out(const Sheet& sheet, const Body& body, Diagnostics& diagnostics);

}  // namespace indurop::plc::draw
