// SPDX-License-Identifier: Apache-2.0
// Brakes on a path as hard as the joints can, period by period: each time as far back as their limits allow that still
// leaves room to take the braking back. It knows nothing of what paths are made of, only where the joints are on them.

#pragma once

#include <array>
#include <cmath>

#include "robot/arm.h"
#include "robot/inverse.h"
#include "robot/path_timing.h"
#include "robot/profile.h"

namespace indurop::robot {

// The path from the present place on.
class PathAhead {
 public:
  PathAhead() = default;
  PathAhead(const PathAhead&) = delete;
  PathAhead& operator=(const PathAhead&) = delete;
  virtual ~PathAhead() = default;
  // Joint angles `distance` further on; other than Ok leaves `q` alone.
  virtual Reach joints_ahead(double distance, const Joints& near, Joints& q) const noexcept = 0;
  // Joint angles there and their derivatives by the place, where they are known exactly: has_shape().
  struct Shape {
    Joints value, first, second, third;
  };
  [[nodiscard]] virtual bool has_shape() const noexcept { return false; }
  [[nodiscard]] virtual Shape shape_ahead(double /*distance*/) const noexcept { return {}; }
  // Where distances are seconds of a timing: how far along the path, from the present place on, that is, and joint
  // angles there.
  [[nodiscard]] virtual bool is_timed() const noexcept { return false; }
  [[nodiscard]] virtual Timed timed_ahead(double distance) const noexcept { return {distance}; }
  virtual Reach joints_on_path(double along, const Joints& near, Joints& q) const noexcept {
    return joints_ahead(along, near, q);
  }
  // Where the piece of the path ends on which that distance is; infinite: the last one. Shapes change abruptly there.
  [[nodiscard]] virtual double smooth_until(double /*distance*/) const noexcept { return HUGE_VAL; }
  // How far the path goes on.
  [[nodiscard]] virtual double left() const noexcept = 0;
};

// The last set points and how far the path was followed from each to the next; the latest first.
struct PathHistory {
  std::array<Joints, 3> joints;
  std::array<double, 2> moved{};
};

class PathBrake {
 public:
  explicit PathBrake(const JointLimits& limits) noexcept : most_(limits) {}

  // `hardness` multiplies the accelerations, its square the jerks. Real-time safe, as all here.
  void begin(double hardness) noexcept;
  // As it began last.
  [[nodiscard]] double hardness() const noexcept { return hardness_; }
  // How far to go in this period, and the joint angles there. 0 and the last set point: at rest. Where the joints
  // cannot keep their limits whatever it does, it breaks them least.
  Reach next(const PathAhead& path, const PathHistory& past, double period, double& distance, Joints& q) noexcept;

 private:
  struct Rates {
    Joints first, second, third;  // derivatives by the place
  };
  struct Motion {
    double place = 0, speed = 0, acceleration = 0;
  };
  // From and to, both possible; none if low > high.
  struct Span {
    double low, high;
  };

  [[nodiscard]] bool can_stand(const PathHistory& past, double period) const noexcept;
  [[nodiscard]] double far(const PathHistory& past, double period) const noexcept;
  Reach keep_in_sight(const PathAhead& path, const PathHistory& past, double period) noexcept;
  Reach look_ahead(const PathAhead& path, const Joints& here, double distance) noexcept;
  using Polynomial = std::array<Joints, 5>;

  Reach fit(const PathAhead& path, Joints& near, double from, double length) noexcept;
  [[nodiscard]] const Polynomial& polynomial(double& place, double& unit) const noexcept;
  [[nodiscard]] Timed timed(double place) const noexcept;
  [[nodiscard]] Joints joints_at(double place) const noexcept;
  [[nodiscard]] Rates rates(double place) const noexcept;
  // What |first * y + rest| <= most leaves for y.
  static Span span_of(const Joints& first, const Joints& rest, const Joints& most) noexcept;
  static Span inside(const Span& span, double part) noexcept;
  [[nodiscard]] Span jerks(const Rates& r, const Motion& m) const noexcept;
  [[nodiscard]] Span distances(const PathHistory& past, const Joints& there, double distance,
                               double period) const noexcept;
  [[nodiscard]] double choose(const Span& span, const PathHistory& past, double period) const noexcept;
  // Speed that is left when the braking has been taken back as fast as possible; below 0 if it is too late for that.
  [[nodiscard]] double left_over(Motion motion, double period) const noexcept;
  [[nodiscard]] Motion after(double distance, const PathHistory& past, double period) const noexcept;

  JointLimits most_;
  double hardness_ = 1;
  const PathAhead* exact_ = nullptr;  // in next(), where it is exact; else polynomials do
  Joints acceleration_ = Joints::Zero();
  Joints jerk_ = Joints::Zero();
  // The path ahead as polynomials of the fourth degree, in quarters of their part of it, one for each of its pieces;
  // the timing of it in equal parts of `length_`, if it has one.
  static constexpr std::size_t kMostPieces = 3;
  static constexpr int kTimes = 16;
  std::size_t pieces_ = 0;
  std::array<double, kMostPieces + 1> bounds_{};
  std::array<Polynomial, kMostPieces> shape_;
  std::array<Timed, kTimes + 1> times_{};
  bool timed_ = false;
  double length_ = 0;
  double gone_ = 0;     // since they were made
  double changed_ = 0;  // last change of the acceleration, per period, as a distance
};

}  // namespace indurop::robot
