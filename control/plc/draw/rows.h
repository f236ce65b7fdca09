// SPDX-License-Identifier: Apache-2.0
// Assigns lines to the items of a layout.

#pragma once

#include <cstddef>
#include <vector>

#include "control/plc/draw/layout_graph.h"

namespace indurop::plc::draw {

// Stacks the items of each column by rank and moves them down until most nets are straight. Afterwards the nets between
// two columns can be drawn without overlapping.
void assign_rows(Graph& graph);

// Returns the nets by the column in which they begin.
[[nodiscard]] std::vector<std::vector<std::size_t>> nets_by_column(const Graph& graph);

// `nets`: all between one column and the next. Returns the vertical track of each that is not straight; -1: straight.
// Tracks are counted from the left. Returns empty if some nets overlap in every order; then `clash` is the item to move
// down.
[[nodiscard]] std::vector<int> assign_tracks(const Graph& graph, const std::vector<std::size_t>& nets, int& clash);

// Returns the line of an input or output.
[[nodiscard]] int input_row(const Graph& graph, const End& end);
[[nodiscard]] int output_row(const Graph& graph, const End& end);

}  // namespace indurop::plc::draw
