// SPDX-License-Identifier: Apache-2.0
// The output of a board's node: copies it to the agent's own output and remembers its last error message, which is the
// reason if the node dies. Messages that the node has put into the journal itself are not copied.

#pragma once

#include <string>
#include <utility>

#include "deploy/agent/line_filter.h"

namespace indurop::deploy {

class NodeOutput {
 public:
  // `own`: how the lines begin that are in the journal already; empty: none are.
  explicit NodeOutput(std::string own = {}) : others_(std::move(own)) {}
  NodeOutput(const NodeOutput&) = delete;
  NodeOutput& operator=(const NodeOutput&) = delete;
  ~NodeOutput() { close(); }

  // Takes over the read end of a pipe, which does not block.
  void open(int read_end) noexcept { pipe_ = read_end; }
  void close() noexcept;
  // Copies what has arrived. `replace`: a newer error message replaces the one that is remembered.
  void copy(bool replace);

  [[nodiscard]] const std::string& last_error() const noexcept { return last_error_; }
  void forget_error() noexcept { last_error_.clear(); }

 private:
  void add(char c, bool replace);

  LineFilter others_;
  int pipe_ = -1;
  std::string line_;  // the line that has not ended yet
  std::string last_error_;
};

}  // namespace indurop::deploy
