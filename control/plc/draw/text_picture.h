// SPDX-License-Identifier: Apache-2.0
// A network as text for a terminal: without power, or with the power flow of a running program.

#pragma once

#include <functional>
#include <vector>

#include "control/plc/draw/canvas.h"
#include "control/plc/draw/picture.h"

namespace indurop::plc::draw {

// Data of a running program; null functions: no data.
struct Live {
  std::function<bool(const Source&)> powered;
  // Returns whether the variable of a contact or coil lets power through.
  std::function<bool(const Element&)> closed;
  // Returns the text at an output of a block, "" for none.
  std::function<std::string(const Source&)> value;
};

[[nodiscard]] std::vector<Row> draw_text(const Picture& picture, bool unicode, const Live& live = {});

}  // namespace indurop::plc::draw
