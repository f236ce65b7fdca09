// SPDX-License-Identifier: Apache-2.0
// Acceleration of axes by torques of drives and by pushes: the inertia matrix is computed column by column and solved
// for the acceleration.
#include <indurop/robot/arm_physics.h>

#include <Eigen/Cholesky>
#include <algorithm>

#include "control/robot/files/urdf.h"
#include "control/robot/kinematics/dynamics.h"
#include "core/base/read_file.h"

namespace indurop::robot {

namespace {

class Physics final : public ArmPhysics {
 public:
  Physics(const Arm& arm, const Dynamics& dynamics) noexcept : arm_(arm), count_(arm.count()), dynamics_(dynamics) {}

  [[nodiscard]] std::size_t axis_count() const noexcept override { return static_cast<std::size_t>(count_); }

  void hold(double mass, double x, double y, double z, double radius) noexcept override {
    constexpr double kBall = 0.4;
    dynamics_.hold({mass, Vec3(x, y, z), kBall * mass * radius * radius * Mat3::Identity()});
  }

  void push_end(std::span<const AxisPhysics> axes, const std::array<double, 6>& wrench,
                std::span<double> torques) const noexcept override {
    Joints q = Joints::Zero();
    for (int i = 0; i < count_; ++i) {
      q[i] = axes[static_cast<std::size_t>(i)].position;
    }
    const Joints pushed = arm_.jacobian(q).transpose() * Eigen::Map<const Twist>(wrench.data());
    std::copy_n(pushed.data(), count_, torques.begin());
  }

  void step(std::span<const AxisPhysics> axes, double period, std::span<double> loads) noexcept override {
    Joints q = Joints::Zero();
    Joints torque = Joints::Zero();
    Joints push = Joints::Zero();
    Joints rotors = Joints::Zero();
    for (int i = 0; i < count_; ++i) {
      const AxisPhysics& axis = axes[static_cast<std::size_t>(i)];
      q[i] = axis.position;
      torque[i] = axis.torque;
      push[i] = axis.push;
      rotors[i] = axis.rotor;
    }
    dynamics_.turn_rotors(rotors);
    const Joints velocity = known_ ? Joints((q - last_) / period) : Joints::Zero();
    last_ = q;
    known_ = true;
    const Joints accelerated = acceleration(q, velocity, torque + push);
    for (int i = 0; i < count_; ++i) {
      const auto k = static_cast<std::size_t>(i);
      loads[k] = torque[i] - axes[k].inertia * accelerated[i];
    }
  }

 private:
  // The torques for a unit acceleration of one axis alone are its column of the inertia matrix.
  [[nodiscard]] Joints acceleration(const Joints& q, const Joints& velocity, const Joints& torque) const noexcept {
    using Matrix = Eigen::Matrix<double, kAxes, kAxes>;
    Matrix inertia = Matrix::Identity();
    for (int i = 0; i < count_; ++i) {
      inertia.col(i).head(count_) = dynamics_.inertial(q, Joints::Unit(i)).head(count_);
    }
    Joints rest = torque - dynamics_.torques(q, velocity, Joints::Zero()) - dynamics_.friction(velocity);
    rest.tail(kAxes - count_).setZero();
    return Eigen::LDLT<Matrix>(inertia).solve(rest);
  }

  Arm arm_;
  int count_;
  Dynamics dynamics_;
  Joints last_ = Joints::Zero();
  bool known_ = false;
};

}  // namespace

std::unique_ptr<ArmPhysics> ArmPhysics::load(const std::string& urdf, std::vector<std::string>& errors) {
  const auto text = base::read_file(urdf);
  if (!text) {
    errors.push_back(urdf + ": error: " + base::cannot_read(urdf, text.error()));
    return nullptr;
  }
  const auto model = arm_from_urdf(urdf, *text);
  if (!model) {
    for (const base::Diagnostic& one : model.error()) {
      errors.push_back(base::to_string(one));
    }
    return nullptr;
  }
  if (!model->dynamics.known()) {
    errors.push_back(urdf + ": error: the links have no masses; give them <inertial>");
    return nullptr;
  }
  return std::make_unique<Physics>(model->arm.in_world(), model->dynamics);
}

}  // namespace indurop::robot
