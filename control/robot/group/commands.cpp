// SPDX-License-Identifier: Apache-2.0
// Commands of the group that are no motions: each one ends on its own, and a later one replaces the one before.

#include <algorithm>
#include <cmath>
#include <utility>

#include "control/robot/group/group.h"

namespace indurop::robot {

namespace {

bool is_motion(Service service) noexcept {
  switch (service) {
    case Service::DirectAbsolute:
    case Service::DirectRelative:
    case Service::LinearAbsolute:
    case Service::LinearRelative:
    case Service::CircularAbsolute:
    case Service::CircularRelative:
    case Service::Halt:
      return true;
    default:
      return false;
  }
}

}  // namespace

void Group::serve_commands(const Inputs& in) noexcept {
  table_.read(in.commands, in.requests_known);
  profiles_ = in.profiles;  // those of waiting commands are still in it
  if (later_ != CommandTable::kNone && !desk_.holds_forgotten()) {
    const int ticket = std::exchange(later_, CommandTable::kNone);
    administer(ticket, static_cast<Service>(table_.command(ticket).code));
  }
  for (int ticket = table_.take(); ticket != CommandTable::kNone; ticket = table_.take()) {
    const int axis = table_.command(ticket).axis;
    if (axis == 0) {
      take(ticket, in.cams);
    } else if (axis > 0 && axis <= count()) {
      axes_[static_cast<std::size_t>(axis - 1)].take(ticket, axis_permit());
    } else {
      table_.end(ticket, ErrorCode::Value);
    }
  }
}

void Group::take(int ticket, const CamTables& cams) noexcept {
  const Command& command = table_.command(ticket);
  const auto service = static_cast<Service>(command.code);
  if (later_ != CommandTable::kNone) {
    table_.end(std::exchange(later_, CommandTable::kNone), ErrorCode::Aborted);
  }
  if (is_motion(service)) {
    queue_motion(ticket);
    return;
  }
  switch (service) {
    case Service::GroupEnable:
    case Service::GroupDisable:
    case Service::GroupReset:
    case Service::GroupHome:
    case Service::JobStart:
    case Service::SelectTool:
      administer(ticket, service);
      break;
    case Service::Stop:
      stop_for(ticket);
      break;
    case Service::Interrupt:
      interrupt(ticket);
      break;
    case Service::Continue:
      go_on(ticket);
      break;
    case Service::SetTransform:
      table_.end(ticket, set_transform(command));
      break;
    case Service::TrackBelt:
    case Service::TrackTable:
      table_.end(ticket, track(command, service == Service::TrackTable));
      break;
    case Service::SelectCam:
      table_.end(ticket, select_cam(command, cams));
      break;
    default:
      table_.end(ticket, ErrorCode::Opcode);
  }
}

// A follower that uses another cam of that number continues with the old one.
ErrorCode Group::select_cam(const Command& command, const CamTables& cams) noexcept {
  const int number = command.option - 1;
  if (number < 0 || number >= static_cast<int>(kCams)) {
    return ErrorCode::Value;
  }
  const auto k = static_cast<std::size_t>(number);
  return cams_[k].set(cams[k], command.job == 1);
}

void Group::administer(int ticket, Service service) noexcept {
  if (service == Service::JobStart && state_ == GroupState::Moving) {
    table_.end(ticket, ErrorCode::State);
    return;
  }
  const bool tools = service == Service::JobStart || service == Service::SelectTool;
  if (tools && settled() && desk_.holds_forgotten()) {
    later_ = ticket;  // a plan for the tool before is still being checked
    return;
  }
  ServiceRequest request;
  request.job = request.tool = static_cast<std::uint32_t>(std::max<std::int16_t>(0, table_.command(ticket).job));
  finish_service(ErrorCode::Aborted);
  table_.active(ticket);
  ticket_ = ticket;
  begin_service(service, request);
}

// Stops from any state with power, and holds as long as its function block has its Execute input set.
void Group::stop_for(int ticket) noexcept {
  if (!powered() || to_error_ || to_disabled_) {
    table_.end(ticket, ErrorCode::State);
    return;
  }
  finish_service(ErrorCode::Aborted);
  release_stop();
  stop_ = ticket;
  table_.active(ticket);
  if (state_ == GroupState::Stopping) {
    return;
  }
  set_job_aside();
  job_.stop();
  forget_plans();
  if (state_ == GroupState::Moving) {
    follower_.stop();
  } else {
    follower_.reset(commanded());
    on_path_ = std::none_of(axes().begin(), axes().end(), [](const AxisControl& a) { return a.busy(); });
    for (AxisControl& a : axes()) {
      a.halt();
    }
  }
  state_ = GroupState::Stopping;
}

void Group::release_stop() noexcept {
  if (stop_ != CommandTable::kNone) {
    table_.end(stop_, !to_error_ && !to_disabled_ && !table_.execute(stop_) ? ErrorCode::Ok : ErrorCode::Aborted);
    stop_ = CommandTable::kNone;
  }
}

// Interrupts: comes to rest on the path, whatever follows.
void Group::interrupt(int ticket) noexcept {
  if (state_ != GroupState::Moving) {
    table_.end(ticket, ErrorCode::State);
    return;
  }
  end_interrupt(ErrorCode::Aborted);
  interrupted_ = true;
  interrupt_ = ticket;
  table_.active(ticket);
}

void Group::go_on(int ticket) noexcept {
  table_.end(ticket, interrupted_ ? ErrorCode::Ok : ErrorCode::State);
  interrupted_ = false;
  end_interrupt(ErrorCode::Aborted);
}

void Group::end_interrupt(ErrorCode code) noexcept {
  if (interrupt_ != CommandTable::kNone) {
    table_.end(interrupt_, code);
    interrupt_ = CommandTable::kNone;
  }
}

// Sets hold and override, for the path and for single axes. Values above full speed count as full speed; values that
// are not numbers hold all motions, which pace_wrong_ indicates.
void Group::set_pace(const Inputs& in) noexcept {
  pace_wrong_ = false;
  const auto factor = [this](double given) {
    const bool known = given >= 0 && std::isfinite(given);
    pace_wrong_ = pace_wrong_ || !known;
    return known ? std::min(given, 1.0) : 0;
  };
  const double part = factor(in.speed_override / 100);
  follower_.set_override(part * factor(in.factors.group) * ride_pace_);
  follower_.set_tip_limit(std::max(0.1 * tip_limit(), tip_limit() - ride_speed_));
  paused_ = in.hold || interrupted_ || part * factor(in.factors.group) < Follower::kStill;
  follower_.set_hold(in.hold || interrupted_ || (tracking_.on() && !tracking_.rides()));
  const double slow = axes_pace();
  for (std::size_t i = 0; i < axis_count(); ++i) {
    axes_[i].set_override(in.hold ? 0 : std::min(part * factor(in.factors.velocity[i]), slow));
    axes_[i].set_factors(in.factors.acceleration[i], in.factors.jerk[i]);
  }
}

// Sets the product's coordinates in those of the machine.
ErrorCode Group::set_transform(const Command& command) noexcept {
  if (!std::all_of(command.to.begin(), command.to.begin() + 6, [](double x) { return std::isfinite(x); })) {
    return ErrorCode::Value;
  }
  get_off();
  tracking_.forget();
  product_lost_ = false;
  product_ = pose_of(command.to);
  std::copy_n(command.to.begin(), product_given_.size(), product_given_.begin());
  return ErrorCode::Ok;
}

}  // namespace indurop::robot
