// SPDX-License-Identifier: Apache-2.0
// Space on a board's disk that only the end of a deployment uses: what the board commits, what it says to its node, and
// what the node answers is written even if something else (a recording, a log) has filled the disk since the deployment
// began.

#pragma once

#include <indurop/result.h>

#include <cerrno>
#include <filesystem>

#include "core/base/problem.h"

namespace indurop::deploy {

class DiskReserve {
 public:
  // The space is in a file of this folder, `reserve`.
  explicit DiskReserve(const std::filesystem::path& folder) : file_(folder / "reserve") {}

  // Takes the space, if it is not taken yet. A problem: the disk has no such space, or cannot be written.
  Result<void, base::Problem> take() const;
  // Calls `write`, which returns a Result or Status; if the disk is full, gives the space back and calls it again.
  template <class Write>
  auto use_for(Write&& write) const {
    auto written = write();
    if (!written && written.error().sys_errno == ENOSPC) {
      give();
      written = write();
    }
    return written;
  }

  // Gives the space back if the disk is full: another process has something to write.
  void give_if_full() const noexcept;

 private:
  void give() const noexcept;
  std::filesystem::path file_;
};

}  // namespace indurop::deploy
