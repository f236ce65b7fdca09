// SPDX-License-Identifier: Apache-2.0
// The TRACK of the running job: a frame that moves with a belt or a table, and whether the tool moves with it.
// Real-time safe.

#pragma once

#include "control/robot/job/step_values.h"

namespace indurop::robot {

class Riding {
 public:
  // The book is borrowed.
  explicit Riding(const JobBook& book) noexcept : book_(book) {}

  // A job is started; no frame moves.
  void reset() noexcept {
    computed_ = -1;
    rides_ = false;
    skipped_ = false;
  }
  // Records a step before the one at which the job starts.
  void skip(const Step& step) noexcept;
  // Returns whether a frame moves, and whether the tool moves with it.
  [[nodiscard]] bool on() const noexcept { return computed_ >= 0; }
  [[nodiscard]] bool rides() const noexcept { return rides_; }

  // Executes a TRACK, or a TRACK OFF. `done`: whether it has been done; else it has to be tried again.
  StepValues::Flaw run(const Step& step, const JobPlaces& places, MotionPort& port, bool& done) noexcept;
  // Ends it: the tool leaves the belt. Returns false if it is not done yet.
  bool end(MotionPort& port) noexcept;
  // Called before a motion is commanded: lets the tool move with the frame if the motion goes to a point in it, and
  // leave it otherwise. `ready`: whether the motion can be commanded now; else it has to be tried again.
  StepValues::Flaw prepare(const Step& motion, JobPlaces& places, MotionPort& port, bool& ready) noexcept;

 private:
  [[nodiscard]] bool is_in_frame(int point) const noexcept;

  const JobBook& book_;
  int computed_ = -1;  // the frame, as computed place of the book; -1: none
  bool rides_ = false;
  bool skipped_ = false;  // the job was started between TRACK and TRACK OFF
};

}  // namespace indurop::robot
