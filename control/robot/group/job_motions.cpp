// SPDX-License-Identifier: Apache-2.0
#include "control/robot/group/job_motions.h"

namespace indurop::robot {

// A hard stop keeps the limits of the joints, and not those of torques.
void JobMotions::halt() noexcept {
  if (robot_.tool.places().dynamics() == nullptr) {
    robot_.follower.stop_hard(correction_.path_share());
  } else {
    robot_.follower.stop();
  }
}

Fault JobMotions::move(const MoveCommand& command) noexcept {
  MoveCommand motion = command;
  motion.acceleration *= conveyor_.acceleration();
  plans_.ahead().add(motion);
  return {};
}

JobProgress JobMotions::progress() const noexcept {
  JobProgress now;
  now.kept = resuming_.aside();
  now.returns = resuming_.way_back() == Resuming::Return::ToPath && robot_.states.moving();
  if (now.kept) {
    now.source = robot_.states.stopping() ? robot_.follower.source() : resuming_.kept_source();
  } else if (shelf_.leaving() && robot_.follower.idle()) {
    now.source = shelf_.left_source();
  } else if (robot_.job.running()) {
    now.source = plans_.present_source();
  }
  return now;
}

Fault JobMotions::track(const BeltWay& way) noexcept {
  return {conveyor_.track({way.turns, way.belt - 1, way.origin, inverse_of(way.origin) * way.frame})};
}

bool JobMotions::ride(bool on_product, ErrorCode& error) noexcept {
  if (on_product && !conveyor_.product_moves()) {
    error = ErrorCode::Belt;
    return false;
  }
  return conveyor_.reaches(on_product, error);
}

double JobMotions::tip_speed() const noexcept {
  const Jacobian jacobian = robot_.tool.arm().jacobian(robot_.commanded());
  return (jacobian * robot_.axes.last_speed()).head<3>().norm();
}

bool JobMotions::begin_correction(const CorrectionWay& way) noexcept {
  if (!settled() || plans_.holds_forgotten()) {
    return false;
  }
  resuming_.forget_steps();
  correction_.begin(way);
  return true;
}

bool JobMotions::end_correction() noexcept {
  correction_.press({});
  if (!rests() || plans_.holds_forgotten()) {
    return false;
  }
  correction_.end();
  robot_.follower.reset(robot_.commanded());
  plans_.disconnect();
  resuming_.forget_steps();
  return true;
}

bool JobMotions::take_tool(int tool) noexcept {
  if (!settled() || plans_.holds_forgotten()) {
    return false;
  }
  if (tool != robot_.tool.number()) {
    robot_.tool.select(tool);
    torques_.reweigh();
  }
  return true;
}

bool JobMotions::take_load(int load) noexcept {
  if (!settled() || plans_.holds_forgotten()) {
    return false;
  }
  robot_.tool.select_load(load);
  torques_.reweigh();
  return true;
}

}  // namespace indurop::robot
