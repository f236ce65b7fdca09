// SPDX-License-Identifier: Apache-2.0
// What an arm holds, and the friction of its axes, from the torques of a recorded motion. Not real-time safe.

#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include "core/base/diagnostic.h"

namespace indurop::robot {

// One axis in one period: the motion as commanded in deg, deg/s and deg/s^2 (mm if it slides), and the measured torque
// in N m (N).
struct AxisSample {
  double position = 0, velocity = 0, acceleration = 0, torque = 0;
};
// All axes in one period.
using ArmSample = std::vector<AxisSample>;

// A number, and the deviation within which it is in 19 of 20 cases if errors are random.
struct Estimate {
  double value = 0;
  double within = 0;
};

struct Identified {
  std::vector<base::Diagnostic> errors;  // of the URDF file; if there are any, nothing else is valid
  std::string problem;                   // why nothing could be identified; empty: it was
  Estimate mass;                         // kg
  std::array<Estimate, 3> centre;        // mm, in the frame of the arm's end
  struct Axis {
    Estimate dry;           // N m (N)
    Estimate damping;       // N m s/rad (N s/m)
    double rest = 0;        // N m (N), root mean square of what remains unexplained
    std::size_t count = 0;  // samples in which it moved
  };
  std::vector<Axis> axes;
  std::size_t delay = 0;  // samples from a set point to its torque
};

// Finds mass, centre and friction by weighted least squares (Newton-Euler is linear in them), together with the
// inertia, which few motions show, and with the delay of the drives. Samples are one period apart. `rotor_inertia`: as
// in Settings.
Identified identify(const std::string& urdf, const std::vector<double>& rotor_inertia,
                    std::span<const ArmSample> samples);

}  // namespace indurop::robot
