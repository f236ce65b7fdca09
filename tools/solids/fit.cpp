// SPDX-License-Identifier: Apache-2.0
#include "tools/solids/fit.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "tools/solids/beyond.h"
#include "tools/solids/planar.h"

namespace indurop::solids {

namespace {

// Returns a right-handed frame with its third column along a direction.
Mat3 frame_along(const Vec3& direction) {
  Mat3 frame;
  frame.col(2) = direction.normalized();
  frame.col(0) = frame.col(2).unitOrthogonal();
  frame.col(1) = frame.col(2).cross(frame.col(0));
  return frame;
}

robot::Pose place_of(const Mat3& axes, const Vec3& middle_there) {
  return {axes * middle_there, robot::Quat(axes).normalized()};
}

Solid box_in(std::span<const Vec3> points, const Mat3& axes) {
  Eigen::AlignedBox3d extent;
  for (const Vec3& point : points) {
    extent.extend(axes.transpose() * point);
  }
  return Solid::box(extent.sizes(), place_of(axes, extent.center()));
}

// A box and a cylinder along the third column of a frame.
struct Along {
  Solid box, cylinder;
};

Along fit_direction(std::span<const Vec3> points, const Mat3& frame) {
  std::vector<Vec2> flat(points.size());
  double low = std::numeric_limits<double>::infinity();
  double high = -low;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vec3 there = frame.transpose() * points[i];
    flat[i] = there.head<2>();
    low = std::min(low, there.z());
    high = std::max(high, there.z());
  }
  const std::vector<Vec2> hull = hull_of(std::move(flat));
  const Circle circle = least_circle(hull);
  const Rectangle rectangle = least_rectangle(hull);
  const Mat3 turned = frame * Eigen::AngleAxisd(rectangle.angle, Vec3::UnitZ()).toRotationMatrix();
  const Vec3 middle(circle.middle.x(), circle.middle.y(), (low + high) / 2);
  return {box_in(points, turned), Solid::cylinder(circle.radius, high - low, place_of(frame, middle))};
}

// Moves towards the farthest point in ever smaller steps (M. Badoiu and K. L. Clarkson, "Smaller core-sets for balls",
// 2003).
Solid ball_around(std::span<const Vec3> points) {
  Vec3 middle = Vec3::Zero();
  for (const Vec3& point : points) {
    middle += point / static_cast<double>(points.size());
  }
  const auto farthest = [&] {
    return *std::max_element(points.begin(), points.end(), [&](const Vec3& a, const Vec3& b) {
      return (a - middle).squaredNorm() < (b - middle).squaredNorm();
    });
  };
  constexpr int kSteps = 200;
  for (int i = 1; i <= kSteps; ++i) {
    middle += (farthest() - middle) / (i + 1);
  }
  return Solid::ball((farthest() - middle).norm(), {middle, robot::Quat::Identity()});
}

// Keeps the solid with the least waste of those that are offered.
class Best {
 public:
  explicit Best(const Inside& inside) : inside_(inside) {}

  void offer(const Solid& solid) {
    if (const double waste = waste_of(solid, inside_); waste < waste_) {
      waste_ = waste;
      solid_ = solid;
    }
  }
  [[nodiscard]] const Solid& solid() const noexcept { return solid_; }
  [[nodiscard]] double waste() const noexcept { return waste_; }

 private:
  const Inside& inside_;
  Solid solid_;
  double waste_ = std::numeric_limits<double>::infinity();
};

// Returns directions spread evenly over half of a sphere, since opposite ones are equivalent.
std::vector<Vec3> spread_directions(int count) {
  const double golden = robot::kPi * (3 - std::sqrt(5.0));
  std::vector<Vec3> directions;
  for (int i = 0; i < count; ++i) {
    const double z = (i + 0.5) / count;
    const double r = std::sqrt(1 - z * z);
    directions.emplace_back(r * std::cos(golden * i), r * std::sin(golden * i), z);
  }
  return directions;
}

// Returns the points that are outermost in some direction: a solid around them is nearly around all.
std::vector<Vec3> outermost(std::span<const Vec3> points) {
  constexpr std::size_t kFew = 600;
  constexpr int kDirections = 300;
  if (points.size() <= kFew) {
    return {points.begin(), points.end()};
  }
  std::vector<Vec3> found;
  for (const Vec3& direction : spread_directions(kDirections)) {
    const auto nearer = [&](const Vec3& a, const Vec3& b) { return a.dot(direction) < b.dot(direction); };
    const auto [least, most] = std::minmax_element(points.begin(), points.end(), nearer);
    found.push_back(*least);
    found.push_back(*most);
  }
  return found;
}

// Returns the best solid of a kind along any direction: `kind` selects it from the solids along one direction.
Solid best_along(std::span<const Vec3> points, const std::vector<Vec3>& directions, Solid Along::*kind) {
  Vec3 best = directions.front();
  Solid found = fit_direction(points, frame_along(best)).*kind;
  const auto better = [&](const Vec3& direction) {
    const Solid one = fit_direction(points, frame_along(direction)).*kind;
    if (room_of(one) >= room_of(found)) {
      return false;
    }
    found = one;
    best = direction.normalized();
    return true;
  };
  for (const Vec3& direction : directions) {
    better(direction);
  }
  constexpr double kFirst = 0.1;  // rad
  constexpr double kLast = 0.0002;
  for (double step = kFirst; step > kLast;) {
    const Mat3 frame = frame_along(best);
    const bool moved = better(best + step * frame.col(0)) || better(best - step * frame.col(0)) ||
                       better(best + step * frame.col(1)) || better(best - step * frame.col(1));
    step = moved ? step : step / 2;
  }
  return found;
}

}  // namespace

