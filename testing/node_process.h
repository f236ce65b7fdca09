// SPDX-License-Identifier: Apache-2.0
// An indurop-node --sim --step of this process: told how far to go, and watched while it goes there. Of a plant it is
// the node that simulates it, and those of its boards.

#pragma once

#include <sys/types.h>

#include <chrono>
#include <cstdint>
#include <string>
#include <vector>

#include "scheduler/run_block.h"
#include "vars/run_file.h"

namespace indurop::testing {

class NodeProcess {
 public:
  // Starts it and waits until it stands before its first tick. `plant`: the configuration is one of several boards,
  // whose nodes are called `node`-BOARD. Throws std::runtime_error.
  NodeProcess(const std::string& node, bool plant, const std::vector<std::string>& arguments,
              std::chrono::seconds patience);
  ~NodeProcess();
  NodeProcess(const NodeProcess&) = delete;
  NodeProcess& operator=(const NodeProcess&) = delete;

  // Goes on by so many ticks. Throws if it ends on the way.
  void go(std::uint64_t ticks);
  [[nodiscard]] std::uint64_t ticks() const noexcept { return ticks_; }
  struct Board {
    std::string name;  // empty: the only one
    std::string node;
    vars::RunFile file;
    std::uint64_t starts = 1;  // a script may kill it and have it return
    [[nodiscard]] scheduler::RunBlock& run() const noexcept { return *static_cast<scheduler::RunBlock*>(file.data()); }
  };
  // By name. At least one.
  [[nodiscard]] const std::vector<Board>& boards() const noexcept { return boards_; }
  // Of the ticks that go() counts: the shortest of all boards.
  [[nodiscard]] std::int64_t basic_period_ns() const noexcept;
  [[nodiscard]] std::string printed() const;
  // Why something cannot be done, with the node's last words.
  [[noreturn]] void fail(const std::string& what) const;

 private:
  void wait_until_it_stands();
  void find_boards();
  void look_for_returned();
  [[nodiscard]] bool stands() const;
  bool has_ended();
  void end() noexcept;

  std::string node_;
  std::chrono::seconds patience_;
  int commands_ = -1;
  int output_ = -1;
  pid_t pid_ = -1;
  bool plant_;
  std::vector<Board> boards_;  // none before they stand
  std::uint64_t ticks_ = 0;
};

}  // namespace indurop::testing
