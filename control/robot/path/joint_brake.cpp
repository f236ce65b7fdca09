// SPDX-License-Identifier: Apache-2.0
#include "control/robot/path/joint_brake.h"

namespace indurop::robot {

// Continues the parabola through the last three set points.
void JointBrake::begin(const std::array<Joints, 3>& past, double period, double hardness) noexcept {
  from_ = past[0];
  acceleration_ = (past[0] - 2 * past[1] + past[2]) / (period * period);
  velocity_ = (past[0] - past[1]) / period + acceleration_ * (period / 2);
  past_.joints = past;
  past_.moved.fill(period);
  period_ = period;
  place_ = 0;
  brake_.begin(hardness);
}

Reach JointBrake::joints_ahead(double distance, const Joints& /*near*/, Joints& q) const noexcept {
  q = shape_ahead(distance).value;
  return Reach::Ok;
}

PathAhead::Shape JointBrake::shape_ahead(double distance) const noexcept {
  const double t = place_ + distance;
  return {from_ + t * (velocity_ + t / 2 * acceleration_), velocity_ + t * acceleration_, acceleration_,
          Joints::Zero()};
}

const Joints& JointBrake::next() noexcept {
  double distance = 0;
  Joints q = past_.joints[0];
  static_cast<void>(brake_.next(*this, past_, period_, distance, q));  // this path continues without end
  place_ += distance;
  past_.moved = {distance, past_.moved[0]};
  past_.joints = {q, past_.joints[0], past_.joints[1]};
  return past_.joints[0];
}

}  // namespace indurop::robot
