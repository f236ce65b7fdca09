// SPDX-License-Identifier: Apache-2.0
// From steps to commands of motions: where they go, as declared or computed, and with which settings. Real-time safe.

#pragma once

#include "control/robot/job/job_places.h"
#include "control/robot/job/step_values.h"

namespace indurop::robot {

// Settings of motions that apply until a line changes them.
struct MotionSettings {
  double speed = 1;       // part of full speed
  double tool_speed = 0;  // m/s; 0: that of `speed`
  double zone = 0;        // m
  double acceleration = 1;
  int tool = 0;
  int wave = -1;  // of the book; -1: none

  void apply(const Step& step) noexcept;
};

class StepMotions {
 public:
  // All are borrowed.
  StepMotions(const JobBook& book, const JobPlaces& places, const StepValues& values) noexcept
      : book_(book), places_(places), values_(values) {}

  // Sets where `command` goes and how; not its source and ticket.
  StepValues::Flaw make(const Step& step, const MotionSettings& settings, Signals& signals, const MotionPort& port,
                        MoveCommand& command) const noexcept;

 private:
  StepValues::Flaw place(const Step& step, int tool, const MotionPort& port, Target& target) const noexcept;
  StepValues::Flaw shift(const Step& step, Signals& signals, const MotionPort& port, Target& target) const noexcept;

  static void give_axis(const Step& setting, Move move, const MotionPort& port, Target& target) noexcept;

  const JobBook& book_;
  const JobPlaces& places_;
  const StepValues& values_;
};

}  // namespace indurop::robot
