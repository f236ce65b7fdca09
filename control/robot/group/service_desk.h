// SPDX-License-Identifier: Apache-2.0
// The service that is being executed: takes it from a request or a command, and reports its end. One at a time.

#pragma once

#include "control/robot/group/group_port.h"
#include "control/robot/group/plans.h"
#include "control/robot/group/robot.h"
#include "control/robot/group/services.h"

namespace indurop::robot {

class ServiceDesk {
 public:
  ServiceDesk(Robot& robot, GroupPort& group, Plans& plans, Services& services) noexcept
      : robot_(robot), group_(group), plans_(plans), services_(services) {}

  // Takes a request if its number is new; `edit`: also without a new number. Real-time safe, like all functions of this
  // class.
  void serve(const ServiceRequest& request, bool edit) noexcept;
  // Takes a command. A command that waits for the planning thread is taken again by retry(), and aborted by the next
  // command.
  void take(int ticket) noexcept;
  void retry() noexcept;
  void abort_waiting() noexcept;
  // Ends the service, if one is being executed.
  void finish(const Fault& result) noexcept;

  [[nodiscard]] bool active() const noexcept { return active_; }
  [[nodiscard]] bool is_serving(Service service) const noexcept { return active_ && service_ == service; }
  void report(Outputs& out) const noexcept;

 private:
  [[nodiscard]] bool has_to_wait(Service service) noexcept;
  void begin(Service service, const ServiceRequest& request) noexcept;

  Robot& robot_;
  GroupPort& group_;
  Plans& plans_;
  Services& services_;
  bool first_ = true;
  bool active_ = false;
  bool by_edit_ = false;
  bool edit_done_ = false;
  bool motion_done_ = false;
  Service service_ = Service::None;
  std::uint32_t acknowledged_ = 0;
  std::uint32_t done_ = 0;
  int ticket_ = CommandTable::kNone;   // of the command that waits for the service; kNone: the request does
  int waiting_ = CommandTable::kNone;  // of a command that waits for the planning thread
};

}  // namespace indurop::robot
