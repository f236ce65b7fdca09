// SPDX-License-Identifier: Apache-2.0
// Where the points and frames of the running job are: as declared, or as jobs have computed them since it was started.

#pragma once

#include <array>

#include "control/robot/job/job.h"
#include "control/robot/job/motion_port.h"

namespace indurop::robot {

class JobPlaces {
 public:
  // The book is borrowed.
  explicit JobPlaces(const JobBook& book) noexcept : book_(book) {}

  // All points and frames are where they were declared; nothing was found. Real-time safe, like all functions below.
  void reset() noexcept;
  // Computes a place formula of the book. Returns false if it has no value; `in` then says why.
  bool compute(int formula, FormulaInput& in, Pose& pose, Quat& axes) const noexcept;
  // The same; NaN if it has no value. Position in mm, angles in degrees; Distance: of the position from the origin.
  double coordinate(int formula, Coordinate which, FormulaInput& in) const noexcept;
  // Puts a computed place of the book there. `axes`: of the frame in which it was given.
  void set(int computed, const Pose& pose, const Quat& axes) noexcept;
  // A point as the target of a motion with this tool.
  [[nodiscard]] Target target(int point, int tool) const noexcept;
  // The axes of the frame in which a point was given.
  [[nodiscard]] Quat axes(int point) const noexcept;

  // A frame of the book.
  [[nodiscard]] Pose frame(int index) const noexcept { return frame_pose(index); }

  // Whether the last UNTIL has ended its motion, and where.
  struct Finding {
    bool known = false;
    Joints joints = Joints::Zero();
    Pose pose;
  };
  [[nodiscard]] const Finding& found() const noexcept { return found_; }
  void set_found(const Finding& found) noexcept { found_ = found; }

 private:
  struct Placed {
    bool known = false;  // a job has computed it
    Pose pose;
    Quat axes = Quat::Identity();
  };
  [[nodiscard]] const Placed* placed(int computed) const noexcept;
  [[nodiscard]] Pose frame_pose(int frame) const noexcept;
  bool leaf(const PlacePart& part, FormulaInput& in, Pose& pose) const noexcept;
  bool pose_of(int first, FormulaInput& in, Pose& pose) const noexcept;

  const JobBook& book_;
  std::array<Placed, kMaxComputed> placed_{};  // as in the book
  Finding found_;
};

}  // namespace indurop::robot
