// SPDX-License-Identifier: Apache-2.0
// One board of a simulated plant, as the conductor sees it: an indurop-node, and the channel to it.

#pragma once

#include <indurop/result.h>
#include <sys/types.h>

#include <optional>
#include <string>
#include <vector>

#include "core/base/stop_signal.h"
#include "node/run/options.h"
#include "node/simulate/board_channel.h"

namespace indurop::node {

class ConductorBoard {
 public:
  explicit ConductorBoard(std::string name) : name_(std::move(name)) {}
  ConductorBoard(ConductorBoard&& other) noexcept;
  ConductorBoard& operator=(ConductorBoard&&) = delete;
  ConductorBoard(const ConductorBoard&) = delete;
  ConductorBoard& operator=(const ConductorBoard&) = delete;
  ~ConductorBoard();  // kills it if it runs

  // Starts the board's program, which then waits before virtual time advances from `place.begin_ns`. `options` are
  // those of the plant; empty `options.duration`: the board runs until it is commanded to end.
  Status start(const Options& options, const BoardPlace& place);

  [[nodiscard]] const std::string& name() const noexcept { return name_; }
  // Returns true if there is a channel to the board.
  [[nodiscard]] bool runs() const noexcept { return channel_.has_value(); }
  [[nodiscard]] std::int64_t next_ns() const noexcept { return answer_.next_ns; }
  [[nodiscard]] const BoardAnswer& answer() const noexcept { return answer_; }

  [[nodiscard]] pid_t pid() const noexcept { return pid_; }

  void order(const BoardOrder& order);
  // Waits for the answer to an order, or for the first answer. Returns false if the board ended without one. A stop
  // signal is passed on to a board that does not answer.
  bool await_answer(base::StopSignal& signals);
  std::vector<mirror::Message> take_sent() { return std::exchange(answer_.sent, {}); }

  // Closes the channel: the board then ends on its own.
  void close_channel() noexcept { channel_.reset(); }
  // Ends it at once, as without power.
  void kill() noexcept;
  // Waits for the board's end. Returns the exit code, 128 + number after a signal, 0 after kill(). Kills a board that
  // does not end in time.
  int await_end();

 private:
  std::string name_;
  std::optional<BoardChannel> channel_;
  pid_t pid_ = -1;
  int status_ = 0;  // exit code of an earlier end
  int starts_ = 0;
  BoardAnswer answer_;
};

}  // namespace indurop::node
