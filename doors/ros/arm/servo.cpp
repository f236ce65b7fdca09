// SPDX-License-Identifier: Apache-2.0
#include "doors/ros/arm/servo.h"

#include <fmt/format.h>

#include <cmath>

namespace indurop::ros {
namespace {
constexpr const char* kStreamReason = "set points of a ROS client";
}  // namespace

std::string Servo::move(const std::vector<double>& positions, Time now) {
  for (std::size_t axis = 0; axis < arm_->size(); ++axis) {
    const AxisNow& limits = arm_->axis(axis);
    if (!(positions[axis] >= limits.lower && positions[axis] <= limits.upper)) {
      return fmt::format("{:.3f} is not within the ends of axis {}, {:.3f} to {:.3f} (deg or mm)", positions[axis],
                         axis + 1, limits.lower, limits.upper);
    }
  }
  std::vector<Order> orders = {{0, static_cast<std::int32_t>(robot::Service::DirectAbsolute), 0, positions}};
  std::string wrong = commands_->send(orders, {}, kStreamReason);
  if (wrong.empty()) {
    active_ = true;
    last_ = now;
    order_ = orders.front();
  }
  return wrong;
}

void Servo::stop() {
  std::vector<Order> orders = {{0, static_cast<std::int32_t>(robot::Service::Halt)}};
  active_ = active_ && !commands_->send(orders, {}, kStreamReason).empty();
}

// An error ends the stream: the robot has refused a set point, or stopped.
void Servo::judge_last() {
  const OrderState state = commands_->state_of(order_);
  if (state.state == robot::CommandState::Error) {
    active_ = false;
    trouble_ = fmt::format("the robot refused a set point: {}", robot::to_string(state.error));
  }
}

bool Servo::step(Time now) {
  if (active_) {
    judge_last();
  }
  if (!active_ || now - last_ < stale_) {
    return false;
  }
  const bool has_arrived = commands_->state_of(order_).state == robot::CommandState::Done;
  if (has_arrived) {
    active_ = false;
    return false;
  }
  stop();
  return !active_;
}

}  // namespace indurop::ros
