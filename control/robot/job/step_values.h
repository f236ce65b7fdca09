// SPDX-License-Identifier: Apache-2.0
// What the steps of the running job compute: numbers, variables and results of jobs, places. Real-time safe.

#pragma once

#include <cmath>
#include <span>

#include "control/robot/job/call_stack.h"
#include "control/robot/job/job_places.h"

namespace indurop::robot {

class StepValues {
 public:
  // All are borrowed.
  StepValues(const JobBook& book, CallStack& jobs, JobPlaces& places) noexcept
      : book_(book), jobs_(jobs), places_(places) {}

  // Why a step cannot be done, and the column of its line; column 0: none in particular.
  struct Flaw {
    const char* why = nullptr;
    unsigned column = 0;
    [[nodiscard]] bool ok() const noexcept { return why == nullptr; }
  };

  // A job is started.
  void reset() noexcept { time_ = 0; }
  // Called once per period in which the job runs.
  void pass(double seconds) noexcept { time_ += seconds; }

  Flaw number(int formula, Signals& signals, const MotionPort& port, double& value) const noexcept;
  // Numbers of formulas that follow each other.
  Flaw numbers(int first, std::size_t count, Signals& signals, const MotionPort& port, double* values) const noexcept;
  // Computes the value of a SPEED, ZONE or ACC, and checks its range; `with` is the same step with it.
  Flaw setting(const Step& step, Signals& signals, const MotionPort& port, Step& with) const noexcept;
  // Writes a text of the book.
  Flaw text(int index, Signals& signals, const MotionPort& port, std::span<char> to) const noexcept;
  // Executes steps of these kinds: Assign; Return, with its value; Place.
  Flaw assign(const Step& step, Signals& signals, const MotionPort& port) noexcept;
  Flaw give_back(const Step& step, Signals& signals, const MotionPort& port) noexcept;
  Flaw compute_place(const Step& step, Signals& signals, const MotionPort& port) noexcept;
  // Sets a variable of the job; -1: none.
  void store(int variable, double value) noexcept {
    if (variable >= 0) {
      jobs_.variables()[static_cast<std::size_t>(variable)] = value;
    }
  }

 private:
  [[nodiscard]] FormulaInput input(Signals& signals, const MotionPort& port) const noexcept {
    return {jobs_.variables(), signals, time_, &places_, &port};
  }

  const JobBook& book_;
  CallStack& jobs_;
  JobPlaces& places_;
  double time_ = 0;  // s that the job has run
};

}  // namespace indurop::robot
