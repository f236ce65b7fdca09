// SPDX-License-Identifier: Apache-2.0
#include "control/robot/kinematics/fit_words.h"

#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <vector>

namespace indurop::robot {

namespace {

// Minimum of the smallest of the three singular values of the differences between orientations: below it, an error of
// one mm at the place would be one of 12 mm at the tip. Three points that differ by 30 degrees about two axes have 0.1.
constexpr double kLeastTurned = 0.08;
constexpr double kOtherwise = 5 * kPi / 180;  // rad, between positions that count as different

}  // namespace

std::string too_few(const char* what, const char* points, std::size_t least, std::size_t count) {
  return std::string(what) + " needs " + std::to_string(least) + " " + points + ", or more; there " +
         (count == 1 ? "is 1" : "are " + std::to_string(count));
}

std::string too_alike(std::span<const Pose> ends, std::size_t least) {
  std::vector<Quat> different;
  for (const Pose& end : ends) {
    const bool same = std::any_of(different.begin(), different.end(), [&](const Quat& one) {
      return rotation_between(one, end.orientation).norm() < kOtherwise;
    });
    if (!same) {
      different.push_back(end.orientation);
    }
  }
  return different.size() >= least ? std::string()
                                   : "only " + std::to_string(different.size()) +
                                         " of its points are turned by 5 degrees or more "
                                         "from all others, " +
                                         std::to_string(least) +
                                         " are needed; turn the arm's end otherwise for each point, "
                                         "by 30 degrees or more";
}

std::string too_far(double most, std::size_t worst, double allowed) {
  if (!(most > allowed)) {
    return {};
  }
  const double rounded = std::round(most * 1e4) / 10;
  std::string text = std::to_string(rounded);
  text = text.substr(0, text.find('.') + 2);
  return "its points do not agree: point " + std::to_string(worst + 1) + " is " + text + " mm off, " +
         std::to_string(std::lround(1000 * allowed)) + " mm is the most; drop it and take it again";
}

bool turned_enough(std::span<const Pose> ends) {
  const auto count = static_cast<Eigen::Index>(ends.size());
  Mat3 mean = Mat3::Zero();
  for (const Pose& end : ends) {
    mean += end.orientation.toRotationMatrix() / static_cast<double>(count);
  }
  Eigen::MatrixXd turns(3 * count, 3);
  for (Eigen::Index i = 0; i < count; ++i) {
    turns.middleRows<3>(3 * i) = ends[static_cast<std::size_t>(i)].orientation.toRotationMatrix() - mean;
  }
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(turns);
  return svd.singularValues()[2] / std::sqrt(static_cast<double>(count)) > kLeastTurned;
}

}  // namespace indurop::robot
