// SPDX-License-Identifier: Apache-2.0
#include "control/robot/kinematics/body.h"

#include <Eigen/Eigenvalues>
#include <sstream>

namespace indurop::robot {

namespace {

// Returns the inertia of a point mass at distance `away` from the reference point.
Mat3 of_point(double mass, const Vec3& away) noexcept {
  return mass * (away.squaredNorm() * Mat3::Identity() - away * away.transpose());
}

}  // namespace

Body seen_from(const Pose& frame, const Body& body) noexcept {
  const Mat3 turn = frame.orientation.toRotationMatrix();
  return {body.mass, frame.position + turn * body.centre, turn * body.inertia * turn.transpose()};
}

Body joined(const Body& a, const Body& b) noexcept {
  const double mass = a.mass + b.mass;
  if (!(mass > 0)) {
    return {};
  }
  const Vec3 centre = (a.mass * a.centre + b.mass * b.centre) / mass;
  return {mass, centre,
          a.inertia + b.inertia + of_point(a.mass, a.centre - centre) + of_point(b.mass, b.centre - centre)};
}

std::string wrong_inertia(const Mat3& inertia) {
  constexpr double kRounded = 1e-3;  // rounding of files
  if (!inertia.allFinite()) {
    return "an inertia is no number";
  }
  const Vec3 principal = Eigen::SelfAdjointEigenSolver<Mat3>(inertia).eigenvalues();
  std::ostringstream text;
  text << principal[0] << ", " << principal[1] << " and " << principal[2] << " kg m^2";
  if (!(principal[0] > 0)) {
    return "no body has this inertia, about its principal axes it is " + text.str() +
           ", and all three have to be above 0; is there a sign or a number missing?";
  }
  if (principal[2] > (principal[0] + principal[1]) * (1 + kRounded)) {
    return "no body has this inertia, about its principal axes it is " + text.str() +
           ", and none can be more than the two others together; it counts about the centre of mass, in kg m^2";
  }
  return "";
}

}  // namespace indurop::robot
