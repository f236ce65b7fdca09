// SPDX-License-Identifier: Apache-2.0
// The arm behind simulated drives: how its axes move each other, what gravity does, and what pushes from outside. A
// module of a simulation steps it beside the drive simulators of libiodispat, each of which moves one axis by itself,
// and gives them its answer as `load`.

#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

namespace indurop::robot {

// What is known of an axis at the end of a period. Of sliding axes: m, N, kg.
struct AxisPhysics {
  double position = 0;  // rad
  double torque = 0;    // of its drive, mean of the period, N m
  double push = 0;      // from outside, N m
  double inertia = 1;   // that its drive simulator has, kg m2; above 0
  double rotor = 0;     // what the motor's rotor adds to the arm's own, gear included, kg m2
};

class ArmPhysics {
 public:
  // The arm of a URDF file whose links have <inertial>. Null, and what is wrong is in `errors`, if there is none.
  static std::unique_ptr<ArmPhysics> load(const std::string& urdf, std::vector<std::string>& errors);
  ArmPhysics() = default;
  ArmPhysics(const ArmPhysics&) = delete;
  ArmPhysics& operator=(const ArmPhysics&) = delete;
  virtual ~ArmPhysics() = default;

  [[nodiscard]] virtual std::size_t axis_count() const noexcept = 0;
  // What the arm holds from now on, seen from its end: kg, m, and the inertia of a ball of that radius (m). 0 kg:
  // nothing.
  virtual void hold(double mass, double x, double y, double z, double radius) noexcept = 0;
  // A period (s) is over: what each drive is to carry in the next one, so that its axis accelerates as that of the arm
  // does. Both spans have axis_count() elements. Real-time safe.
  virtual void step(std::span<const AxisPhysics> axes, double period, std::span<double> loads) noexcept = 0;
};

}  // namespace indurop::robot
