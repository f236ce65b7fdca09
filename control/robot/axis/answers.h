// SPDX-License-Identifier: Apache-2.0
// Answers to those who commanded an axis: commands of the table and requests, and the command that holds its power.

#pragma once

#include <indurop/robot/controller.h>

#include "control/robot/axis/command_table.h"

namespace indurop::robot {

// Who waits for the end of an action: a ticket of the table, the request, or the job.
struct AxisOwner {
  static constexpr int kNone = CommandTable::kNone;
  static constexpr int kRequest = -2;
  static constexpr int kJob = -3;  // sees what the axis does

  int ticket = kNone;
  AxisService service = AxisService::None;

  [[nodiscard]] bool any() const noexcept { return ticket != kNone; }
  [[nodiscard]] bool is_request() const noexcept { return ticket == kRequest; }
  [[nodiscard]] bool is_command() const noexcept { return ticket >= 0; }
};

class AxisAnswers {
 public:
  // `state` and `table` must outlive it.
  explicit AxisAnswers(const AxisState& state) noexcept : state_(state) {}
  void set_table(CommandTable* table) noexcept { table_ = table; }
  [[nodiscard]] CommandTable& table() const noexcept { return *table_; }

  // Ends what the owner waits for, who is free afterwards. A command that holds power is done, but does not end.
  // Real-time safe, like all functions of this class.
  void finish(AxisOwner& owner, ErrorCode code) noexcept;
  // The same for an action that has ended at once.
  void answer(int ticket, AxisService service, ErrorCode code) noexcept;
  // The action has begun.
  void active(int ticket) noexcept;
  // The next action begins: an earlier error is no longer reported, except in ErrorStop.
  void forget_error() noexcept;
  // ErrorStop is left.
  void clear_error() noexcept { report_.error = ErrorCode::Ok; }

  // The command that holds power as long as it has its Execute.
  [[nodiscard]] int holder() const noexcept { return holder_; }
  [[nodiscard]] bool has_holder() const noexcept { return holder_ != AxisOwner::kNone; }
  void set_holder(int ticket) noexcept { holder_ = ticket; }
  [[nodiscard]] bool holds_power() const noexcept { return has_holder() && table_->execute(holder_); }

  [[nodiscard]] AxisReport& report() noexcept { return report_; }
  [[nodiscard]] const AxisReport& report() const noexcept { return report_; }

 private:
  const AxisState& state_;
  CommandTable* table_ = nullptr;
  int holder_ = AxisOwner::kNone;
  AxisReport report_;
};

}  // namespace indurop::robot
