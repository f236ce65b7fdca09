// SPDX-License-Identifier: Apache-2.0
#include "control/robot/job/step_motions.h"

#include <array>

namespace indurop::robot {

void MotionSettings::apply(const Step& step) noexcept {
  if (step.op == Op::Zone) {
    zone = step.value;
  } else if (step.op == Op::Acceleration) {
    acceleration = step.value;
  } else if (step.op == Op::Tool) {
    tool = step.index;
  } else if (step.op == Op::Weave) {
    wave = step.slot;
  } else if (step.op == Op::Speed && step.index == 1) {
    tool_speed = step.value;
  } else if (step.op == Op::Speed) {
    speed = step.value;
    tool_speed = 0;
  }
}

StepValues::Flaw StepMotions::place(const Step& step, int tool, const MotionPort& port, Target& target) const noexcept {
  if (step.index >= 0) {
    target = places_.target(step.index, tool);
    return {};
  }
  if (step.index == kBack && port.left_at() == nullptr) {
    return {"BACK is where an interrupt left the path; there is none, this job was not called by ON"};
  }
  if (step.index == kFound && !places_.found().known) {
    return {"FOUND is where UNTIL ended a motion, and the last one ended nowhere; ask IF FOUND before"};
  }
  target.joints = step.index == kBack    ? *port.left_at()
                  : step.index == kFound ? places_.found().joints
                                         : port.commanded();
  target.is_pose = step.formula >= 0;
  target.pose = port.tip_at(target.joints);
  return {};
}

StepValues::Flaw StepMotions::shift(const Step& step, Signals& signals, const MotionPort& port,
                                    Target& target) const noexcept {
  std::array<double, 6> numbers{};
  const std::size_t count = step.turns ? 6 : 3;
  if (const auto flaw = values_.numbers(step.formula, count, signals, port, numbers.data()); !flaw.ok()) {
    return flaw;
  }
  const Quat axes = step.by_tool      ? target.pose.orientation
                    : step.index >= 0 ? places_.axes(step.index)
                                      : Quat::Identity();
  target.pose.position += axes * Vec3(numbers[0], numbers[1], numbers[2]) / 1000;
  if (step.turns) {
    const Quat turn = from_rpy({radians(numbers[3]), radians(numbers[4]), radians(numbers[5])});
    target.pose.orientation = (axes * turn * axes.conjugate() * target.pose.orientation).normalized();
  }
  target.known = nullptr;
  return {};
}

// The pose of the target stays the same. If a joint motion goes to joint values, the other axes keep theirs.
void StepMotions::give_axis(const Step& setting, Move move, const MotionPort& port, Target& target) noexcept {
  target.known = nullptr;  // found for other values of the axis
  if (!target.is_pose && move == Move::Joint) {
    target.joints[setting.index] = setting.value;
    return;
  }
  if (!target.is_pose) {
    target.pose = port.tip_at(target.joints);
    target.is_pose = true;
  }
  target.joints[setting.index] = setting.value;
  target.held |= 1U << static_cast<unsigned>(setting.index);
}

StepValues::Flaw StepMotions::make(const Step& step, const MotionSettings& settings, Signals& signals,
                                   const MotionPort& port, MoveCommand& command) const noexcept {
  command.move = step.move;
  if (const auto flaw = place(step, settings.tool, port, command.target); !flaw.ok()) {
    return flaw;
  }
  if (step.formula >= 0) {
    if (const auto flaw = shift(step, signals, port, command.target); !flaw.ok()) {
      return flaw;
    }
  }
  if (step.mid >= 0) {
    command.mid = places_.target(step.mid, settings.tool);
  }
  MotionSettings own = settings;
  const MotionExtras* const extras = book_.extras_of(step);
  for (std::size_t i = 0; extras != nullptr && i < extras->settings.size(); ++i) {
    Step with;
    if (const auto flaw = values_.setting(extras->settings[i], signals, port, with); !flaw.ok()) {
      return flaw;
    }
    own.apply(with);
    if (with.op == Op::Axis) {
      give_axis(with, step.move, port, command.target);
    }
  }
  const bool until = extras != nullptr && extras->until >= 0;
  const bool of_joints = is_of_joints(step.move);
  command.speed = own.speed;
  command.tool_speed = of_joints ? 0 : own.tool_speed;
  command.zone = until || step.move == Move::Free ? 0 : own.zone;
  command.acceleration = own.acceleration;
  command.straight = step.move == Move::Joint && step.value != 0;
  command.more = step.move == Move::Spline && step.value != 0;
  command.alone = until;
  if (extras != nullptr) {
    command.seed = extras->seed;
    command.within = extras->within;
    command.sync = extras->sync;
    command.alone = command.alone || extras->sync >= 0;
  }
  if (own.wave >= 0 && !of_joints) {
    command.wave = book_.waves[static_cast<std::size_t>(own.wave)];
    command.zone = 0;
    command.alone = true;
  }
  return {};
}

}  // namespace indurop::robot
