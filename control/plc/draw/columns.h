// SPDX-License-Identifier: Apache-2.0
// Assigns columns to the items of a layout.

#pragma once

#include "control/plc/draw/layout_graph.h"

namespace indurop::plc::draw {

// Puts every item after its sources, values next to the items that use them, and coils into the last column; then makes
// nets that skip columns pass through pieces of wire. Marks the graph as too large where these were too many.
void assign_columns(Graph& graph, bool rails);

}  // namespace indurop::plc::draw
