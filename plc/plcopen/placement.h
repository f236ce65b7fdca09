// SPDX-License-Identifier: Apache-2.0
// Where the elements of a drawing stand on its sheet, for what is written to a file: sizes, pins and corners of lines
// that nobody said, and all places of a drawing that has none.

#pragma once

#include "plc/network/diagram.h"

namespace indurop::plc::plcopen {

// Completes the drawing; what it means stays the same. A drawing without places whose order would change by ours keeps
// having none.
void place(network::Body& body);

}  // namespace indurop::plc::plcopen
