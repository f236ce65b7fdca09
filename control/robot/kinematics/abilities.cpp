// SPDX-License-Identifier: Apache-2.0
#include "control/robot/kinematics/abilities.h"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <sstream>

namespace indurop::robot {

namespace {

constexpr int kPlaces = 24;  // number of positions that are checked

template <class Matrix>
int rank_of(const Matrix& m) {
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> parts{Eigen::MatrixXd(m)};
  parts.setThreshold(1e-6);
  return static_cast<int>(parts.rank());
}

// The poses that an arm with fewer than six axes can reach.
struct Freedom {
  int moves = 0;                    // number of directions in which the tool can move
  int turns = 0;                    // number of axes about which it can turn in place
  Eigen::MatrixXd moving, turning;  // all directions that occur, in the base's frame
};

Freedom freedom_of(const Arm& arm) {
  Freedom all{0, 0, Eigen::MatrixXd::Zero(3, 0), Eigen::MatrixXd::Zero(3, 0)};
  const auto append = [](Eigen::MatrixXd& to, const Eigen::MatrixXd& more) {
    to.conservativeResize(Eigen::NoChange, to.cols() + more.cols());
    to.rightCols(more.cols()) = more;
  };
  for (int i = 1; i <= kPlaces; ++i) {
    const Jacobian j = arm.jacobian(arm.spread(i));
    const int moves = rank_of(j.topRows<3>());
    all.moves = std::max(all.moves, moves);
    all.turns = std::max(all.turns, rank_of(j) - moves);
    append(all.moving, j.topRows<3>());
    append(all.turning, j.bottomRows<3>());
  }
  return all;
}

// Returns a text such as "(0 0 1)", irrespective of the sign of the direction.
std::string shown(Vec3 v) {
  Eigen::Index longest = 0;
  v.cwiseAbs().maxCoeff(&longest);
  v /= v[longest];
  std::ostringstream text;
  text.precision(3);
  for (int i = 0; i < 3; ++i) {
    text << (i == 0 ? "(" : " ") << (std::abs(v[i]) < 1e-6 ? 0 : v[i]);
  }
  return text.str() + ")";
}

std::string poses_of(const Arm& arm) {
  if (arm.count() >= 6) {
    return arm.world_joint() > 0 ? "any pose in its reach, in the workpiece's frame" : "any pose in its reach";
  }
  const Freedom all = freedom_of(arm);
  std::string text = rank_of(all.moving) == 3 && all.moves == 3 ? "x y z" : std::to_string(all.moves) + " of x y z";
  const int directions = rank_of(all.turning);
  if (directions == 0) {
    return text + ", the tool does not turn";
  }
  if (all.turns == 0) {
    return text + ", how the tool is turned follows";
  }
  if (directions == 1) {
    Eigen::Index longest = 0;
    all.turning.colwise().norm().maxCoeff(&longest);
    return text + " and turns about " + shown(all.turning.col(longest)) + " of the base";
  }
  return text + " and " + std::to_string(all.turns) + (all.turns == 1 ? " turn" : " turns") +
         ", the rest of the orientation follows";
}

std::string left_open(const Arm& arm) {
  const Held held = redundant_axes(arm);
  std::string text;
  for (int i = 0; i < arm.count(); ++i) {
    if (arm.moves_workpiece(i)) {
      text += "; axis " + std::to_string(i + 1) + " (" + arm.axis(i).name + ") moves the workpiece: AXIS " +
              std::to_string(i + 1) + " says where it stands";
    } else if (holds(held, i)) {
      text += "; a pose leaves axis " + std::to_string(i + 1) + " (" + arm.axis(i).name + ") open: AXIS " +
              std::to_string(i + 1) + " says where it stands";
    }
  }
  return text;
}

}  // namespace

std::string abilities(const Arm& arm, const Inverse& inverse) {
  return std::to_string(arm.count()) + (arm.count() == 1 ? " axis, " : " axes, ") + inverse.kind() +
         "; poses: " + poses_of(arm) + left_open(arm) +
         (inverse.has_postures() ? "; postures: shoulder, elbow, wrist" : "; no postures");
}

}  // namespace indurop::robot
