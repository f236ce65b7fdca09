// SPDX-License-Identifier: Apache-2.0
// The jobs that call each other: the step at which each of them is, its open loops and its variables. Real-time safe.

#pragma once

#include <array>
#include <cmath>
#include <limits>

#include "control/robot/job/job.h"

namespace indurop::robot {

class CallStack {
 public:
  static constexpr int kMaxJobs = 8;
  using Variables = std::array<double, kMaxVariables>;

  // The book is borrowed.
  explicit CallStack(const JobBook& book) noexcept : book_(book) {}

  // Begins with this job, at its first step.
  void reset(int job = 0) noexcept;
  [[nodiscard]] bool is_full() const noexcept { return depth_ + 1 >= kMaxJobs; }
  // Number of jobs that wait for the called one.
  [[nodiscard]] int depth() const noexcept { return depth_; }
  // Calls a job; not if the stack is full. `result`: variable of the present job that gets its value; -1: none.
  void call(int job, const Variables& variables, int result = -1) noexcept;
  // The value that the present job gives to its caller.
  void set_value(double value) noexcept { frame().value = value; }
  // Returns whether the caller waits for a value and the present job has none.
  [[nodiscard]] bool lacks_value() const noexcept { return frame().result >= 0 && std::isnan(frame().value); }
  // Returns to the caller, which gets the value.
  void finish() noexcept;
  // Returns to the job of this depth, at the step where it was left.
  void return_to(int depth) noexcept { depth_ = depth; }

  [[nodiscard]] int job() const noexcept { return frame().job; }
  // Index of the present step.
  [[nodiscard]] int index() const noexcept { return frame().step; }
  // The present step; null: the job is at its end.
  [[nodiscard]] const Step* step() const noexcept { return step_at(depth_); }
  // The step at which the job of this depth is; null: it is at its end.
  [[nodiscard]] const Step* step_at(int depth) const noexcept;
  [[nodiscard]] Variables& variables() noexcept { return frame().variables; }
  // The steps of the present job.
  [[nodiscard]] const std::vector<Step>& steps() const noexcept { return steps_of(frame()); }

  void advance() noexcept { ++frame().step; }
  // Goes to a step of the same nesting of loops.
  void go_to(int step) noexcept { frame().step = step; }
  // Goes to a step. Loops that do not enclose it are left; one that is entered from outside runs once.
  void jump(int step) noexcept;
  // Goes to the end of the job.
  void leave() noexcept { frame().step = static_cast<int>(steps().size()); }
  void begin_loop(const Step& step) noexcept;
  void end_loop(const Step& step) noexcept;

 private:
  struct Frame {
    int job = 0;
    int step = 0;
    int loops = 0;
    std::array<double, kMaxLoops> left{};  // times the open loops still run
    Variables variables{};
    int result = -1;  // variable of the caller
    double value = std::numeric_limits<double>::quiet_NaN();
  };
  [[nodiscard]] Frame& frame() noexcept { return frames_[static_cast<std::size_t>(depth_)]; }
  [[nodiscard]] const Frame& frame() const noexcept { return frames_[static_cast<std::size_t>(depth_)]; }
  [[nodiscard]] const std::vector<Step>& steps_of(const Frame& frame) const noexcept {
    return book_.jobs[static_cast<std::size_t>(frame.job)].steps;
  }

  const JobBook& book_;
  std::array<Frame, kMaxJobs> frames_{};
  int depth_ = 0;
};

}  // namespace indurop::robot
