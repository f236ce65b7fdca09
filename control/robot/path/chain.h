// SPDX-License-Identifier: Apache-2.0
// Many lines with zones as one smooth path: each point is the mean of the lines around it, as far as the zone reaches,
// so corners are round however short the lines are. The path begins and ends exactly where the lines do.

#pragma once

#include <array>

#include "control/robot/path/tool_path.h"

namespace indurop::robot {

class Chain final : public ToolPath {
 public:
  static constexpr int kMaxLines = 1024;

  struct Line {
    Pose end;
    double zone = 0;        // m, around its end
    double speed = 1;       // part of full speed, above 0 to 1
    double tool_speed = 0;  // m/s, instead of speed; 0: none
    int source = 0;
  };

  // All functions of this class are real-time safe.
  void begin(const Pose& start, const ToolLimits& tool) noexcept;
  // The caller ensures that there is room (kMaxLines). Returns false if the line has no length: it is left
  // out.
  bool add(const Line& line) noexcept;
  // Called after the last line.
  void finish() noexcept;

  [[nodiscard]] int count() const noexcept { return count_; }
  // Returns whether zones overlap on a line, so that corners cannot be passed one after the other.
  [[nodiscard]] bool crowded() const noexcept { return crowded_; }
  [[nodiscard]] double at_speed() const noexcept override { return at_speed_; }
  [[nodiscard]] double way() const noexcept override { return way_; }
  [[nodiscard]] double length() const noexcept override { return at_[static_cast<std::size_t>(count_)]; }
  [[nodiscard]] const Pose& end() const noexcept override { return poses_[static_cast<std::size_t>(count_)]; }
  [[nodiscard]] Pose pose_at(double place) const noexcept override;
  [[nodiscard]] LineLimits limits_at(double place) const noexcept override;
  [[nodiscard]] int source_at(double place) const noexcept override;

 private:
  using Corners = std::array<Vec3, kMaxLines + 1>;
  // Lines `first` to `last` are within reach of a place on the path.
  struct Window {
    double half = 0;
    int first = 0, last = 0;
  };

  [[nodiscard]] int line_at(double place) const noexcept;
  [[nodiscard]] Window window(double place) const noexcept;
  // Returns the progress around corner i at this place: 0 before the corner, growing by 1 per second after it.
  [[nodiscard]] double ramp(int i, double place, double half) const noexcept;

  ToolLimits tool_;
  int count_ = 0;
  bool crowded_ = false;
  double way_ = 0;
  double at_speed_ = 0;
  double half_ = 0;                         // s at full speed, half width of the mean
  std::array<double, kMaxLines + 1> at_{};  // where the lines begin, and the last one ends
  std::array<Pose, kMaxLines + 1> poses_{};
  // For each line: its velocity and turn rate (base frame), and its rotation (frame of its beginning).
  Corners moving_{}, turning_{}, turns_{};
  std::array<double, kMaxLines> speeds_{}, zones_{};
  std::array<int, kMaxLines> sources_{};
};

}  // namespace indurop::robot
