// SPDX-License-Identifier: Apache-2.0
#include "doors/ros/ros2/action.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "core/rt/clock.h"
#include "doors/ros/ros2/message.h"
#include "network/dds/lent.h"

namespace indurop::ros {
namespace {

using GoalInfo = action_msgs_msg_dds__GoalInfo_;
using Uuid = unique_identifier_msgs_msg_dds__UUID_;

GoalId id_in(const Uuid& uuid) noexcept {
  GoalId id{};
  std::copy(std::begin(uuid.uuid), std::end(uuid.uuid), id.begin());
  return id;
}

Uuid uuid_of(const GoalId& id) noexcept {
  Uuid uuid{};
  std::copy(id.begin(), id.end(), std::begin(uuid.uuid));
  return uuid;
}

GoalInfo info_of(const Goal& goal) noexcept {
  return {uuid_of(goal.id), ros_time(goal.stamp_ns)};
}

GoalStatus status_of(RosOutcome outcome) noexcept {
  switch (outcome) {
    case RosOutcome::Succeeded:
      return GoalStatus::Succeeded;
    case RosOutcome::Cancelled:
      return GoalStatus::Canceled;
    case RosOutcome::Aborted:
    case RosOutcome::Rejected:
      break;
  }
  return GoalStatus::Aborted;
}

}  // namespace

Result<void, base::Problem> TrajectoryAction::open(Ros2Participant& participant, const std::string& name,
                                                   const RosEvents& events) {
  events_ = &events;
  const std::string inside = name + "/_action/";
  if (auto opened = send_goal_.open(participant, inside + "send_goal"); !opened) {
    return opened;
  }
  if (auto opened = cancel_.open(participant, inside + "cancel_goal"); !opened) {
    return opened;
  }
  if (auto opened = get_result_.open(participant, inside + "get_result"); !opened) {
    return opened;
  }
  auto feedback = participant.publisher<FeedbackMessage>(inside + "feedback");
  auto states = participant.publisher<StatusMessage>(inside + "status", {1, true});
  for (auto* const made : {&feedback, &states}) {
    if (!*made) {
      return std::move(*made).error();
    }
  }
  feedback_ = std::move(*feedback);
  states_ = std::move(*states);
  publish_states();
  return {};
}

void TrajectoryAction::spin(Time now) {
  send_goal_.take([&](const SendGoalRequest& request, const Caller& caller) { take_goal(request, caller, now); });
  cancel_.take([&](const CancelRequest& request, const Caller& caller) { take_cancel(request, caller, now); });
  get_result_.take(
      [&](const GetResultRequest& request, const Caller& caller) { take_result_request(request, caller, now); });
  send_goal_.step(now);
  cancel_.step(now);
  get_result_.step(now);
}

void TrajectoryAction::take_goal(const SendGoalRequest& request, const Caller& caller, Time now) {
  const Goal* const goal = goals_.add(id_in(request.goal_id));
  if (goal == nullptr) {
    answer_goal(caller, false, 0, now);
    return;
  }
  const int number = goal->number;
  asking_[number] = caller;
  RosGoal asked = goal_in(request.goal, rt::wall_ns());
  if (request.goal.multi_dof_trajectory.points._length > 0) {
    asked.names.clear();  // no joint of the arm has several degrees of freedom: rejected, as with other wrong names
  }
  events_->goal(number, asked);
}

void TrajectoryAction::answer_goal(const Caller& caller, bool accepted, std::int64_t stamp_ns, Time now) {
  send_goal_.reply(
      caller,
      [accepted, stamp_ns](SendGoalReply& reply) {
        reply.accepted = accepted;
        reply.stamp = ros_time(stamp_ns);
      },
      now);
}

void TrajectoryAction::accept(int goal, Time now) {
  Goal* const accepted = goals_.find(goal);
  const auto asking = asking_.find(goal);
  if (accepted == nullptr || asking == asking_.end()) {
    return;
  }
  accepted->stamp_ns = rt::wall_ns();
  accepted->status = GoalStatus::Executing;
  answer_goal(asking->second, true, accepted->stamp_ns, now);
  asking_.erase(asking);
  publish_states();
}

void TrajectoryAction::feedback(int goal, const RosFeedback& feedback) {
  const Goal* const of = goals_.find(goal);
  if (of == nullptr) {
    return;
  }
  MessageMemory memory;
  std::vector<double> error;
  const FeedbackMessage message{uuid_of(of->id), feedback_message(feedback, rt::wall_ns(), memory, error)};
  (void)dds::write(feedback_.get(), message);
}

void TrajectoryAction::finish(int goal, RosOutcome outcome, int code, const std::string& text, Time now) {
  Goal* const ended = goals_.find(goal);
  if (ended == nullptr) {
    return;
  }
  if (const auto asking = asking_.find(goal); asking != asking_.end()) {
    answer_goal(asking->second, false, 0, now);
    asking_.erase(asking);
    ended->status = GoalStatus::Unknown;
  } else {
    ended->status = status_of(outcome);
  }
  ended->code = code;
  ended->text = text;
  const auto [first, last] = awaiting_.equal_range(goal);
  std::for_each(first, last, [&](const auto& one) { send_result(one.second, *ended, now); });
  awaiting_.erase(first, last);
  if (ended->status == GoalStatus::Unknown) {
    goals_.remove(goal);
    return;
  }
  goals_.tidy();
  publish_states();
}

void TrajectoryAction::take_cancel(const CancelRequest& request, const Caller& caller, Time now) {
  const GoalBook::Chosen chosen =
      goals_.chosen_to_cancel(id_in(request.goal_info.goal_id), ns_of(request.goal_info.stamp));
  std::vector<GoalInfo> infos;
  std::vector<int> numbers;
  for (Goal* const goal : chosen.goals) {
    infos.push_back(info_of(*goal));
    numbers.push_back(goal->number);
    goal->status = goal->status == GoalStatus::Unknown ? GoalStatus::Unknown : GoalStatus::Canceling;
  }
  cancel_.reply(
      caller,
      [code = chosen.code, infos](CancelReply& reply) mutable {
        reply.return_code = static_cast<std::int8_t>(code);
        reply.goals_canceling._length = reply.goals_canceling._maximum = static_cast<std::uint32_t>(infos.size());
        reply.goals_canceling._buffer = infos.data();
      },
      now);
  if (!numbers.empty()) {
    publish_states();
  }
  for (const int number : numbers) {
    events_->cancel(number);
  }
}

void TrajectoryAction::take_result_request(const GetResultRequest& request, const Caller& caller, Time now) {
  const Goal* const goal = goals_.find(id_in(request.goal_id));
  if (goal != nullptr && !has_ended(goal->status)) {
    awaiting_.emplace(goal->number, caller);
    return;
  }
  send_result(caller, goal == nullptr ? Goal{} : *goal, now);
}

void TrajectoryAction::send_result(const Caller& caller, const Goal& goal, Time now) {
  get_result_.reply(
      caller,
      [goal](GetResultReply& reply) {
        reply.status = static_cast<std::int8_t>(goal.status);
        reply.result.error_code = goal.code;
        reply.result.error_string = dds::lent(goal.text);
      },
      now);
}

void TrajectoryAction::publish_states() {
  std::vector<action_msgs_msg_dds__GoalStatus_> states;
  for (const Goal* const goal : goals_.shown()) {
    states.push_back({info_of(*goal), static_cast<std::int8_t>(goal->status)});
  }
  StatusMessage message{};
  message.status_list._length = message.status_list._maximum = static_cast<std::uint32_t>(states.size());
  message.status_list._buffer = states.data();
  (void)dds::write(states_.get(), message);
}

}  // namespace indurop::ros
