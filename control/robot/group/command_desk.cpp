// SPDX-License-Identifier: Apache-2.0
#include "control/robot/group/command_desk.h"

namespace indurop::robot {

void CommandDesk::serve(const Inputs& in, const ModeGuard& mode) noexcept {
  CommandTable& table = robot_.table;
  table.read(in.commands, in.requests_known);
  robot_.axes.set_profiles(in.profiles);  // those of waiting commands are still in it
  robot_.singles.set_profiles(in.profiles);
  services_.retry();
  press_.sense();
  for (int ticket = table.take(); ticket != CommandTable::kNone; ticket = table.take()) {
    const int axis = table.command(ticket).axis;
    if (axis == 0) {
      take(ticket, in.cams);
    } else if (axis > 0 && axis <= robot_.count()) {
      robot_.axes[axis - 1].take(ticket, mode.axis_permit());
    } else if (axis > 0 && axis <= robot_.count() + robot_.singles.count()) {
      robot_.singles[axis - 1 - robot_.count()].take(ticket, mode.permit());
    } else {
      table.end(ticket, ErrorCode::Value);
    }
  }
  press_.step();
}

void CommandDesk::take(int ticket, const CamTables& cams) noexcept {
  CommandTable& table = robot_.table;
  const Command& command = table.command(ticket);
  const Service service = group_service_of(command);
  services_.abort_waiting();
  if (is_motion(service)) {
    if (service == Service::Halt) {
      others_.sync.end_at_rest();
      press_.end_at_rest();
    }
    queue_.take(ticket);
    return;
  }
  switch (service) {
    case Service::GroupEnable:
    case Service::GroupDisable:
    case Service::GroupReset:
    case Service::GroupHome:
    case Service::JobStart:
    case Service::SelectTool:
      services_.take(ticket);
      break;
    case Service::Stop:
      others_.stops.take(ticket);
      break;
    case Service::Interrupt:
      queue_.interrupt(ticket);
      break;
    case Service::Continue:
      queue_.go_on(ticket);
      break;
    case Service::SetTransform:
      table.end(ticket, others_.conveyor.set_product(command));
      break;
    case Service::TrackBelt:
    case Service::TrackTable:
      table.end(ticket, others_.conveyor.track(command, service == Service::TrackTable));
      break;
    case Service::FollowMaster:
      others_.sync.take(ticket);
      break;
    case Service::Press:
      press_.take(ticket);
      break;
    case Service::SelectCam:
      static_cast<void>(robot_.singles.set_cam(command.option - 1, cams, command.job == 1));
      table.end(ticket, robot_.axes.set_cam(command.option - 1, cams, command.job == 1));
      break;
    default:
      table.end(ticket, ErrorCode::Opcode);
  }
}

}  // namespace indurop::robot
