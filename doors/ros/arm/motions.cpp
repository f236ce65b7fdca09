// SPDX-License-Identifier: Apache-2.0
#include "doors/ros/arm/motions.h"

#include <fmt/format.h>

#include <utility>

namespace indurop::ros {
namespace {

constexpr std::chrono::milliseconds kStale{200};
constexpr double kAhead = 0.1;  // s, of the velocities of a set point

Motions::Time seconds(double time) {
  return std::chrono::duration_cast<Motions::Time>(std::chrono::duration<double>(time));
}

}  // namespace

Motions::Motions(Arm& arm, Commands& commands, const std::vector<Joint>& joints, MotionEvents events)
    : arm_(&arm),
      commands_(&commands),
      joints_(&joints),
      events_(std::move(events)),
      follower_(arm, commands),
      servo_(arm, commands, kStale) {}

void Motions::end(int goal, RosOutcome outcome, GoalCode code, const std::string& text) {
  if (goal != kNoGoal) {
    events_.ended(goal, outcome, static_cast<int>(code), text);
  } else if (outcome == RosOutcome::Rejected || outcome == RosOutcome::Aborted) {
    events_.trouble(text);
  }
}

void Motions::want(int goal, const RosGoal& asked, Time now) {
  const double last = asked.points.empty() ? 0 : asked.points.back().time;
  if (asked.start_in + last < 0) {
    end(goal, RosOutcome::Rejected, GoalCode::OldHeader, "the trajectory ends in the past, by the stamp of its header");
    return;
  }
  if (next_) {
    end(next_->goal, RosOutcome::Rejected, GoalCode::InvalidGoal, "a later goal replaced it before it began");
  }
  next_ = Wanted{goal, asked, now + seconds(std::max(0.0, asked.start_in))};
  follower_.cancel();
  if (!follower_.is_busy() && now >= next_->begin) {
    begin(*std::exchange(next_, std::nullopt), now);
  }
}

void Motions::cancel(int goal) {
  if (next_ && next_->goal == goal) {
    next_.reset();
    end(goal, RosOutcome::Cancelled, GoalCode::Successful, "cancelled before it began");
  } else if (active_ == goal && goal != kNoGoal) {
    follower_.cancel();
  }
}

std::string Motions::obstacle(Arm::Locked locked) const {
  std::string why = arm_->obstacle(locked);
  // The number of axes is known once the robot task has started.
  return !why.empty() || arm_->size() == joints_->size()
             ? why
             : fmt::format("the URDF has {} joints, the robot {} axes", joints_->size(), arm_->size());
}

GoalProblem Motions::try_to_begin(const RosGoal& asked, Time now) {
  arm_->read();
  if (std::string why = obstacle(Arm::Locked::ToTime); !why.empty()) {
    return {GoalCode::InvalidGoal, std::move(why)};
  }
  if (!arm_->stands()) {
    return {GoalCode::InvalidGoal, "an axis moves, or has no power"};
  }
  const auto axes = axes_goal(asked, *joints_);
  if (!axes) {
    return axes.error();
  }
  const auto plan = plan_trajectory(axes->points, arm_->axes());
  if (!plan) {
    return {GoalCode::InvalidGoal, plan.error().text};
  }
  note_.clear();
  if (plan->slowest >= 0) {
    note_ = fmt::format("it took {:.2f} times as long, for the limits of axis {}", plan->stretch, plan->slowest + 1);
    if (asked.time_tolerance > 0 && plan->duration > asked.points.back().time + asked.time_tolerance) {
      return {GoalCode::InvalidGoal, fmt::format("axis {} is too slow: {:.3f} s are needed instead of {:.3f} s",
                                                 plan->slowest + 1, plan->duration, asked.points.back().time)};
    }
  }
  return {GoalCode::InvalidGoal, follower_.begin(*plan, axes->tolerances, now)};
}

void Motions::begin(const Wanted& wanted, Time now) {
  const GoalProblem problem = try_to_begin(wanted.asked, now);
  if (!problem.text.empty()) {
    end(wanted.goal, RosOutcome::Rejected, problem.code, problem.text);
    return;
  }
  active_ = wanted.goal;
  if (active_ != kNoGoal) {
    events_.accepted(active_);
  }
}

void Motions::set_points(const RosGoal& asked, Time now) {
  if (asked.points.size() > 1) {
    want(kNoGoal, asked, now);
    return;
  }
  if (follower_.is_busy()) {
    if (asked.points.empty()) {
      follower_.cancel();
    } else {
      events_.trouble("a set point was ignored: a trajectory is being followed");
    }
    return;
  }
  if (asked.points.empty()) {
    servo_.stop();
    return;
  }
  const auto positions = axes_ahead(asked, *joints_, kAhead);
  std::string why = positions ? std::string() : positions.error().text;
  if (why.empty() && (!servo_.is_active() || arm_->size() != joints_->size())) {
    why = obstacle(Arm::Locked::No);
  }
  if (why.empty()) {
    why = servo_.move(*positions, now);
  }
  if (!why.empty()) {
    events_.trouble(fmt::format("a set point was ignored: {}", why));
  }
}

std::string Motions::request(robot::Service service) {
  arm_->read();
  if (arm_->size() == 0) {
    return "the robot task has not started yet; repeat it";
  }
  std::vector<Order> orders = {{0, static_cast<std::int32_t>(service)}};
  std::string wrong = commands_->send(orders, {}, "service of a ROS client");
  service_ = orders.front();
  return wrong;
}

std::optional<std::string> Motions::service_end() const {
  const OrderState now = commands_->state_of(service_);
  switch (now.state) {
    case robot::CommandState::Done:
      return std::string();
    case robot::CommandState::Aborted:
      return std::string(kNotExecuted);
    case robot::CommandState::Error:
      return std::string(robot::to_string(now.error));
    default:
      return std::nullopt;
  }
}

void Motions::step(Time now) {
  commands_->read();
  if (const auto end_of_goal = follower_.step(now)) {
    const int goal = std::exchange(active_, kNoGoal);
    const bool succeeded = end_of_goal->code == GoalCode::Successful && !end_of_goal->cancelled;
    end(goal,
        end_of_goal->cancelled ? RosOutcome::Cancelled
        : succeeded            ? RosOutcome::Succeeded
                               : RosOutcome::Aborted,
        end_of_goal->code, succeeded && !note_.empty() ? end_of_goal->text + "; " + note_ : end_of_goal->text);
  }
  if (servo_.step(now)) {
    events_.trouble("no set point came for 200 ms; the arm comes to rest");
  }
  if (std::string why = servo_.take_trouble(); !why.empty()) {
    events_.trouble(why);
  }
  if (next_ && !follower_.is_busy() && now >= next_->begin) {
    begin(*std::exchange(next_, std::nullopt), now);
  }
}

void Motions::abandon(const std::string& why) {
  follower_.cancel();
  servo_.stop();
  if (next_) {
    end(next_->goal, RosOutcome::Rejected, GoalCode::InvalidGoal, why);
    next_.reset();
  }
  if (const int goal = std::exchange(active_, kNoGoal); goal != kNoGoal) {
    end(goal, RosOutcome::Aborted, GoalCode::PathTolerance, why);
  }
}

}  // namespace indurop::ros
