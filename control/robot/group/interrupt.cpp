// SPDX-License-Identifier: Apache-2.0
// Interrupts of jobs: the state of the running job is saved while the job that was called moves the robot, and is
// restored when the robot has come back.

#include "control/robot/group/group.h"

namespace indurop::robot {

// Comes to rest as softly as the motion itself. While the motion is held it stays on its path, and the interrupt waits.
bool Group::step_aside() noexcept {
  Shelf& shelf = *shelf_;
  if (!shelf.leaving) {
    if (!follower_.idle() && follower_.at_rest()) {
      return false;
    }
    shelf.leaving = true;
    shelf.request_aside = !desk_.free();
    shelf.request = request_;
    desk_.forget();
    follower_.set_aside();
    follower_.stop();
  }
  if (!follower_.idle() || desk_.holds_forgotten()) {
    return false;
  }
  follower_.reset(commanded());  // braking ends where the path ends; nothing of it was saved yet
  shelf.leaving = false;
  shelf.used = true;
  shelf.path = follower_.path_aside();
  shelf.tool = tool_;
  shelf.ahead.clear();
  ahead_.swap(shelf.ahead);
  passed_known_ = 0;
  unconnected_ = true;
  return true;
}

const Joints* Group::left_at() const noexcept {
  return shelf_->used ? &shelf_->path.q : nullptr;
}

bool Group::come_back(Fault& fault) noexcept {
  const Shelf& shelf = *shelf_;
  if (!take_tool(shelf.tool)) {
    return false;
  }
  if (!is_near(shelf.path.q)) {
    fault = {ErrorCode::Away};
    return false;
  }
  return_ = Return::FromInterrupt;
  ask_for_way_back(shelf.path.q);
  return true;
}

// The interrupted job becomes the current one again, to be left or continued.
void Group::take_from_shelf() noexcept {
  Shelf& shelf = *shelf_;
  shelf.used = false;
  follower_.put_aside(shelf.path);
  ahead_.clear();
  ahead_.swap(shelf.ahead);
  request_ = shelf.request;
  request_aside_ = shelf.request_aside;
  passed_known_ = 0;
}

void Group::end_come_back() noexcept {
  return_ = Return::None;
  take_from_shelf();
  unconnected_ = true;
  follower_.go_on();
  last_command_ = commanded();
  if (request_aside_) {
    request_.follows = false;
    request_aside_ = false;
    ask_for_plan(request_);
  }
}

// Handles a stop on the way from or to the path. Returns false if it is on neither.
bool Group::set_shelf_aside() noexcept {
  if (return_ == Return::FromInterrupt) {
    aside_tool_ = shelf_->tool;
    take_from_shelf();
  } else if (shelf_->leaving) {
    shelf_->leaving = false;
    aside_tool_ = tool_;
    request_ = shelf_->request;
    request_aside_ = shelf_->request_aside;
  } else {
    return false;
  }
  aside_ = true;
  return true;
}

}  // namespace indurop::robot
