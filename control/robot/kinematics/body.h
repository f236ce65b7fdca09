// SPDX-License-Identifier: Apache-2.0
// Rigid bodies: mass, centre of mass and inertia.

#pragma once

#include <string>

#include "control/robot/kinematics/geometry.h"

namespace indurop::robot {

// A rigid body in some frame.
struct Body {
  double mass = 0;  // kg
  Vec3 centre = Vec3::Zero();
  Mat3 inertia = Mat3::Zero();  // kg m^2, about the centre
};

// Returns the body in the frame in which `frame` is given.
Body seen_from(const Pose& frame, const Body& body) noexcept;
// Returns the union of two bodies that are fixed to each other.
Body joined(const Body& a, const Body& b) noexcept;
// Returns what is wrong with the inertia and what to do; empty if a real body can have it. Not real-time safe.
std::string wrong_inertia(const Mat3& inertia);

}  // namespace indurop::robot
