// SPDX-License-Identifier: Apache-2.0
// Where a job pauses: before each of its lines, or before lines with a breakpoint. Real-time safe.

#pragma once

#include <indurop/robot/controller.h>

#include <cstdint>

#include "control/robot/job/call_stack.h"

namespace indurop::robot {

class LineBreakpoints {
 public:
  // Sets where to pause: before every line, or before these lines.
  void set(bool each, const Breakpoints& lines) noexcept {
    each_ = each;
    breakpoints_ = lines;
  }
  // A job begins at a line, or at another one than before.
  void reset() noexcept {
    passes_ = false;
    last_job_ = last_step_ = -1;
  }
  // The present line does not pause again.
  void pass() noexcept { passes_ = true; }
  // A step has been completed.
  void note_end() noexcept { passes_ = false; }
  // A step is run.
  void note(const CallStack& jobs) noexcept {
    last_job_ = jobs.job();
    last_step_ = jobs.index();
  }
  // Returns whether to pause before the present step. The other steps of a line belong to its first one, so there is no
  // pause between them.
  [[nodiscard]] bool before(const CallStack& jobs) const noexcept;

 private:
  bool each_ = false;
  Breakpoints breakpoints_{};
  bool passes_ = false;
  int last_step_ = -1;  // step of last_job_ that ran last
  int last_job_ = -1;
};

}  // namespace indurop::robot
