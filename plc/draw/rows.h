// SPDX-License-Identifier: Apache-2.0
// Lines of the items of a layout.

#pragma once

#include "plc/draw/layout_graph.h"

namespace indurop::plc::draw {

// Stacks the items of each column in the order of their ranks and moves them down until most nets are straight. Then
// the nets between two columns can be drawn without lying on top of each other.
void assign_rows(Graph& graph);

// Which of the vertical tracks between column `column` and the next each net that is not straight takes; -1: straight,
// or elsewhere. Tracks are counted from the left. Empty if some nets lie on top of each other in every order; then
// `clash` is the item to move down.
[[nodiscard]] std::vector<int> assign_tracks(const Graph& graph, int column, int& clash);

// Line of an input or output.
[[nodiscard]] int input_row(const Graph& graph, const End& end);
[[nodiscard]] int output_row(const Graph& graph, const End& end);

}  // namespace indurop::plc::draw
