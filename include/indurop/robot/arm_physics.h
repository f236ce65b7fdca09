// SPDX-License-Identifier: Apache-2.0
// Dynamics of the arm with simulated drives: coupling between the axes, gravity, and external forces. A module of a
// simulation steps it together with the drive simulators of libiodispat, each of which moves a single axis, and passes
// them its result as `load`.

#pragma once

#include <array>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace indurop::robot {

// The state of one axis at the end of a period. For sliding axes: m, N, kg.
struct AxisPhysics {
  double position = 0;  // rad
  double torque = 0;    // of its drive, mean of the period, N m
  double push = 0;      // external, N m
  double inertia = 1;   // inertia in its drive simulator, kg m2; above 0
  double rotor = 0;     // inertia that the motor's rotor adds to the arm's own, gear included, kg m2
};

class ArmPhysics {
 public:
  // Loads the arm of a URDF file whose links have <inertial>. On failure returns null, with the reasons in `errors`.
  static std::unique_ptr<ArmPhysics> load(const std::string& urdf, std::vector<std::string>& errors);
  ArmPhysics() = default;
  ArmPhysics(const ArmPhysics&) = delete;
  ArmPhysics& operator=(const ArmPhysics&) = delete;
  virtual ~ArmPhysics() = default;

  // Number of axes of the arm. What moves the workpiece has no load.
  [[nodiscard]] virtual std::size_t axis_count() const noexcept = 0;
  // Sets the payload from now on, seen from the arm's end: kg, m, and the inertia of a ball of that radius (m). 0 kg:
  // no payload.
  virtual void hold(double mass, double x, double y, double z, double radius) noexcept = 0;
  // Computes with which torques a hand that pushes the arm's end pushes its axes, as AxisPhysics::push. `wrench`: force
  // and moment along the axes of the base, N and N m. Both spans have axis_count() elements; only positions are read.
  // Real-time safe.
  virtual void push_end(std::span<const AxisPhysics> axes, const std::array<double, 6>& wrench,
                        std::span<double> torques) const noexcept = 0;
  // Ends a period (s): computes the load of each drive in the next one, so that its axis accelerates as that of the arm
  // does. Both spans have axis_count() elements. Real-time safe.
  virtual void step(std::span<const AxisPhysics> axes, double period, std::span<double> loads) noexcept = 0;
};

}  // namespace indurop::robot
