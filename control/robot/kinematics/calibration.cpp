// SPDX-License-Identifier: Apache-2.0
#include "control/robot/kinematics/calibration.h"

#include <Eigen/SVD>
#include <algorithm>
#include <cmath>

#include "control/robot/kinematics/fit_words.h"
#include "control/robot/kinematics/frame_fit.h"
#include "control/robot/kinematics/least_squares.h"
#include "control/robot/kinematics/tip_fit.h"

namespace indurop::robot {

namespace {

constexpr double kLeastSpan = 0.01;  // m, between points that show a direction, and to the line of the others
constexpr std::size_t kLeastPoints = 4;

using Rows = std::vector<double>;  // the coordinates of a point that should be 0

const Measured* first_of(std::span<const Measured> points, Mark mark) {
  const auto found =
      std::find_if(points.begin(), points.end(), [mark](const Measured& one) { return one.mark == mark; });
  return found == points.end() ? nullptr : &*found;
}

// A rotation with this x axis, and z in the half plane of `side`.
Quat by_x_and_z(const Vec3& x, const Vec3& side) {
  Mat3 axes;
  axes.col(0) = x.normalized();
  axes.col(1) = side.cross(x).normalized();
  axes.col(2) = axes.col(0).cross(axes.col(1));
  return Quat(axes);
}

// Solves for all unknowns at once, and says what remains. `rows` returns the deviations of one point.
template <class RowsOf>
LeastSquares solve(Calibrated& out, std::span<const Measured> points, const Unknowns& start, RowsOf rows) {
  std::vector<std::size_t> lengths;
  for (const Measured& point : points) {
    lengths.push_back(rows(start, point).size());
  }
  const LeastSquares fit = least_squares(start, [&](const Unknowns& at) {
    Rows all;
    for (const Measured& point : points) {
      const Rows some = rows(at, point);
      all.insert(all.end(), some.begin(), some.end());
    }
    return Eigen::VectorXd(Eigen::Map<const Eigen::VectorXd>(all.data(), static_cast<Eigen::Index>(all.size())));
  });
  if (!fit.settled) {
    out.wrong = "its points contradict each other, or do not determine it; check them, and take others";
    return fit;
  }
  out.spare = static_cast<int>(fit.rest.size() - start.count());
  out.sigma = out.spare > 0 ? fit.rest.norm() / std::sqrt(static_cast<double>(out.spare)) : 0;
  Eigen::Index at = 0;
  for (const std::size_t length : lengths) {
    out.off.push_back(fit.rest.segment(at, static_cast<Eigen::Index>(length)).norm());
    at += static_cast<Eigen::Index>(length);
  }
  for (std::size_t i = 0; i < out.off.size(); ++i) {
    out.rms += out.off[i] * out.off[i] / static_cast<double>(out.off.size());
    if (out.off[i] > out.most) {
      out.most = out.off[i];
      out.worst = i;
    }
  }
  out.rms = std::sqrt(out.rms);
  return fit;
}

// The covariance of the first place and, if there is one, of the first orientation.
Covariance cofactor_of(const LeastSquares& fit) {
  Covariance out = Covariance::Zero();
  out.topLeftCorner<3, 3>() = fit.cofactor.topLeftCorner<3, 3>();
  if (!fit.found.turns.empty()) {
    const auto turn = static_cast<Eigen::Index>(3 * fit.found.places.size());
    out.bottomRightCorner<3, 3>() = fit.cofactor.block<3, 3>(turn, turn);
    out.topRightCorner<3, 3>() = fit.cofactor.block<3, 3>(0, turn);
    out.bottomLeftCorner<3, 3>() = fit.cofactor.block<3, 3>(turn, 0);
  }
  return out;
}

// The first place and, if there is one, the first orientation are the result.
void conclude(Calibrated& out, const LeastSquares& fit, double most_error) {
  out.result = {fit.found.places[0], fit.found.turns.empty() ? Quat::Identity() : fit.found.turns[0]};
  if (out.wrong.empty()) {
    out.cofactor = cofactor_of(fit);
    out.wrong = too_far(out.most, out.worst, most_error);
  }
}

void append(Rows& rows, const Vec3& deviation) {
  rows.insert(rows.end(), deviation.data(), deviation.data() + 3);
}

std::vector<Pose> ends_of(std::span<const Measured> points, Mark mark) {
  std::vector<Pose> ends;
  for (const Measured& one : points) {
    if (one.mark == mark) {
      ends.push_back(one.at);
    }
  }
  return ends;
}

Vec3 touched_place(std::span<const Pose> ends, const Vec3& tip) {
  Vec3 place = Vec3::Zero();
  for (const Pose& end : ends) {
    place += (end.position + end.orientation * tip) / static_cast<double>(ends.size());
  }
  return place;
}

// Unknown are the tip and the touched place, and the orientation if there are points that show it.
Unknowns start_of_tool(Calibrated& out, std::span<const Measured> points, const TipFit& tip, const Vec3& place) {
  Unknowns start{{tip.tip, place}, {}};
  const Measured* const along = first_of(points, Mark::AlongX);
  const Measured* const plane = first_of(points, Mark::PlaneXZ);
  out.turned = along != nullptr && plane != nullptr;
  if (!out.turned) {
    out.wrong = along == nullptr && plane == nullptr
                    ? std::string()
                    : "its orientation needs a point with the tip on +x and one with it "
                      "in the plane of +x and +z; take the missing one, or drop the "
                      "other one to calibrate the tip only";
    return start;
  }
  const auto from_tip = [&](const Measured& one) -> Vec3 {
    return one.at.orientation.conjugate() * (place - one.at.position) - tip.tip;
  };
  const Vec3 x = from_tip(*along);
  const Vec3 side = from_tip(*plane);
  if (x.norm() < kLeastSpan || x.cross(side).norm() / x.norm() < kLeastSpan) {
    out.wrong = x.norm() < kLeastSpan
                    ? "the point on +x is less than 10 mm from the tip; move the tool farther along its x axis, 100 mm"
                    : "the point in the plane of +x and +z is less than 10 mm from the x axis; move the tool farther "
                      "along its z axis, 100 mm";
    return start;
  }
  start.turns.push_back(by_x_and_z(x, side));
  return start;
}

}  // namespace

Vec3 Calibrated::place_deviation() const {
  return sigma * cofactor.diagonal().head<3>().cwiseSqrt();
}

Vec3 Calibrated::turn_deviation() const {
  return sigma * cofactor.diagonal().tail<3>().cwiseSqrt();
}

Calibrated calibrate_tool(std::span<const Measured> points) {
  Calibrated out;
  const std::vector<Pose> ends = ends_of(points, Mark::Tip);
  if (ends.size() < kLeastPoints) {
    out.wrong = too_few("a tool", "points that touch the fixed tip", kLeastPoints, ends.size());
    return out;
  }
  if (out.wrong = too_alike(ends, kLeastPoints); !out.wrong.empty()) {
    return out;
  }
  const TipFit tip = fit_tip(ends);
  if (!tip.wrong.empty() && tip.most_error == 0) {
    out.wrong = tip.wrong;
    return out;
  }
  const Unknowns start = start_of_tool(out, points, tip, touched_place(ends, tip.tip));
  if (!out.wrong.empty()) {
    return out;
  }
  const LeastSquares fit = solve(out, points, start, [](const Unknowns& at, const Measured& one) {
    Rows rows;
    if (one.mark == Mark::Tip) {
      append(rows, one.at.position + one.at.orientation * at.places[0] - at.places[1]);
      return rows;
    }
    const Vec3 place = at.turns.front().conjugate() *
                       (one.at.orientation.conjugate() * (at.places[1] - one.at.position) - at.places[0]);
    rows.push_back(place.y());
    if (one.mark == Mark::AlongX) {
      rows.push_back(place.z());
    }
    return rows;
  });
  conclude(out, fit, kMostTipError);
  return out;
}

Calibrated calibrate_frame(std::span<const Measured> points) {
  Calibrated out;
  const Measured* const origin = first_of(points, Mark::Origin);
  const Measured* const along = first_of(points, Mark::OnX);
  const Measured* const plane = first_of(points, Mark::PlaneXY);
  if (origin == nullptr || along == nullptr || plane == nullptr) {
    out.wrong = std::string("a frame needs its origin, a point on x and one in the plane of x and y; there is none ") +
                (origin == nullptr  ? "of its origin"
                 : along == nullptr ? "on x"
                                    : "in the plane");
    return out;
  }
  const Vec3 x = along->at.position - origin->at.position;
  const Vec3 y = plane->at.position - origin->at.position;
  if (x.norm() < kLeastSpan || x.cross(y).norm() / x.norm() < kLeastSpan) {
    out.wrong = x.norm() < kLeastSpan
                    ? "the point on x is less than 10 mm from the origin; touch one as far away as possible"
                    : "the point in the plane is less than 10 mm from the x axis, so the three lie on one line; touch "
                      "one far from that line, on the side of y";
    return out;
  }
  const Unknowns start{{origin->at.position}, {by_x_and_z(x, x.cross(y))}};
  const LeastSquares fit = solve(out, points, start, [](const Unknowns& at, const Measured& one) {
    const Vec3 place = at.turns[0].conjugate() * (one.at.position - at.places[0]);
    Rows rows{place.z()};
    if (one.mark != Mark::PlaneXY) {
      rows.push_back(place.y());
    }
    if (one.mark == Mark::Origin) {
      rows.push_back(place.x());
    }
    return rows;
  });
  conclude(out, fit, kMostFrameError);
  return out;
}

namespace {

// Distances touched by distances seen, from the middles of both.
double scale_of(std::span<const MatchedPlace> places) {
  Vec3 seen = Vec3::Zero();
  Vec3 touched = Vec3::Zero();
  for (const MatchedPlace& one : places) {
    seen += one.in_frame / static_cast<double>(places.size());
    touched += one.in_base / static_cast<double>(places.size());
  }
  double seen_span = 0;
  double touched_span = 0;
  for (const MatchedPlace& one : places) {
    seen_span += (one.in_frame - seen).squaredNorm();
    touched_span += (one.in_base - touched).squaredNorm();
  }
  return std::sqrt(touched_span / seen_span);
}

// The rotation with the least squares of a_i - R b_i.
Quat turn_between(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
  Mat3 joint = Mat3::Zero();
  for (std::size_t i = 0; i < a.size(); ++i) {
    joint += a[i] * b[i].transpose();
  }
  const Eigen::JacobiSVD<Mat3> svd(joint, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Vec3 signs = Vec3::Ones();
  signs[2] = (svd.matrixU() * svd.matrixV().transpose()).determinant() < 0 ? -1 : 1;
  return Quat(Mat3(svd.matrixU() * signs.asDiagonal() * svd.matrixV().transpose()));
}

// Park and Martin: rotations of the arm's end and of what the camera sees are the same about other axes.
Pose start_of_camera(std::span<const Measured> points) {
  std::vector<Vec3> of_arm;
  std::vector<Vec3> of_camera;
  std::vector<std::pair<Pose, Pose>> moves;
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) {
      const Pose arm = inverse_of(points[i].at) * points[k].at;
      const Pose camera = points[i].seen * inverse_of(points[k].seen);
      of_arm.push_back(rotation_between(Quat::Identity(), arm.orientation));
      of_camera.push_back(rotation_between(Quat::Identity(), camera.orientation));
      moves.emplace_back(arm, camera);
    }
  }
  const Quat turn = turn_between(of_arm, of_camera);
  const auto count = static_cast<Eigen::Index>(moves.size());
  Eigen::MatrixXd turns(3 * count, 3);
  Eigen::VectorXd places(3 * count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const auto& [arm, camera] = moves[static_cast<std::size_t>(i)];
    turns.middleRows<3>(3 * i) = arm.orientation.toRotationMatrix() - Mat3::Identity();
    places.segment<3>(3 * i) = turn * camera.position - arm.position;
  }
  return {turns.jacobiSvd(Eigen::ComputeThinU | Eigen::ComputeThinV).solve(places), turn};
}

}  // namespace

