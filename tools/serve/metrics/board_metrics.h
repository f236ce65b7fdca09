// SPDX-License-Identifier: Apache-2.0
// The metrics of one board: its schedule, its modules, its variables, its devices and the boards it receives.

#pragma once

#include <string>
#include <vector>

#include "history/alarms/alarm_book.h"
#include "tools/serve/boards/board.h"
#include "tools/serve/metrics/exposition.h"

namespace indurop::serve {

// The number of values of one board that are shown because of --metrics.
inline constexpr std::size_t kMostMetricValues = 1000;

// `selected`: patterns of variables whose values are metrics, too. Reads files of the board's configuration. A board of
// another host has what its agent reports without being asked.
void add_board(Exposition& out, const Board& board, const alarms::AlarmCounts& alarms,
               const std::vector<std::string>& selected);

}  // namespace indurop::serve
