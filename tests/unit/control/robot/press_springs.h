// SPDX-License-Identifier: Apache-2.0
// Surfaces that push back as springs do, each along its own direction, and where they are in equilibrium with given
// forces: the solution of a linear system.

#pragma once

#include <algorithm>
#include <utility>
#include <vector>

#include "control/robot/kinematics/geometry.h"

namespace indurop::robot {

// mm and N. They push only where the tool is inside of them.
class Springs {
 public:
  // Begins `away` mm from the origin; `into`: the direction into the surface.
  void add(double stiffness, const Vec3& into, double away) { all_.push_back({stiffness, into.normalized(), away}); }
  // The force of a tool at `shift` on the surfaces.
  [[nodiscard]] Vec3 force(const Vec3& shift) const {
    Vec3 sum = Vec3::Zero();
    for (const Spring& each : all_) {
      sum += each.stiffness * std::max(0.0, each.into.dot(shift) - each.away) * each.into;
    }
    return sum;
  }
  [[nodiscard]] Mat3 stiffness() const {
    Mat3 sum = Mat3::Zero();
    for (const Spring& each : all_) {
      sum += each.stiffness * each.into * each.into.transpose();
    }
    return sum;
  }
  // Where a tool has to be that presses with `force`, if it touches all of them. Along an axis without a spring: 0.
  [[nodiscard]] Vec3 equilibrium(const Vec3& force) const {
    Vec3 right = force;
    for (const Spring& each : all_) {
      right += each.stiffness * each.away * each.into;
    }
    const Eigen::JacobiSVD<Mat3> system(stiffness(), Eigen::ComputeFullU | Eigen::ComputeFullV);
    return system.solve(right);
  }
  // N/mm, the stiffest and the softest direction of `directions` axes.
  [[nodiscard]] std::pair<double, double> range(int directions) const {
    const Mat3 all = stiffness();
    const Eigen::JacobiSVD<Eigen::MatrixXd> values(all.topLeftCorner(directions, directions));
    return {values.singularValues().maxCoeff(), values.singularValues().minCoeff()};
  }

 private:
  struct Spring {
    double stiffness;
    Vec3 into;
    double away;
  };
  std::vector<Spring> all_;
};

}  // namespace indurop::robot
