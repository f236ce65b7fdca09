// SPDX-License-Identifier: Apache-2.0
#include "control/robot/kinematics/tip_fit.h"

#include <Eigen/SVD>
#include <cmath>

#include "control/robot/kinematics/fit_words.h"

namespace indurop::robot {

namespace {

std::string millimetres(double metres) {
  const double rounded = std::round(metres * 1e4) / 10;
  std::string text = std::to_string(rounded);
  return text.substr(0, text.find('.') + 2) + " mm";
}

}  // namespace

// Unknown are the tip t and the place c: R_i t + p_i = c for each position i. Without c, as differences from the mean:
// (R_i - R) t = p - p_i.
TipFit fit_tip(std::span<const Pose> ends) {
  TipFit fit;
  const auto count = static_cast<Eigen::Index>(ends.size());
  if (count < 3) {
    fit.wrong = "a tip is taught by three points or more";
    return fit;
  }
  Mat3 mean_turn = Mat3::Zero();
  Vec3 mean_place = Vec3::Zero();
  for (const Pose& end : ends) {
    mean_turn += end.orientation.toRotationMatrix() / static_cast<double>(count);
    mean_place += end.position / static_cast<double>(count);
  }
  Eigen::MatrixXd turns(3 * count, 3);
  Eigen::VectorXd places(3 * count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const Pose& end = ends[static_cast<std::size_t>(i)];
    turns.middleRows<3>(3 * i) = end.orientation.toRotationMatrix() - mean_turn;
    places.segment<3>(3 * i) = mean_place - end.position;
  }
  if (!turned_enough(ends)) {
    fit.wrong =
        "its points are turned too little, or all about one axis; touch the place from directions that differ by 30 "
        "degrees or more, about two axes";
    return fit;
  }
  fit.tip = turns.jacobiSvd(Eigen::ComputeThinU | Eigen::ComputeThinV).solve(places);
  const Vec3 touched = mean_turn * fit.tip + mean_place;
  for (std::size_t i = 0; i < ends.size(); ++i) {
    const double error = (ends[i].position + ends[i].orientation * fit.tip - touched).norm();
    fit.mean_error += error / static_cast<double>(count);
    if (error > fit.most_error) {
      fit.most_error = error;
      fit.worst = i;
    }
  }
  if (fit.most_error > kMostTipError) {
    fit.wrong = "its points do not touch one place: one is " + millimetres(fit.most_error) +
                " off, 5 mm is the most; teach that one again";
  }
  return fit;
}

}  // namespace indurop::robot
