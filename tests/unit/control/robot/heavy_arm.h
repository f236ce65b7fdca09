// SPDX-License-Identifier: Apache-2.0
// Random arms with masses, as URDF and as chains of orocos-kdl, which says what their torques are.

#pragma once

#include <kdl/chain.hpp>
#include <random>
#include <string>

#include "control/robot/kinematics/dynamics.h"

namespace indurop::robot {

struct HeavyArm {
  std::string urdf;
  KDL::Chain chain;  // of all that moves; the last segment is tool0
  int count = 0;
};

struct HeavySetup {
  int axes = 6;
  bool sliding = false;  // some of them may slide
  double effort = 0;     // of each axis
};

HeavyArm heavy_arm(std::mt19937& random, const HeavySetup& setup);
// The arm of the cell with masses, and these efforts of its six axes.
HeavyArm heavy_cell_arm(const Joints& effort);

Body random_body(std::mt19937& random, double most);
KDL::RigidBodyInertia kdl_of(const Body& body);
// By its solver, with what is held at tool0.
Joints kdl_torques(const HeavyArm& arm, const Body& held, const Joints& q, const Joints& velocity,
                   const Joints& acceleration);

}  // namespace indurop::robot
