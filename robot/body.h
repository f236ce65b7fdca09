// SPDX-License-Identifier: Apache-2.0
// Rigid bodies: what they weigh and how hard they are to turn.

#pragma once

#include <string>

#include "robot/geometry.h"

namespace indurop::robot {

// A rigid body, seen from some frame.
struct Body {
  double mass = 0;  // kg
  Vec3 centre = Vec3::Zero();
  Mat3 inertia = Mat3::Zero();  // kg m^2, about the centre
};

// The same one, seen from where `frame` is seen from.
Body seen_from(const Pose& frame, const Body& body) noexcept;
// Two that are fixed to each other.
Body joined(const Body& a, const Body& b) noexcept;
// What is wrong with it, and what to do; empty if a real body has it. Not real-time safe.
std::string wrong_inertia(const Mat3& inertia);

}  // namespace indurop::robot
