// SPDX-License-Identifier: Apache-2.0
// The variables of the board's node, their values and what its modules printed, for remote tools. Only reads, like
// every observer of the store: no tick is affected. Not real-time safe. deploy/words/node_texts.h has the form.

#pragma once

#include <chrono>
#include <string>

#include "core/rt/clock.h"
#include "history/alarms/alarm_journal.h"

namespace indurop::deploy {

class BoardValues {
 public:
  static constexpr std::chrono::milliseconds kKeep{100};

  explicit BoardValues(std::string board) : board_(std::move(board)), journal_(board_) {}

  // Returns an empty text if no node of this board has left any variables, or they are longer than kMaxValuesBytes.
  [[nodiscard]] std::string variables() const;
  // Empty as variables(). All callers within kKeep get the same text.
  const std::string& values(rt::MonoTime now);
  void forget() { kept_until_ = {}; }

 private:
  std::string board_;
  alarms::AlarmJournal journal_;
  std::string kept_;
  rt::MonoTime kept_until_;
};

// Returns an empty list if no node of this board has left any messages.
std::string messages_text(const std::string& board);

}  // namespace indurop::deploy
