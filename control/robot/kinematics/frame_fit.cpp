// SPDX-License-Identifier: Apache-2.0
#include "control/robot/kinematics/frame_fit.h"

#include <Eigen/SVD>
#include <algorithm>
#include <sstream>

#include "control/robot/kinematics/fit_words.h"

namespace indurop::robot {

namespace {

constexpr double kLeastWidth = 0.005;  // m, mean distance of the places from a line

std::string shown_mm(double metres) {
  std::ostringstream text;
  text.precision(1);
  text << std::fixed << 1000 * metres << " mm";
  return text.str();
}

}  // namespace

FrameFit fit_frame(std::span<const MatchedPlace> places) {
  FrameFit fit;
  const auto count = static_cast<double>(places.size());
  Vec3 frame_middle = Vec3::Zero();
  Vec3 base_middle = Vec3::Zero();
  for (const MatchedPlace& each : places) {
    frame_middle += each.in_frame / count;
    base_middle += each.in_base / count;
  }
  Mat3 joint = Mat3::Zero();
  Mat3 spread = Mat3::Zero();
  for (const MatchedPlace& each : places) {
    const Vec3 from = each.in_frame - frame_middle;
    joint += (each.in_base - base_middle) * from.transpose();
    spread += from * from.transpose();
  }
  const Vec3 widths = Eigen::JacobiSVD<Mat3>(spread / std::max(1.0, count)).singularValues().cwiseSqrt();
  if (places.size() < 3 || widths[1] < kLeastWidth) {
    fit.wrong = "its places lie on one line, or nearly; take three or more that span a triangle";
    return fit;
  }
  const Eigen::JacobiSVD<Mat3> svd(joint, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Vec3 signs = Vec3::Ones();
  signs[2] = (svd.matrixU() * svd.matrixV().transpose()).determinant() < 0 ? -1 : 1;
  const Mat3 turn = svd.matrixU() * signs.asDiagonal() * svd.matrixV().transpose();
  fit.frame = {base_middle - turn * frame_middle, Quat(turn)};
  for (std::size_t i = 0; i < places.size(); ++i) {
    const double error = (turn * (places[i].in_frame - frame_middle) + base_middle - places[i].in_base).norm();
    fit.mean_error += error / count;
    if (error > fit.most_error) {
      fit.most_error = error;
      fit.worst = i;
    }
  }
  if (fit.most_error > kMostCameraError) {
    fit.wrong = "its places do not match: one is " + shown_mm(fit.most_error) + " off, " + shown_mm(kMostCameraError) +
                " is the most; touch that one again, and check what the camera says";
  }
  return fit;
}

}  // namespace indurop::robot
