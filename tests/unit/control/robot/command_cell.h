// SPDX-License-Identifier: Apache-2.0
// A cell that is given commands as blocks of a PLC program give them.

#pragma once

#include <initializer_list>
#include <string>
#include <utility>

#include "group_cell.h"

namespace indurop::robot {

class CommandCell {
 public:
  explicit CommandCell(double period_ms = 10, Settings settings = {}, const std::string& urdf = "",
                       const std::string& job = "")
      : cell(job, period_ms, 0, true, std::move(settings), urdf) {}

  // What a block sees of a command it has given.
  struct Given {
    std::size_t place = 0;
    std::uint32_t number = 0;
  };

  Command& next() {
    for (std::size_t tries = 0; tries < kCommands; ++tries) {
      place_ = (place_ + 1) % kCommands;
      const CommandState state = cell.out.commands[place_].state;
      const bool open = cell.in.commands[place_].number != 0 &&
                        (state == CommandState::None || state == CommandState::Waits || state == CommandState::Active ||
                         cell.in.commands[place_].execute != 0);
      if (!open) {
        break;
      }
    }
    Command& command = cell.in.commands[place_];
    command = {};
    command.number = ++number_;
    return command;
  }
  Given give(int axis, AxisService service, double to = 0, double velocity = 0,
             BufferMode buffer = BufferMode::Aborting) {
    Command& c = next();
    c.code = static_cast<std::int32_t>(service);
    c.axis = axis;
    c.to[0] = to;
    c.velocity = velocity;
    c.buffer = buffer;
    c.execute = service == AxisService::Stop ? 1 : 0;
    return {place_, c.number};
  }
  Given give(Service service, std::array<double, 8> to = {}, double velocity = 0,
             BufferMode buffer = BufferMode::Aborting, CoordSystem coords = CoordSystem::Axes, double transition = 0) {
    Command& c = next();
    c.code = static_cast<std::int32_t>(service);
    c.to = to;
    c.velocity = velocity;
    c.buffer = buffer;
    c.coords = coords;
    c.transition = transition;
    c.execute = service == Service::Stop ? 1 : 0;
    return {place_, c.number};
  }
  Command& command(const Given& given) { return cell.in.commands[given.place]; }
  [[nodiscard]] CommandState state(const Given& given) const {
    const CommandAnswer& answer = cell.out.commands[given.place];
    return answer.number == given.number ? answer.state : CommandState::None;
  }
  [[nodiscard]] ErrorCode error(const Given& given) const { return cell.out.commands[given.place].error; }
  [[nodiscard]] bool reached(const Given& given) const { return cell.out.commands[given.place].reached; }
  [[nodiscard]] bool ended(const Given& given) const {
    return state(given) == CommandState::Done || state(given) == CommandState::Aborted ||
           state(given) == CommandState::Error;
  }
  // True if it is done in the end.
  [[nodiscard]] bool done(const Given& given) {
    return cell.until([&] { return ended(given); }) && state(given) == CommandState::Done;
  }
  [[nodiscard]] double joint(std::size_t i) const { return cell.out.command[i]; }
  [[nodiscard]] AxisState axis(std::size_t i) const { return cell.out.axes[i].state; }

  Cell cell;

 private:
  std::size_t place_ = kCommands - 1;
  std::uint32_t number_ = 0;
};

}  // namespace indurop::robot
