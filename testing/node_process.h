// SPDX-License-Identifier: Apache-2.0
// An indurop-node --sim --step of this process: told how far to go, and watched while it goes there.

#pragma once

#include <sys/types.h>

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "scheduler/run_block.h"
#include "vars/run_file.h"

namespace indurop::testing {

class NodeProcess {
 public:
  // Starts it and waits until it stands before its first tick. Throws std::runtime_error.
  NodeProcess(const std::string& node, const std::vector<std::string>& arguments, std::chrono::seconds patience);
  ~NodeProcess();
  NodeProcess(const NodeProcess&) = delete;
  NodeProcess& operator=(const NodeProcess&) = delete;

  // Goes on by so many ticks. Throws if it ends on the way.
  void go(std::uint64_t ticks);
  [[nodiscard]] std::uint64_t ticks() const noexcept { return ticks_; }
  [[nodiscard]] scheduler::RunBlock& run() const noexcept;
  [[nodiscard]] std::string printed() const;
  // Why something cannot be done, with the node's last words.
  [[noreturn]] void fail(const std::string& what) const;

 private:
  void wait_until_it_stands();
  bool has_ended();
  void end() noexcept;

  std::string node_;
  std::chrono::seconds patience_;
  int commands_ = -1;
  int output_ = -1;
  pid_t pid_ = -1;
  std::optional<vars::RunFile> file_;
  std::uint64_t ticks_ = 0;
};

}  // namespace indurop::testing
