// SPDX-License-Identifier: Apache-2.0
// Brakes on a path as hard as the joints can, period by period: each time as hard as their limits allow while the
// braking can still be released in time. It does not know what paths consist of, only where the joints are on them.

#pragma once

#include <array>
#include <cmath>

#include "control/robot/kinematics/arm.h"
#include "control/robot/kinematics/inverse.h"
#include "control/robot/path/profile.h"
#include "control/robot/path/timing.h"

namespace indurop::robot {

// The path from the present place on.
class PathAhead {
 public:
  PathAhead() = default;
  PathAhead(const PathAhead&) = delete;
  PathAhead& operator=(const PathAhead&) = delete;
  virtual ~PathAhead() = default;
  // Joint angles at this distance ahead; a result other than Ok leaves `q` unchanged.
  virtual Reach joints_ahead(double distance, const Joints& near, Joints& q) const noexcept = 0;
  // Joint angles at a place and their derivatives with respect to the place, if these are known exactly: has_shape().
  struct Shape {
    Joints value, first, second, third;
  };
  [[nodiscard]] virtual bool has_shape() const noexcept { return false; }
  [[nodiscard]] virtual Shape shape_ahead(double /*distance*/) const noexcept { return {}; }
  // If distances are seconds of a timing: how far along the path from the present place that is, and the joint angles
  // there.
  [[nodiscard]] virtual bool is_timed() const noexcept { return false; }
  [[nodiscard]] virtual Timed timed_ahead(double distance) const noexcept { return {distance}; }
  virtual Reach joints_on_path(double along, const Joints& near, Joints& q) const noexcept {
    return joints_ahead(along, near, q);
  }
  // Distance along the path at which the piece of it around `distance` ends; infinite for the last piece. Shapes change
  // abruptly there, or are no longer simple.
  [[nodiscard]] virtual double smooth_until(double /*distance*/) const noexcept { return HUGE_VAL; }
  // Distance to the end of the path.
  [[nodiscard]] virtual double left() const noexcept = 0;
};

// The last set points and the distance on the path from each to the next; the latest first.
struct PathHistory {
  std::array<Joints, 3> joints;
  std::array<double, 2> moved{};
};

class PathBrake {
 public:
  explicit PathBrake(const JointLimits& limits) noexcept : most_(limits) {}

  // Begins to brake. `hardness` multiplies the accelerations, its square the jerks. Real-time safe, like all functions
  // of this class.
  void begin(double hardness) noexcept;
  // The hardness of the last begin().
  [[nodiscard]] double hardness() const noexcept { return hardness_; }
  // The distance to move in this period, and the joint angles there. 0 and the last set point: at rest. Where the
  // joints cannot keep their limits in any case, it violates them as little as possible.
  Reach next(const PathAhead& path, const PathHistory& past, double period, double& distance, Joints& q) noexcept;

 private:
  struct Rates {
    Joints first, second, third;  // derivatives by the place
  };
  struct Motion {
    double place = 0, speed = 0, acceleration = 0;
  };
  // An interval, both limits included; empty if low > high.
  struct Span {
    double low, high;
  };

  void set_path(const PathAhead& path) noexcept;
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
  // Values of y for which |first * y + rest| <= most.
  static Span span_of(const Joints& first, const Joints& rest, const Joints& most) noexcept;
  static Span inside(const Span& span, double part) noexcept;
  [[nodiscard]] Span jerks(const Rates& r, const Motion& m) const noexcept;
  [[nodiscard]] Span distances(const PathHistory& past, const Joints& there, double distance,
                               double period) const noexcept;
  [[nodiscard]] double choose(const Span& span, const PathHistory& past, double period) const noexcept;
  // Speed that is left when the braking has been released as fast as possible; below 0 if it is too late for that.
  [[nodiscard]] double left_over(Motion motion, double period) const noexcept;
  [[nodiscard]] Motion after(double distance, const PathHistory& past, double period) const noexcept;

  JointLimits most_;
  double hardness_ = 1;
  const PathAhead* exact_ = nullptr;  // in next(), if its shape is known exactly; else the polynomials are used
  Joints acceleration_ = Joints::Zero();
  Joints jerk_ = Joints::Zero();
  // The path ahead as polynomials of the fourth degree, one for each of its pieces, in quarters of the length of the
  // piece; and its timing, if it has one, in equal parts of `length_`.
  static constexpr std::size_t kMostPieces = 8;
  static constexpr int kTimes = 16;
  std::size_t pieces_ = 0;
  std::array<double, kMostPieces + 1> bounds_{};
  std::array<Polynomial, kMostPieces> shape_;
  std::array<Timed, kTimes + 1> times_{};
  bool timed_ = false;
  double length_ = 0;
  double gone_ = 0;     // distance since they were made
  double changed_ = 0;  // last change of the acceleration, per period, as a distance
};

}  // namespace indurop::robot
