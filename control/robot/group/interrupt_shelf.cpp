// SPDX-License-Identifier: Apache-2.0
#include "control/robot/group/interrupt_shelf.h"

namespace indurop::robot {

bool InterruptShelf::step_aside() noexcept {
  Follower& follower = robot_.follower;
  Saved& saved = saved_[count_];
  if (!leaving_) {
    if (!follower.idle() && follower.at_rest()) {
      return false;
    }
    leaving_ = true;
    saved.asked = !plans_.free();
    saved.request = plans_.request();
    plans_.forget();
    follower.keep_path();
    follower.stop();
  }
  if (!follower.idle() || plans_.holds_forgotten()) {
    return false;
  }
  follower.reset(robot_.commanded());  // braking ends where the path ends; nothing of it was saved yet
  leaving_ = false;
  paths_[count_++] = follower.kept_path();
  saved.tool = robot_.tool.number();
  saved.ahead.clear();
  plans_.ahead().swap(saved.ahead);
  resuming_.forget_steps();
  plans_.disconnect();
  return true;
}

bool InterruptShelf::come_back(Fault& fault) noexcept {
  if (!group_.change_tool(saved_[count_ - 1].tool)) {
    return false;
  }
  if (!resuming_.is_near(path().q)) {
    fault = {ErrorCode::Away};
    return false;
  }
  resuming_.begin_from_interrupt(path().q);
  return true;
}

const InterruptShelf::Saved& InterruptShelf::restore() noexcept {
  Saved& saved = saved_[--count_];
  robot_.follower.set_kept_path(paths_[count_]);
  paths_[count_].pieces.count = 0;
  plans_.ahead().clear();
  plans_.ahead().swap(saved.ahead);
  plans_.set_request(saved.request);
  resuming_.forget_steps();
  return saved;
}

void InterruptShelf::end_come_back() noexcept {
  resuming_.cancel_way_back();
  resuming_.continue_on_path(restore().asked);
}

bool InterruptShelf::set_job_aside() noexcept {
  if (resuming_.way_back() == Resuming::Return::FromInterrupt) {
    const Saved& saved = restore();
    resuming_.set_aside(saved.tool, saved.asked);
  } else if (leaving_) {
    leaving_ = false;
    plans_.set_request(saved_[count_].request);
    resuming_.set_aside(robot_.tool.number(), saved_[count_].asked);
  } else {
    return false;
  }
  return true;
}

void InterruptShelf::drop() noexcept {
  leaving_ = false;
  for (; count_ > 0; --count_) {
    paths_[count_ - 1].pieces.count = 0;
    saved_[count_ - 1].ahead.clear();
  }
}

}  // namespace indurop::robot
