// SPDX-License-Identifier: Apache-2.0
// The output of a board's node: copies it to the agent's own output and remembers its last error message, which is the
// reason if the node dies.

#pragma once

#include <string>

namespace indurop::deploy {

class NodeOutput {
 public:
  NodeOutput() = default;
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

  int pipe_ = -1;
  std::string line_;  // the line that has not ended yet
  std::string last_error_;
};

}  // namespace indurop::deploy