Calibrated calibrate_camera(std::span<const Measured> points) {
  Calibrated out;
  if (points.size() < kLeastPoints) {
    out.wrong = too_few("a camera", "pairs of what it saw and what was touched", kLeastPoints, points.size());
    return out;
  }
  std::vector<MatchedPlace> places;
  for (const Measured& one : points) {
    places.push_back({one.seen.position, one.at.position});
  }
  const FrameFit first = fit_frame(places);
  if (!first.wrong.empty() && first.most_error == 0) {
    out.wrong = first.wrong;
    return out;
  }
  out.scale = scale_of(places);
  const Unknowns start{{first.frame.position}, {first.frame.orientation}};
  const LeastSquares fit = solve(out, points, start, [](const Unknowns& at, const Measured& one) {
    Rows rows;
    append(rows, at.places[0] + at.turns[0] * one.seen.position - one.at.position);
    return rows;
  });
  conclude(out, fit, kMostCameraError);
  return out;
}

Calibrated calibrate_hand_camera(std::span<const Measured> points) {
  Calibrated out;
  if (points.size() < kLeastPoints) {
    out.wrong =
        too_few("a camera on the arm", "positions from which it saw the same thing", kLeastPoints, points.size());
    return out;
  }
  const std::vector<Pose> ends = ends_of(points, Mark::Seen);
  if (out.wrong = too_alike(ends, kLeastPoints); !out.wrong.empty()) {
    return out;
  }
  if (!turned_enough(ends)) {
    out.wrong =
        "its positions are turned too little, or all about one axis; look from directions that differ by 30 degrees or "
        "more, about two axes";
    return out;
  }
  const Pose camera = start_of_camera(points);
  const Pose thing = points.front().at * camera * points.front().seen;
  const Unknowns start{{camera.position, thing.position}, {camera.orientation, thing.orientation}};
  const LeastSquares fit = solve(out, points, start, [](const Unknowns& at, const Measured& one) {
    const Pose found = one.at * Pose{at.places[0], at.turns[0]} * one.seen;
    Rows rows;
    append(rows, found.position - at.places[1]);
    append(rows, kTurnArm * rotation_between(at.turns[1], found.orientation));
    return rows;
  });
  conclude(out, fit, kMostCameraError);
  return out;
}

}  // namespace indurop::robot
