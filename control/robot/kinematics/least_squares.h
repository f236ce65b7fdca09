// SPDX-License-Identifier: Apache-2.0
// Least squares for places and orientations (Gauss-Newton). An orientation changes by a rotation vector in its own
// axes, so it stays one. Not real-time safe; may be used by any thread.

#pragma once

#include <Eigen/Core>
#include <functional>
#include <vector>

#include "control/robot/kinematics/geometry.h"

namespace indurop::robot {

struct Unknowns {
  std::vector<Vec3> places;  // m
  std::vector<Quat> turns;

  // Three of each place, then three of each orientation.
  [[nodiscard]] Eigen::Index count() const;
  [[nodiscard]] Unknowns moved(const Eigen::VectorXd& by) const;
};

using Deviations = std::function<Eigen::VectorXd(const Unknowns&)>;

struct LeastSquares {
  Unknowns found;
  Eigen::VectorXd rest;      // deviations that remain
  Eigen::MatrixXd cofactor;  // covariance of the unknowns if each deviation has a variance of 1
  bool settled = false;      // false: it has not converged, or the deviations do not determine all unknowns
};
// Begins at `start`, which has to be near. Derivatives are differences.
LeastSquares least_squares(const Unknowns& start, const Deviations& deviations);

}  // namespace indurop::robot
