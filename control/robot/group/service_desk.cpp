// SPDX-License-Identifier: Apache-2.0
#include "control/robot/group/service_desk.h"

#include <algorithm>
#include <utility>

namespace indurop::robot {

namespace {

bool is_move(Service service) noexcept {
  return service == Service::MoveJoints || service == Service::MoveLine || service == Service::MoveCircle ||
         service == Service::DirectAbsolute || service == Service::LinearAbsolute;
}

// Services of requests; the others exist as commands only.
bool is_of_requests(Service service) noexcept {
  return service <= Service::JobBack || service == Service::JobReload;
}

}  // namespace

// Returns whether a request for this service is taken in a later period.
bool ServiceDesk::has_to_wait(Service service) noexcept {
  if (is_move(service) && robot_.states.moving() && !robot_.job.running() && !plans_.free()) {
    return true;  // the motion before it is still being planned
  }
  if ((service == Service::SelectTool || service == Service::JobStart || service == Service::JobResume) &&
      group_.settled() && plans_.holds_forgotten()) {
    return true;  // a plan for the tool before is still being checked
  }
  return service == Service::JobResume && services_.comes_to_rest();  // it continues at standstill
}

void ServiceDesk::serve(const ServiceRequest& request, bool edit) noexcept {
  if (first_) {
    // Requests from before this program started are ignored.
    first_ = false;
    acknowledged_ = done_ = request.number;
    robot_.states.report_first(request.number != 0 ? ErrorCode::Aborted : ErrorCode::Ok);
    return;
  }
  edit_done_ = edit_done_ && edit;
  const bool numbered = request.number != acknowledged_;
  if (!numbered && (!edit || by_edit_ || edit_done_)) {
    by_edit_ = by_edit_ && (edit || active_);
    return;
  }
  const auto asked = static_cast<Service>(request.code);
  if (has_to_wait(asked)) {
    return;
  }
  acknowledged_ = request.number;
  by_edit_ = !numbered;
  if (active_ && ticket_ != CommandTable::kNone) {
    finish({ErrorCode::Aborted});
  }
  begin(is_of_requests(asked) ? asked : static_cast<Service>(-1), request);
}

void ServiceDesk::take(int ticket) noexcept {
  const Command& command = robot_.table.command(ticket);
  const auto service = static_cast<Service>(command.code);
  if (service == Service::JobStart && robot_.states.moving()) {
    robot_.table.end(ticket, ErrorCode::State);
    return;
  }
  const bool tools = service == Service::JobStart || service == Service::SelectTool;
  if (tools && group_.settled() && plans_.holds_forgotten()) {
    waiting_ = ticket;  // a plan for the tool before is still being checked
    return;
  }
  ServiceRequest request;
  request.job = request.tool = static_cast<std::uint32_t>(std::max<std::int16_t>(0, command.job));
  finish({ErrorCode::Aborted});
  robot_.table.active(ticket);
  ticket_ = ticket;
  begin(service, request);
}

void ServiceDesk::retry() noexcept {
  if (waiting_ != CommandTable::kNone && !plans_.holds_forgotten()) {
    take(std::exchange(waiting_, CommandTable::kNone));
  }
}

void ServiceDesk::abort_waiting() noexcept {
  if (waiting_ != CommandTable::kNone) {
    robot_.table.end(std::exchange(waiting_, CommandTable::kNone), ErrorCode::Aborted);
  }
}

void ServiceDesk::begin(Service service, const ServiceRequest& request) noexcept {
  service_ = service;
  active_ = true;
  motion_done_ = false;
  robot_.states.report(ErrorCode::Ok, 0);
  if (const ErrorCode code = services_.begin(service, request); code != ErrorCode::Ok) {
    finish({code});
  }
}

void ServiceDesk::finish(const Fault& result) noexcept {
  if (!active_) {
    return;
  }
  active_ = false;
  if (ticket_ != CommandTable::kNone) {
    robot_.table.end(ticket_, result.code);
    ticket_ = CommandTable::kNone;
    robot_.states.report_axis(result.axis);
    return;
  }
  done_ = acknowledged_;
  motion_done_ = result.code == ErrorCode::Ok;
  edit_done_ = by_edit_;
  by_edit_ = false;
  robot_.states.report(result.code, result.axis);
}

void ServiceDesk::report(Outputs& out) const noexcept {
  out.motion_done = motion_done_ && !active_;
  out.edit_done = edit_done_;
  out.acknowledged = acknowledged_;
  out.done = done_;
}

}  // namespace indurop::robot
