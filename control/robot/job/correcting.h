// SPDX-License-Identifier: Apache-2.0
// The CORRECT or PRESS of the running job: what its expressions say in each period. Real-time safe.

#pragma once

#include "control/robot/job/step_values.h"

namespace indurop::robot {

class Correcting {
 public:
  // The book is borrowed.
  explicit Correcting(const JobBook& book) noexcept : book_(book) {}

  // A job is started; none is on.
  void reset() noexcept {
    now_ = -1;
    skipped_ = false;
  }
  // Records a step before the one at which the job starts.
  void skip(const Step& step) noexcept;

  // Executes a CORRECT or PRESS, or its OFF. `source`: its line; `done`: whether it has been done; else it has to be
  // tried again.
  StepValues::Flaw run(const Step& step, int source, const JobPlaces& places, MotionPort& port, bool& done) noexcept;
  // Ends it where all motions end. Returns false if it is not done yet.
  bool end(MotionPort& port) noexcept;
  [[nodiscard]] bool on() const noexcept { return now_ >= 0; }
  // Returns why the motion of a step cannot be corrected; none: it can, or nothing is corrected.
  [[nodiscard]] StepValues::Flaw check(const Step& motion) const noexcept;
  // The line of the one that is on, as MotionLine::source().
  [[nodiscard]] int source() const noexcept { return source_; }
  // Called once per period while the job runs: sets how far to shift, or to press.
  StepValues::Flaw step(double seconds, const StepValues& values, Signals& signals, MotionPort& port) noexcept;

 private:
  [[nodiscard]] const JobCorrection& now() const noexcept;
  [[nodiscard]] const char* either(const char* correct, const char* press) const noexcept;
  StepValues::Flaw press(const StepValues& values, Signals& signals, MotionPort& port) const noexcept;

  const JobBook& book_;
  int now_ = -1;  // correction of the book
  int source_ = 0;
  bool skipped_ = false;  // the job was started between CORRECT or PRESS and its OFF
  double beat_ = 0;       // last value of the variable that counts the measurements
  double age_ = 0;        // s since it changed
};

}  // namespace indurop::robot
