// SPDX-License-Identifier: Apache-2.0
// The alarms of this board: its agent evaluates their conditions, reports their states, and executes remote users'
// requests. Only reads the node's memory; not real-time safe.
//   alarms: {"watched", "declared", "counts", "alarms": [all declared or not normal], "events": [oldest first]},
//           as in /api/v1/boards/BOARD/alarms

#pragma once

#include <indurop/result.h>

#include <string>
#include <vector>

#include "core/base/log.h"
#include "core/base/problem.h"
#include "core/rt/clock.h"
#include "deploy/words/command_words.h"
#include "history/alarms/alarm_watch.h"

namespace indurop::deploy {

class BoardAlarms {
 public:
  BoardAlarms(std::string board, const base::Log& log) : board_(std::move(board)), watch_(board_), log_(log) {}

  // Evaluates the conditions when it is due.
  void step(rt::MonoTime now);

 private:
  std::string board_;
  alarms::AlarmWatch watch_;
  const base::Log& log_;
  rt::MonoTime next_check_;
  std::string problem_;
};

std::string alarms_text(const std::string& board);

// Executes Action::AckAlarms, ShelveAlarms and UnshelveAlarms. Returns the alarms that it was done to, as JSON. All or
// none.
Result<std::string, base::Problem> order_alarms(const std::string& board, const Command& command);

}  // namespace indurop::deploy
