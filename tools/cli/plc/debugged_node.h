// SPDX-License-Identifier: Apache-2.0
// The simulated node whose programs are debugged: started, started again from the beginning, and ended.

#pragma once

#include <sys/types.h>

#include <filesystem>
#include <optional>
#include <string>

#include "core/base/descriptor.h"
#include "core/base/spawn.h"

namespace indurop::tools {

class DebuggedNode {
 public:
  // `socket`: where its modules reach the debugger. `until`: when the simulation ends; empty: never.
  DebuggedNode(const std::string& config, const std::filesystem::path& socket, const std::string& until);
  DebuggedNode(const DebuggedNode&) = delete;
  DebuggedNode& operator=(const DebuggedNode&) = delete;
  ~DebuggedNode();

  // Starts it, and ends what ran before at once. `silent`: what it prints is not shown. Returns false if it cannot be
  // started.
  bool start(bool silent);
  // Returns the exit code if it has ended on its own.
  std::optional<int> ended();
  [[nodiscard]] const std::string& name() const noexcept { return name_; }
  // Writes a shared variable, "NAME=VALUE". Returns why that was impossible; empty: it was written, or `indurop set`
  // has said why not.
  std::string set(const std::string& assignment, bool quiet) const;

 private:
  void kill_group();

  std::string name_;
  base::Launch launch_;
  base::Descriptor nowhere_;
  pid_t process_ = 0;  // 0: none
};

}  // namespace indurop::tools
