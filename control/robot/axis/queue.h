// SPDX-License-Identifier: Apache-2.0
// Commands of a single axis that wait for the motion before them.

#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

#include "control/robot/axis/command_table.h"
#include "control/robot/kinematics/errors.h"

namespace indurop::robot {

class CommandQueue {
 public:
  // Real-time safe, like all functions of this class. The table has no more tickets than there is room for.
  void push(int ticket) noexcept { tickets_[static_cast<std::size_t>(count_++)] = ticket; }
  int pop() noexcept {
    const int ticket = tickets_[0];
    std::copy(tickets_.begin() + 1, tickets_.begin() + count_, tickets_.begin());
    --count_;
    return ticket;
  }
  void abort(CommandTable& table) noexcept {
    for (int i = 0; i < count_; ++i) {
      table.end(tickets_[static_cast<std::size_t>(i)], ErrorCode::Aborted);
    }
    count_ = 0;
  }
  [[nodiscard]] int front() const noexcept { return tickets_[0]; }
  [[nodiscard]] bool empty() const noexcept { return count_ == 0; }

 private:
  std::array<int, CommandTable::kMaxCommands> tickets_{};
  int count_ = 0;
};

}  // namespace indurop::robot
