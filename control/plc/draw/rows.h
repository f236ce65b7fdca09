// SPDX-License-Identifier: Apache-2.0
// Assigns lines to the items of a layout.

#pragma once

#include "control/plc/draw/layout_graph.h"

namespace indurop::plc::draw {

// Stacks the items of each column by rank and moves them down until most nets are straight. Afterwards the nets between
// two columns can be drawn without overlapping.
void assign_rows(Graph& graph);

// Returns the vertical track, between column `column` and the next, of each net that is not straight; -1: straight, or
// elsewhere. Tracks are counted from the left. Returns empty if some nets overlap in every order; then `clash` is the
// item to move down.
[[nodiscard]] std::vector<int> assign_tracks(const Graph& graph, int column, int& clash);

// Returns the line of an input or output.
[[nodiscard]] int input_row(const Graph& graph, const End& end);
[[nodiscard]] int output_row(const Graph& graph, const End& end);

}  // namespace indurop::plc::draw
