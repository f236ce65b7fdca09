// SPDX-License-Identifier: Apache-2.0
// A smooth path of the tool through points: pieces of the fifth degree of its position and of the components of its
// orientation, with four continuous derivatives, so that jerk is continuous at any speed; straight at both ends. It
// passes each point exactly.

#pragma once

#include <Eigen/LU>
#include <array>

#include "control/robot/path/tool_path.h"

namespace indurop::robot {

class Spline final : public ToolPath {
 public:
  static constexpr int kMaxPoints = 100;

  struct Knot {
    Pose pose;
    double speed = 1;       // part of full speed towards it, above 0 to 1
    double tool_speed = 0;  // m/s, instead of `speed`; 0: none
    int source = 0;
  };

  // Real-time safe, like all functions of this class.
  void begin(const Pose& start, const ToolLimits& tool) noexcept;
  // Adds a point; there is room for kMaxPoints. Returns false if it is at the same place as the one before: it is left
  // out.
  bool add(const Knot& knot) noexcept;
  // Called after the last point; there must be at least one.
  void finish() noexcept;

  [[nodiscard]] int count() const noexcept { return count_; }
  // The place at which it passes point `i`; 0 is the start.
  [[nodiscard]] double place_of(int i) const noexcept { return at_[static_cast<std::size_t>(i)]; }

  [[nodiscard]] Pose pose_at(double place) const noexcept override;
  [[nodiscard]] Shape shape_at(double place) const noexcept override;
  // Distances are those on the curve itself.
  [[nodiscard]] PathWay way_at(double place) const noexcept override;
  [[nodiscard]] int source_at(double place) const noexcept override { return knots_[piece_at(place) + 1].source; }
  [[nodiscard]] const Pose& end() const noexcept override { return knots_[static_cast<std::size_t>(count_)].pose; }
  [[nodiscard]] double length() const noexcept override { return at_[static_cast<std::size_t>(count_)]; }
  [[nodiscard]] double at_speed() const noexcept override { return at_speed_; }
  [[nodiscard]] double way() const noexcept override { return way_; }

 private:
  // Position, then the components of the orientation.
  using Values = Eigen::Matrix<double, 7, 1>;
  struct Place {
    Values value, first, second, third;
  };

  [[nodiscard]] std::size_t piece_at(double place) const noexcept;
  [[nodiscard]] Place look(double place) const noexcept;
  [[nodiscard]] Vec3 turning_at(double place) const noexcept;
  void measure() noexcept;
  [[nodiscard]] double distance(std::size_t piece, double place) const noexcept;

  int count_ = 0;  // pieces
  double way_ = 0;
  double at_speed_ = 0;
  std::array<double, kMaxPoints + 1> at_{};
  std::array<double, kMaxPoints + 1> gone_{};  // m on the curve up to each point
  std::array<Knot, kMaxPoints + 1> knots_{};
  std::array<Values, kMaxPoints + 1> values_{};
  std::array<Values, kMaxPoints + 1> slopes_{}, bends_{};  // first and second derivatives at the points
};

}  // namespace indurop::robot
