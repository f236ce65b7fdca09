// SPDX-License-Identifier: Apache-2.0
// Many lines and arcs with zones as one smooth path: around each corner a point is the mean of those there, as far as
// the zone reaches, so corners are round however short the lines are. The path begins and ends exactly where they do.

#pragma once

#include <array>
#include <cstdint>

#include "control/robot/path/arc.h"
#include "control/robot/path/segment.h"
#include "control/robot/path/tool_path.h"

namespace indurop::robot {

class Chain final : public ToolPath {
 public:
  static constexpr int kMaxLines = 1024;  // arcs included
  static constexpr int kMaxArcs = 32;

  struct Line {
    Pose end;
    double zone = 0;        // m, around its end
    double speed = 1;       // part of full speed, above 0 to 1
    double tool_speed = 0;  // m/s, instead of speed; 0: none
    int source = 0;
    bool bent = false;  // an arc through this place
    Vec3 mid = Vec3::Zero();
  };

  // All functions of this class are real-time safe.
  // Begins without lines.
  void begin(const Pose& start, const ToolLimits& tool) noexcept;
  // Returns whether a line may be added: it is straight, or an arc for which there is room.
  [[nodiscard]] bool takes(const Line& line) const noexcept;
  // Adds a line that it takes; the caller ensures that there is room (kMaxLines). Returns false if the line has no
  // length: it is left out.
  bool add(const Line& line) noexcept;
  // Called after the last line.
  void finish() noexcept;

  [[nodiscard]] int count() const noexcept { return count_; }
  // Returns whether zones overlap on a line, so that corners cannot be passed one after the other.
  [[nodiscard]] bool crowded() const noexcept { return crowded_; }
  // Returns whether it is as long as a timing has knots for, whatever the speed of its lines is.
  [[nodiscard]] bool full() const noexcept;
  // Line `i` as a motion of its own, which ends at rest.
  [[nodiscard]] MoveCommand line(int i) const noexcept;
  // s that this motion takes at least.
  [[nodiscard]] double least_time(int i) const noexcept;
  [[nodiscard]] double at_speed() const noexcept override { return at_speed_; }
  [[nodiscard]] double way() const noexcept override { return way_; }
  [[nodiscard]] double length() const noexcept override { return at_[static_cast<std::size_t>(count_)]; }
  [[nodiscard]] const Pose& end() const noexcept override { return poses_[static_cast<std::size_t>(count_)]; }
  [[nodiscard]] Pose pose_at(double place) const noexcept override;
  [[nodiscard]] Shape shape_at(double place) const noexcept override;
  [[nodiscard]] int source_at(double place) const noexcept override;

 private:
  using Corners = std::array<Vec3, kMaxLines + 1>;
  using Numbers = std::array<double, kMaxLines + 1>;
  // The lines from `first` to `last` are within reach of a place on the path; corners are numbered as the lines that
  // begin there.
  struct Window {
    int first = 0, last = 0;
  };

  // Progress on a line, in s at full speed, and its derivatives by the place.
  struct Progress {
    double value = 0, first = 0, second = 0, third = 0;
  };

  // The place on line `i` after that progress; its derivative by the progress.
  [[nodiscard]] Vec3 on_line(int i, double progress) const noexcept;
  [[nodiscard]] Vec3 slope(int i, double progress, int order) const noexcept;
  [[nodiscard]] double length_of(int i) const noexcept { return at_[at(i + 1)] - at_[at(i)]; }
  [[nodiscard]] double reach(int i) const noexcept;
  [[nodiscard]] Window window(double place) const noexcept;
  // The progress beyond corner `i` at this place: 0 before the corner, growing by 1 per second after it.
  [[nodiscard]] Progress beyond(int i, double place) const noexcept;

  int count_ = 0;
  bool crowded_ = false;
  double way_ = 0;
  double at_speed_ = 0;
  double turned_ = 0;  // sum of the changes of direction in corners
  Numbers at_{};       // where the lines begin, and the last one ends
  Numbers half_{};     // s at full speed, half width of the mean around each corner
  std::array<Pose, kMaxLines + 1> poses_{};
  // For each line: its velocity, of arcs at the beginning, and turn rate (base frame), and its rotation (frame of its
  // beginning).
  Corners moving_{}, turning_{}, turns_{};
  std::array<std::uint8_t, kMaxLines> arc_of_{};  // number of its arc, from 1; 0: it is straight
  int arc_count_ = 0;
  std::array<Arc, kMaxArcs> arcs_{};
  std::array<double, kMaxLines> speeds_{}, zones_{};
  std::array<int, kMaxLines> sources_{};
};

}  // namespace indurop::robot
