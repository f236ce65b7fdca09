// SPDX-License-Identifier: Apache-2.0
#include "control/robot/axis/body.h"

#include "control/robot/axis/control.h"

namespace indurop::robot {

const AxisControl& AxisNeighbours::axis(int index) const noexcept {
  return axes[static_cast<std::size_t>(index)];
}

bool AxisParts::busy() const noexcept {
  return state == AxisState::DiscreteMotion || state == AxisState::ContinuousMotion || state == AxisState::Stopping ||
         state == AxisState::Homing || following.coupled();
}

void AxisParts::leave_torque() noexcept {
  if (pushing.leave(drive)) {
    motion.reset(motion.state());
    motion.stop(bounds.limits(1));
  }
}

void AxisBody::set_up(const AxisUnits::Scale& scale, const AxisBounds& bounds, bool absolute,
                      const AxisNeighbours& row) noexcept {
  parts_.units = AxisUnits(scale);
  parts_.bounds = bounds;
  parts_.bounds.apply_to(parts_.motion);
  parts_.homed = absolute;
  parts_.row = row;
}

void AxisBody::set_override(double part) noexcept {
  parts_.pushing.set_override(part);
  parts_.motion.set_override(part);
  parts_.following.hold(!(part > 0));
}

void AxisBody::put(const LineState& state) noexcept {
  parts_.leave_torque();
  parts_.following.drop();
  parts_.motion.reset(state);
}

bool AxisBody::leads() const noexcept {
  return !displaced_ && !parts_.pushing.pushes() && parts_.state != AxisState::Disabled &&
         parts_.state != AxisState::ErrorStop && parts_.state != AxisState::Homing;
}

void AxisBody::measure(const DriveIn& in, double seconds) noexcept {
  const double before = parts_.measured.position;
  parts_.measured.position = parts_.units.position(in.position);
  parts_.measured.speed = sensed_ ? (parts_.measured.position - before) / seconds : 0;
  sensed_ = true;
  displaced_ = parts_.state == AxisState::Homing;
}

}  // namespace indurop::robot
