// SPDX-License-Identifier: Apache-2.0
// A child process indurop-node --sim --step: runs a given number of ticks at a time, and is monitored meanwhile. For a
// plant it is the node that simulates the plant, together with the nodes of its boards.

#pragma once

#include <sys/types.h>

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/temporary_folder.h"
#include "scheduler/run_block.h"
#include "store/vars/run_file.h"

namespace indurop::testing {

// Returns indurop-node in bin/ of the build tree or of the installation that this library belongs to; empty if it is
// not there.
std::filesystem::path find_node_program();

// Removes the shared memory of nodes called `prefix`PID whose process PID was killed.
void remove_orphans(std::string_view prefix);

class NodeProcess {
 public:
  // Starts the node and waits until it has stopped before its first tick. `plant`: the configuration has several
  // boards, whose nodes are called `node`-BOARD. `program`: indurop-node; empty: the one in PATH. Throws
  // std::runtime_error. Unless INDUROP_STATE_DIR is set, the state of the nodes (retained values, black boxes) is in a
  // folder of its own, which is removed in the end, as their shared memory is.
  NodeProcess(const std::string& node, bool plant, const std::vector<std::string>& arguments,
              std::chrono::seconds patience, const std::filesystem::path& program);
  ~NodeProcess();
  NodeProcess(const NodeProcess&) = delete;
  NodeProcess& operator=(const NodeProcess&) = delete;

  // Runs this many ticks. Throws if the node ends meanwhile.
  void go(std::uint64_t ticks);
  [[nodiscard]] std::uint64_t ticks() const noexcept { return ticks_; }
  struct Board {
    std::string name;  // empty: the only board
    std::string node;
    vars::RunFile file;
    std::uint64_t starts = 1;  // number of starts: a script may kill the board and let it return
    [[nodiscard]] scheduler::RunBlock& run() const noexcept { return *static_cast<scheduler::RunBlock*>(file.data()); }
  };
  // Sorted by name; at least one.
  [[nodiscard]] const std::vector<Board>& boards() const noexcept { return boards_; }
  // Period of the ticks that go() counts: the shortest of all boards.
  [[nodiscard]] std::int64_t basic_period_ns() const noexcept;
  // Returns what the node and its modules printed, without the first `after` bytes.
  [[nodiscard]] std::string printed(std::size_t after = 0) const;
  // Throws with the reason and the last output of the node.
  [[noreturn]] void fail(const std::string& what) const;

 private:
  void wait_until_it_stands();
  void find_boards();
  [[nodiscard]] std::vector<std::string> nodes() const;  // their names; of a plant those that have memory
  void check_returned();
  [[nodiscard]] bool stands() const;
  bool has_ended();
  void end() noexcept;

  std::string node_;
  std::chrono::seconds patience_;
  int commands_ = -1;
  int output_ = -1;
  pid_t pid_ = -1;
  bool plant_;
  std::optional<base::TemporaryFolder> state_;  // none: the user's
  std::vector<Board> boards_;                   // none before all of them have stopped at the first tick
  std::uint64_t ticks_ = 0;
};

}  // namespace indurop::testing
