// SPDX-License-Identifier: Apache-2.0
// Interrupts of a job: conditions that are monitored while it runs. One that becomes true stops the robot on its path;
// the job it calls runs, the robot returns, and the interrupted job continues. Here is which of them are armed, which
// have come, and how far the one that is served is. Real-time safe.

#pragma once

#include <indurop/robot/controller.h>

#include <array>

#include "control/robot/job/job.h"

namespace indurop::robot {

class Interrupts {
 public:
  // The book is borrowed.
  explicit Interrupts(const JobBook& book) noexcept : book_(book) {}

  // Disarms all; none is served.
  void reset() noexcept;
  // Arms an interrupt of the book. A condition that is already true has to become false before it triggers.
  void arm(int interrupt, Signals& signals) noexcept;
  // Disarms all that call this job.
  void disarm(int job) noexcept;
  // Called once per period: evaluates the conditions of those that are armed.
  void monitor(Signals& signals) noexcept;

  // What is done for the interrupt that is served.
  enum class Phase {
    None,      // no interrupt is served
    Leaving,   // the robot comes to rest on its path
    Running,   // the job that the interrupt calls runs
    Returning  // the robot returns to its path
  };
  [[nodiscard]] Phase phase() const noexcept { return phase_; }
  [[nodiscard]] bool is(Phase phase) const noexcept { return phase_ == phase; }
  // Returns whether one has come that is not served yet.
  [[nodiscard]] bool any_pending() const noexcept;
  // Begins to serve the first one that has come.
  void serve_first() noexcept;
  // The robot is at rest: returns the job to call.
  int begin() noexcept;
  // The called job has ended.
  void begin_return() noexcept { phase_ = Phase::Returning; }
  // The robot is back, or it is not to be served now. One whose job was not called yet remains pending.
  void end() noexcept { phase_ = Phase::None; }

 private:
  [[nodiscard]] bool is_true(std::size_t interrupt, Signals& signals) const noexcept;

  struct Monitored {
    bool armed = false;
    bool was_true = false;  // value of its condition in the last period
    bool pending = false;   // it has become true
  };

  const JobBook& book_;
  std::array<Monitored, kMaxInterrupts> all_{};  // in the order of the book
  Phase phase_ = Phase::None;
  std::size_t served_ = 0;
};

}  // namespace indurop::robot
