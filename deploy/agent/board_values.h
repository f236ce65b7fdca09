// SPDX-License-Identifier: Apache-2.0
// The variables of the board's node, their values and what its modules printed, for remote tools. Only reads, like
// every observer of the store: no tick is affected. Not real-time safe.
//   variables: {"layout": 16 hexadecimal digits} in a line, then the schema as JSON (core/schema/schema.h)
//   values:    {"layout", "running", "now_ns": CLOCK_MONOTONIC or virtual time of the board,
//               "forces" and "lock" as in run_image.h, "alarms": number of them} in a line, then for each variable, in
//               the order of the schema, its freshness (i64, little endian: see below) and the bytes of its value
//   messages:  {"epoch_ns", "basic_period_ns", "messages": [{"who", "time_ns", "text"}]}, oldest first

#pragma once

#include <chrono>
#include <cstdint>
#include <limits>
#include <string>

#include "core/rt/clock.h"
#include "history/alarms/alarm_journal.h"

namespace indurop::deploy {

// Freshness of a value: 0 for the board's own, for a value of another board its age in ns plus 1, negative while that
// board is silent.
inline constexpr std::int64_t kNeverHeard = std::numeric_limits<std::int64_t>::min();
inline constexpr std::int64_t kNotRead = std::numeric_limits<std::int64_t>::max();  // it was being written

class BoardValues {
 public:
  static constexpr std::size_t kMaxBytes = 4U << 20U;
  static constexpr std::chrono::milliseconds kKeep{100};

  explicit BoardValues(std::string board) : board_(std::move(board)), journal_(board_) {}

  // Returns an empty text if no node of this board has left any variables, or they are larger than kMaxBytes.
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
