// SPDX-License-Identifier: Apache-2.0
#include "control/robot/kinematics/dexterity.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "control/robot/kinematics/held_axes.h"

namespace indurop::robot {

double slowest_direction(const Arm& arm, const Joints& q, double lever) noexcept {
  Jacobian rates = arm.jacobian(q);
  rates.bottomRows<3>() *= lever;
  const Held held = redundant_axes(arm);
  for (int i = 0; i < kAxes; ++i) {
    if (i >= arm.count() || holds(held, i)) {
      rates.col(i).setZero();
    }
  }
  // Squares of the singular values.
  const Eigen::Matrix<double, 6, 6> squares = rates * rates.transpose();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, 6, 6>> solver(squares, Eigen::EigenvaluesOnly);
  return std::sqrt(std::max(0.0, solver.eigenvalues()[0]));
}

}  // namespace indurop::robot
