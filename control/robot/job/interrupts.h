// SPDX-License-Identifier: Apache-2.0
// Interrupts of a job: conditions that are monitored while it runs. One that becomes true stops the robot on its path;
// the job it calls runs, the robot returns, and the interrupted job continues. The job that was called can be
// interrupted in the same way, by an interrupt with a lower priority number. Here is which of them are armed, which
// have come, which are served, and how far the innermost of these is. Real-time safe.

#pragma once

#include <indurop/robot/controller.h>

#include <array>
#include <span>

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

  // What is done for the innermost interrupt.
  enum class Phase {
    None,      // no interrupt is served
    Leaving,   // the robot comes to rest on its path, for one that is not among the served ones yet
    Running,   // the job that the interrupt calls runs
    Returning  // the robot returns to its path
  };
  [[nodiscard]] bool is(Phase phase) const noexcept { return phase_ == phase; }
  // Number of those that are served: each of them interrupts the job of the one before.
  [[nodiscard]] std::size_t served() const noexcept { return count_; }
  // Returns whether one has come that may interrupt what runs now.
  [[nodiscard]] bool any_due() const noexcept { return due() < book_.interrupts.size(); }
  // Writes the jobs that those which have come will call, in the order in which they will be served, as far as there is
  // room. Returns their number.
  std::size_t pending(std::span<int> jobs) const noexcept;
  // One that is due is about to be served.
  void begin_leaving() noexcept { phase_ = Phase::Leaving; }
  // The robot is at rest: serves the one with the lowest priority number that is due now, and returns the job to call.
  int begin() noexcept;
  // The called job has ended.
  void begin_return() noexcept { phase_ = Phase::Returning; }
  // The robot is back: the innermost one is served no longer.
  void end() noexcept;
  // What is due is not to be served now; it remains due.
  void cancel_leaving() noexcept { phase_ = count_ > 0 ? Phase::Running : Phase::None; }

 private:
  [[nodiscard]] bool is_true(std::size_t interrupt, Signals& signals) const noexcept;
  // Index in the book; of several with the same priority, the first one. The number of interrupts: none is due.
  [[nodiscard]] std::size_t due() const noexcept;

  struct Monitored {
    bool armed = false;
    bool was_true = false;  // value of its condition in the last period
    bool pending = false;   // it has become true
  };

  const JobBook& book_;
  std::array<Monitored, kMaxInterrupts> all_{};  // in the order of the book
  Phase phase_ = Phase::None;
  std::array<int, kMaxPriorities> served_{};  // their priority numbers, which decrease
  std::size_t count_ = 0;
};

}  // namespace indurop::robot
