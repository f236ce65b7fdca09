// SPDX-License-Identifier: Apache-2.0
// The PUSH of the running job: an axis pushes until an end condition holds, and returns to where it began. Real-time
// safe.

#pragma once

#include "control/robot/job/step_values.h"

namespace indurop::robot {

class Pushing {
 public:
  // All are borrowed.
  Pushing(const JobBook& book, const StepValues& values, JobPlaces& places) noexcept
      : book_(book), values_(values), places_(places) {}

  // A job is started, or continues elsewhere.
  void reset() noexcept {
    phase_ = Phase::None;
    again_ = false;
  }
  // The job continues after a stop: what was pushing begins again, and returns to where it began first.
  void resume() noexcept;
  // Returns whether an axis pushes, or returns.
  [[nodiscard]] bool on() const noexcept { return phase_ != Phase::None; }

  // Executes a PUSH; begins when all motions have ended. `source`: of its motions. `done`: whether it has been done;
  // else it has to be called again in the next period.
  StepValues::Flaw run(const Step& step, double seconds, int source, Signals& signals, MotionPort& port,
                       bool& done) noexcept;

 private:
  enum class Phase { None, Pushes, Ends, Returns };

  StepValues::Flaw begin(const JobPush& push, MotionPort& port) noexcept;
  StepValues::Flaw push(const JobPush& push, double seconds, Signals& signals, MotionPort& port) noexcept;
  StepValues::Flaw end(const JobPush& push, int source, MotionPort& port) noexcept;
  StepValues::Flaw fail(const char* why, MotionPort& port) noexcept;

  const JobBook& book_;
  const StepValues& values_;
  JobPlaces& places_;
  Phase phase_ = Phase::None;
  const char* why_ = nullptr;  // it fails once the axis is at rest; null: it does not
  Joints from_ = Joints::Zero();
  bool again_ = false;  // it was stopped
  double passed_ = 0;   // s since it began
  double reached_ = 0;  // s that it has pushed with all of the torque
};

}  // namespace indurop::robot
