// SPDX-License-Identifier: Apache-2.0
#include "doors/ros/arm/follower.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace indurop::ros {
namespace {

constexpr const char* kReason = "trajectory of a ROS client";
constexpr double kAtRest = 0.1;  // deg/s or mm/s, measured

}  // namespace

std::string Follower::begin(const TrajectoryPlan& plan, const GoalTolerances& tolerances, Time now) {
  orders_.clear();
  target_.clear();
  for (std::size_t axis = 0; axis < plan.tables.size(); ++axis) {
    const robot::ProfileTable& table = plan.tables[axis];
    const int number = static_cast<int>(axis) + 1;
    orders_.push_back(
        {number, static_cast<std::int32_t>(robot::AxisService::PositionProfile), number, {plan.stretch, 1, 0}});
    target_.push_back(table.value[static_cast<std::size_t>(table.points) - 1]);
  }
  if (std::string wrong = commands_->send(orders_, plan.tables, kReason); !wrong.empty()) {
    return wrong;
  }
  tolerances_ = tolerances;
  settled_by_ = now + std::chrono::duration_cast<Time>(std::chrono::duration<double>(plan.duration)) + tolerances.time;
  end_ = {};
  phase_ = Phase::Moves;
  return {};
}

void Follower::halt() {
  halts_.clear();
  for (const Order& order : orders_) {
    halts_.push_back({order.axis, static_cast<std::int32_t>(robot::AxisService::Halt)});
  }
  is_halted_ = commands_->send(halts_, {}, kReason).empty();
  phase_ = Phase::Stops;
}

void Follower::cancel() {
  if (phase_ == Phase::Moves || phase_ == Phase::Settles) {
    end_.cancelled = true;
    end_.text = "cancelled; the arm stands";
    halt();
  }
}

void Follower::end_with(GoalCode code, std::string text) {
  end_.code = code;
  end_.text = std::move(text);
  halt();
}

// Returns the axis that is farther away than it may be, from 0; negative: none.
int Follower::beyond(const std::vector<double>& tolerances, bool at_goal) const {
  for (std::size_t axis = 0; axis < std::min(tolerances.size(), arm_->size()); ++axis) {
    const AxisNow& now = arm_->axis(axis);
    const double distance = std::abs(now.position - (at_goal ? target_[axis] : now.command));
    if (tolerances[axis] > 0 && distance > tolerances[axis]) {
      return static_cast<int>(axis);
    }
  }
  return -1;
}

void Follower::watch(Time now) {
  std::size_t done = 0;
  for (const Order& order : orders_) {
    const OrderState state = commands_->state_of(order);
    if (state.state == robot::CommandState::Aborted || state.state == robot::CommandState::Error) {
      const std::string obstacle = arm_->obstacle(Arm::Locked::ToTime);
      end_with(state.state == robot::CommandState::Error && state.error != robot::ErrorCode::State
                   ? GoalCode::InvalidGoal
                   : GoalCode::PathTolerance,
               fmt::format("axis {}: {}{}{}", order.axis,
                           state.error == robot::ErrorCode::Ok ? kNotExecuted : robot::to_string(state.error),
                           obstacle.empty() ? "" : "; ", obstacle));
      return;
    }
    done += state.state == robot::CommandState::Done ? 1 : 0;
  }
  if (const int axis = beyond(tolerances_.path, false); axis >= 0) {
    end_with(GoalCode::PathTolerance, fmt::format("axis {} is farther from its path than the tolerance", axis + 1));
    return;
  }
  if (done == orders_.size()) {
    phase_ = Phase::Settles;
    settled_by_ = std::max(settled_by_, now);
  }
}

std::optional<GoalEnd> Follower::settle(Time now) {
  bool rests = arm_->stands();
  for (std::size_t axis = 0; axis < arm_->size(); ++axis) {
    rests = rests && std::abs(arm_->axis(axis).velocity) < kAtRest;
  }
  const int axis = beyond(tolerances_.goal, true);
  if (rests && axis < 0) {
    phase_ = Phase::Idle;
    return GoalEnd{GoalCode::Successful, false, "the arm stands at the last point"};
  }
  if (now > settled_by_) {
    phase_ = Phase::Idle;
    return GoalEnd{GoalCode::GoalTolerance, false,
                   axis < 0 ? std::string("the arm is not at rest in time")
                            : fmt::format("axis {} is farther from the last point than the tolerance", axis + 1)};
  }
  return std::nullopt;
}

bool Follower::has_stopped() const {
  const auto moves = [](const AxisNow& axis) {
    return axis.state == robot::AxisState::DiscreteMotion || axis.state == robot::AxisState::ContinuousMotion ||
           axis.state == robot::AxisState::Stopping;
  };
  return std::none_of(arm_->axes().begin(), arm_->axes().end(), moves) &&
         std::all_of(halts_.begin(), halts_.end(), [this](const Order& order) {
           return commands_->state_of(order).state >= robot::CommandState::Done;
         });
}

std::optional<GoalEnd> Follower::step(Time now) {
  if (phase_ == Phase::Moves) {
    watch(now);
  }
  if (phase_ == Phase::Settles) {
    return settle(now);
  }
  if (phase_ == Phase::Stops && !is_halted_) {
    halt();
  } else if (phase_ == Phase::Stops && has_stopped()) {
    phase_ = Phase::Idle;
    return end_;
  }
  return std::nullopt;
}

}  // namespace indurop::ros
