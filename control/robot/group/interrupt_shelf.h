// SPDX-License-Identifier: Apache-2.0
// Interrupts of jobs: the state of the running job is saved here while the job that was called moves the robot, and is
// restored when the robot has come back. Meanwhile the follower and the plans belong to the interrupt, which may be
// interrupted as well: the last state saved is the first one restored.

#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "control/robot/group/group_port.h"
#include "control/robot/group/plans.h"
#include "control/robot/group/resuming.h"
#include "control/robot/group/robot.h"
#include "control/robot/job/job.h"

namespace indurop::robot {

class InterruptShelf {
 public:
  // Allocates; no other function of this class does.
  InterruptShelf(Robot& robot, GroupPort& group, Plans& plans, Resuming& resuming)
      : robot_(robot),
        group_(group),
        plans_(plans),
        resuming_(resuming),
        saved_{Saved(robot), Saved(robot), Saved(robot)} {}

  // Calls add(vector) for the memory that changes, see KeptImage.
  template <class Add>
  void blocks(const Add& add) {
    for (Saved& saved : saved_) {
      saved.ahead.blocks(add);
    }
  }

  // Comes to rest as softly as the motion itself, and saves the job. While the motion is held it stays on its path, and
  // the interrupt waits. Returns false if it is not done yet. Real-time safe, like all functions below.
  bool step_aside() noexcept;
  // Returns whether the job is on the way to rest for that.
  [[nodiscard]] bool leaving() const noexcept { return leaving_; }
  // While it is leaving and at rest: MoveCommand::source of the motion with which the job will go on; 0: none.
  [[nodiscard]] int left_source() const noexcept {
    const Saved& saved = saved_[count_];
    return continued_source(robot_.follower.kept_path(), saved.asked ? &saved.request : nullptr, plans_.ahead());
  }
  // Joint values where the path was left last; null if no job is saved.
  [[nodiscard]] const Joints* left_at() const noexcept { return count_ > 0 ? &path().q : nullptr; }
  // The path that was left last; a job is saved.
  [[nodiscard]] const KeptPath& path() const noexcept { return paths_[count_ - 1]; }
  // All paths that were left, and as many empty ones as may still be.
  [[nodiscard]] std::span<const KeptPath> paths() const noexcept { return paths_; }
  // Begins the way back to the path. Returns false if it is not begun. Errors: Away.
  bool come_back(Fault& fault) noexcept;
  // The robot is back on the path: the saved job continues.
  void end_come_back() noexcept;
  // Keeps the saved job to be resumed later, after a stop on the way from or to its path. Returns false if it is on
  // neither.
  bool set_job_aside() noexcept;
  void drop() noexcept;

 private:
  // What is saved of a job, in addition to its path.
  struct Saved {
    explicit Saved(const Robot& robot) : ahead(robot.tool.places(), robot.parts.tool) {}

    ReadAhead ahead;
    PlanRequest request{};
    bool asked = false;  // a plan was being made
    int tool = 0;
  };
  // The job that was saved last becomes the current one again, to be left or continued.
  const Saved& restore() noexcept;

  Robot& robot_;
  GroupPort& group_;
  Plans& plans_;
  Resuming& resuming_;
  bool leaving_ = false;
  std::size_t count_ = 0;  // of saved jobs
  std::array<KeptPath, kMaxPriorities> paths_{};
  std::array<Saved, kMaxPriorities> saved_;
};

}  // namespace indurop::robot
