// SPDX-License-Identifier: Apache-2.0
#include "control/robot/kinematics/least_squares.h"

#include <Eigen/SVD>

namespace indurop::robot {

namespace {

constexpr double kDifference = 1e-6;  // m and rad, of derivatives
constexpr double kNoChange = 1e-11;   // m and rad, of a change that is none
constexpr double kHardlyAny = 1e-9;   // the same, if rounding prevents smaller ones
constexpr int kMostRounds = 60;
constexpr double kLeastWidthRatio = 1e-9;  // smallest singular value, of the largest one

Eigen::MatrixXd derivatives(const Unknowns& at, const Deviations& deviations, Eigen::Index rows) {
  Eigen::MatrixXd out(rows, at.count());
  for (Eigen::Index i = 0; i < at.count(); ++i) {
    const Eigen::VectorXd step = kDifference * Eigen::VectorXd::Unit(at.count(), i);
    out.col(i) = (deviations(at.moved(step)) - deviations(at.moved(-step))) / (2 * kDifference);
  }
  return out;
}

}  // namespace

Eigen::Index Unknowns::count() const {
  return 3 * static_cast<Eigen::Index>(places.size() + turns.size());
}

Unknowns Unknowns::moved(const Eigen::VectorXd& by) const {
  Unknowns out = *this;
  Eigen::Index at = 0;
  for (Vec3& place : out.places) {
    place += by.segment<3>(at);
    at += 3;
  }
  for (Quat& turn : out.turns) {
    turn = (turn * rotation_by(by.segment<3>(at))).normalized();
    at += 3;
  }
  return out;
}

LeastSquares least_squares(const Unknowns& start, const Deviations& deviations) {
  LeastSquares out{start, deviations(start), {}, false};
  if (out.rest.size() < start.count()) {
    return out;
  }
  double change = 1;
  for (int round = 0; round < kMostRounds && change > kNoChange; ++round) {
    const Eigen::JacobiSVD<Eigen::MatrixXd> svd(derivatives(out.found, deviations, out.rest.size()),
                                                Eigen::ComputeThinU | Eigen::ComputeThinV);
    const Eigen::VectorXd& widths = svd.singularValues();
    if (!(widths[widths.size() - 1] > kLeastWidthRatio * widths[0])) {
      return out;
    }
    const Eigen::VectorXd by = svd.solve(-out.rest);
    change = by.norm();
    out.found = out.found.moved(by);
    out.rest = deviations(out.found);
    const Eigen::MatrixXd scaled = svd.matrixV() * widths.cwiseInverse().asDiagonal();
    out.cofactor = scaled * scaled.transpose();
  }
  out.settled = change < kHardlyAny;
  return out;
}

}  // namespace indurop::robot
