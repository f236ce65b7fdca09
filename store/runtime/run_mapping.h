// SPDX-License-Identifier: Apache-2.0
// The run block of a node, mapped by a process that is one of its modules.

#pragma once

#include <indurop/result.h>

#include <memory>
#include <string>

#include "scheduler/run_block.h"
#include "store/vars/shm_file.h"

namespace indurop::runtime {

class RunMapping {
 public:
  // Errors: NotFound, PermissionDenied, VersionMismatch, Corrupt, Busy (not complete yet), System.
  static Result<RunMapping> open(const std::string& node);

  [[nodiscard]] scheduler::RunBlock& block() const noexcept {
    return *reinterpret_cast<scheduler::RunBlock*>(file_.data());
  }
  // Returns true if the node process that created it is alive. Not real-time safe.
  [[nodiscard]] bool node_alive() const noexcept;

 private:
  explicit RunMapping(vars::ShmFile&& file) noexcept : file_(std::move(file)) {}
  vars::ShmFile file_;
};

bool is_ending(const scheduler::RunBlock& run) noexcept;  // the node stops or has stopped

}  // namespace indurop::runtime
