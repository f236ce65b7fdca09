// SPDX-License-Identifier: Apache-2.0
// Places the elements of a drawing on its sheet before it is written to a file: missing sizes, pins and corners of
// lines, and all places of a drawing that has none.

#pragma once

#include "control/plc/network/diagram.h"

namespace indurop::plc::plcopen {

// Completes the drawing without changing its meaning. A drawing without places stays as it is if places would change
// its order of execution.
void place(network::Body& body);

}  // namespace indurop::plc::plcopen