double room_of(const Solid& solid) noexcept {
  const double product = (solid.half.array() + 0.0005).prod();
  switch (solid.kind) {
    case robot::SolidKind::Box:
      return 8 * product;
    case robot::SolidKind::Cylinder:
      return 2 * robot::kPi * product;
    case robot::SolidKind::Ball:
      break;
  }
  return 4.0 / 3 * robot::kPi * product;
}

Mat3 main_axes(std::span<const Vec3> points) {
  Vec3 mean = Vec3::Zero();
  for (const Vec3& point : points) {
    mean += point / static_cast<double>(points.size());
  }
  Mat3 spread = Mat3::Zero();
  for (const Vec3& point : points) {
    spread += (point - mean) * (point - mean).transpose();
  }
  Mat3 axes = Eigen::SelfAdjointEigenSolver<Mat3>(spread).eigenvectors();
  axes.col(2) = axes.col(0).cross(axes.col(1));
  return axes;
}

double waste_of(const Solid& solid, const Inside& inside) noexcept {
  const Mat3 back = solid.place.orientation.conjugate().toRotationMatrix();
  const Vec3 middle = back * solid.place.position;
  const auto held = std::count_if(inside.places.begin(), inside.places.end(),
                                  [&](const Vec3& place) { return reaches(solid, back * place - middle); });
  return room_of(solid) - inside.each * static_cast<double>(held);
}

Solid fit_along(std::span<const Vec3> points, std::span<const Mat3> frames, const Inside& inside) {
  Best best(inside);
  for (const Mat3& frame : frames) {
    best.offer(box_in(points, frame));
    for (const int axis : {0, 1, 2}) {
      Mat3 turned;
      turned << frame.col((axis + 1) % 3), frame.col((axis + 2) % 3), frame.col(axis);
      best.offer(fit_direction(points, turned).cylinder);
    }
  }
  return best.solid();
}

Solid fit(std::span<const Vec3> points, std::span<const Mat3> frames, const Inside& inside) {
  const std::vector<Vec3> outer = outermost(points);
  std::vector<Vec3> directions = spread_directions(60);
  const Mat3 axes = main_axes(outer);
  for (const int axis : {0, 1, 2}) {
    directions.emplace_back(axes.col(axis));
    for (const Mat3& frame : frames) {
      directions.emplace_back(frame.col(axis));
    }
  }
  Best straight(inside);
  straight.offer(fit_along(outer, frames, inside));
  straight.offer(ball_around(outer));
  Best any(inside);
  any.offer(best_along(outer, directions, &Along::box));
  any.offer(best_along(outer, directions, &Along::cylinder));
  constexpr double kNearly = 0.03;  // share of its volume
  return any.waste() < straight.waste() - kNearly * room_of(straight.solid()) ? any.solid() : straight.solid();
}

Solid rounded(const Solid& solid, std::span<const Vec3> points) {
  constexpr double kPlace = 1e5;  // steps in a metre or radian
  constexpr double kSize = 1e4;
  const auto to_grid = [&](const Vec3& value) {
    return Vec3((value * kPlace).array().round() / kPlace + 0.0);  // no -0
  };
  Solid round = solid;
  round.place.position = to_grid(solid.place.position);
  round.place.orientation = robot::from_rpy(to_grid(robot::to_rpy(solid.place.orientation)));
  Vec3 reach = Vec3::Zero();
  double radius = 0;
  double distance = 0;
  for (const Vec3& point : points) {
    const Vec3 there = round.place.orientation.conjugate() * (point - round.place.position);
    reach = reach.cwiseMax(there.cwiseAbs());
    radius = std::max(radius, there.head<2>().norm());
    distance = std::max(distance, there.norm());
  }
  // Rounds up slightly, so that the decimal value in a file is not smaller; and no size is 0.
  const auto up = [](double value) { return std::ceil((value + 1e-9) * kSize) / kSize; };
  if (round.kind == robot::SolidKind::Box) {
    round.half = Vec3(up(2 * reach.x()), up(2 * reach.y()), up(2 * reach.z())) / 2;
  } else if (round.kind == robot::SolidKind::Cylinder) {
    round.half = {up(radius), up(radius), up(2 * reach.z()) / 2};
  } else {
    round.half = Vec3::Constant(up(distance));
  }
  return round;
}

}  // namespace indurop::solids
