// SPDX-License-Identifier: Apache-2.0
#include "control/robot/group/interrupt_shelf.h"

namespace indurop::robot {

bool InterruptShelf::step_aside() noexcept {
  Follower& follower = robot_.follower;
  if (!leaving_) {
    if (!follower.idle() && follower.at_rest()) {
      return false;
    }
    leaving_ = true;
    asked_ = !plans_.free();
    request_ = plans_.request();
    plans_.forget();
    follower.keep_path();
    follower.stop();
  }
  if (!follower.idle() || plans_.holds_forgotten()) {
    return false;
  }
  follower.reset(robot_.commanded());  // braking ends where the path ends; nothing of it was saved yet
  leaving_ = false;
  used_ = true;
  path_ = follower.kept_path();
  tool_ = robot_.tool.number();
  ahead_.clear();
  plans_.ahead().swap(ahead_);
  resuming_.forget_steps();
  plans_.disconnect();
  return true;
}

bool InterruptShelf::come_back(Fault& fault) noexcept {
  if (!group_.change_tool(tool_)) {
    return false;
  }
  if (!resuming_.is_near(path_.q)) {
    fault = {ErrorCode::Away};
    return false;
  }
  resuming_.begin_from_interrupt(path_.q);
  return true;
}

// The interrupted job becomes the current one again, to be left or continued.
void InterruptShelf::restore() noexcept {
  used_ = false;
  robot_.follower.set_kept_path(path_);
  plans_.ahead().clear();
  plans_.ahead().swap(ahead_);
  plans_.set_request(request_);
  resuming_.forget_steps();
}

void InterruptShelf::end_come_back() noexcept {
  resuming_.cancel_way_back();
  restore();
  resuming_.continue_on_path(asked_);
}

bool InterruptShelf::set_job_aside() noexcept {
  if (resuming_.way_back() == Resuming::Return::FromInterrupt) {
    restore();
    resuming_.set_aside(tool_, asked_);
  } else if (leaving_) {
    leaving_ = false;
    plans_.set_request(request_);
    resuming_.set_aside(robot_.tool.number(), asked_);
  } else {
    return false;
  }
  return true;
}

void InterruptShelf::drop() noexcept {
  used_ = leaving_ = false;
  ahead_.clear();
}

}  // namespace indurop::robot
