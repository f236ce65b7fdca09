// SPDX-License-Identifier: Apache-2.0
// A network in characters, as a terminal shows it: at rest, or with the power that flows.

#pragma once

#include <functional>
#include <vector>

#include "plc/draw/canvas.h"
#include "plc/draw/picture.h"

namespace indurop::plc::draw {

// What is known of a running program; null functions: nothing.
struct Live {
  std::function<bool(const Source&)> powered;
  // Whether the variable of a contact or coil lets power through.
  std::function<bool(const Element&)> closed;
  // Shown at an output of a block, "" for none.
  std::function<std::string(const Source&)> value;
};

[[nodiscard]] std::vector<Row> draw_text(const Picture& picture, bool unicode, const Live& live = {});

}  // namespace indurop::plc::draw
