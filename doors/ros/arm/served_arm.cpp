// SPDX-License-Identifier: Apache-2.0
#include "doors/ros/arm/served_arm.h"

#include <algorithm>
#include <thread>
#include <utility>

#include "core/rt/clock.h"

namespace indurop::ros {
namespace {

using std::chrono::milliseconds;

constexpr milliseconds kServiceTurn{5};
constexpr milliseconds kFeedback{50};
constexpr std::chrono::seconds kServiceLimit{5};
constexpr const char* kNoNode = "the node does not run";

robot::Service service_of(RosService service) noexcept {
  switch (service) {
    case RosService::Enable:
      return robot::Service::GroupEnable;
    case RosService::Disable:
      return robot::Service::GroupDisable;
    case RosService::Reset:
      break;
  }
  return robot::Service::GroupReset;
}

MotionEvents motion_events(RosClients& clients, const base::Log& log) {
  return {[&clients](int goal) { clients.accept(goal); },
          [&clients, &log](int goal, RosOutcome outcome, int code, const std::string& text) {
            if (code != 0) {
              log.warning("goal {}: {}", goal, text);
            }
            clients.finish(goal, outcome, code, text);
          },
          [&log](const std::string& text) { log.warning("{}", text); }};
}

}  // namespace

Motions::Time monotonic() {
  return rt::MonoClock::now().time_since_epoch();
}

Result<std::unique_ptr<ServedArm>, base::Problem> ServedArm::find(const Node& node, const Choice& choice,
                                                                  RosClients& clients, const base::Log& log) {
  auto arm = Arm::find(node, choice.group);
  if (!arm) {
    return std::move(arm).error();
  }
  std::unique_ptr<ServedArm> served(new ServedArm(std::move(*arm), choice.joints, clients));
  if (!choice.may_move) {
    return served;
  }
  auto commands = Commands::find(node, choice.group);
  if (!commands) {
    return std::move(commands).error();
  }
  if (commands->tables() < choice.joints.size()) {
    return base::Problem{"MC_PROFILE has fewer tables than the arm has axes; use the plc_robot.glb of this release"};
  }
  served->commands_ = std::move(*commands);
  served->motions_.emplace(served->arm_, *served->commands_, choice.joints, motion_events(clients, log));
  return served;
}

void ServedArm::publish_joints() {
  RosJoints joints;
  bool has_torque = false;
  for (std::size_t i = 0; i < std::min(arm_.size(), joints_->size()); ++i) {
    const AxisNow& axis = arm_.axis(i);
    const Joint& joint = (*joints_)[i];
    joints.names.push_back(joint.name);
    joints.positions.push_back(axis.position * joint.unit);
    joints.velocities.push_back(axis.velocity * joint.unit);
    joints.efforts.push_back(axis.torque);
    has_torque = has_torque || axis.torque != 0;
  }
  if (!has_torque) {
    joints.efforts.clear();
  }
  clients_->publish_joints(joints);
}

void ServedArm::send_feedback(int goal) {
  RosFeedback feedback;
  for (std::size_t i = 0; i < std::min(arm_.size(), joints_->size()); ++i) {
    const Joint& joint = (*joints_)[i];
    feedback.names.push_back(joint.name);
    feedback.desired.push_back(arm_.axis(i).command * joint.unit);
    feedback.actual.push_back(arm_.axis(i).position * joint.unit);
  }
  clients_->feedback(goal, feedback);
}

void ServedArm::serve(Time now, bool is_due) {
  if (!arm_.read()) {
    return;
  }
  if (motions_) {
    motions_->step(now);
    if (const int goal = motions_->active(); goal != 0 && now >= next_feedback_) {
      next_feedback_ = now + kFeedback;
      send_feedback(goal);
    }
  }
  if (is_due) {
    publish_joints();
  }
}

RosReply ServedArm::run_service(RosService service) {
  if (!motions_) {
    return {false, "clients may not move the arm"};
  }
  if (std::string wrong = motions_->request(service_of(service)); !wrong.empty()) {
    return {false, std::move(wrong)};
  }
  for (const Time end = monotonic() + kServiceLimit; monotonic() < end;) {
    serve(monotonic(), false);
    if (auto ended = motions_->service_end()) {
      return {ended->empty(), ended->empty() ? std::string("done") : std::move(*ended)};
    }
    std::this_thread::sleep_for(kServiceTurn);
  }
  return {false, "it did not end within 5 s"};
}

void ServedArm::abandon(const std::string& why) {
  if (motions_) {
    motions_->abandon(why);
  }
}

RosEvents events_of(const std::unique_ptr<ServedArm>& arm, RosClients& clients, const base::Log& log) {
  const auto motions = [&arm] { return arm == nullptr ? nullptr : arm->motions(); };
  RosEvents events;
  events.goal = [motions, reject = motion_events(clients, log).ended](int goal, const RosGoal& asked) {
    if (Motions* const all = motions()) {
      all->want(goal, asked, monotonic());
    } else {
      reject(goal, RosOutcome::Rejected, static_cast<int>(GoalCode::InvalidGoal), kNoNode);
    }
  };
  events.cancel = [motions](int goal) {
    if (Motions* const all = motions()) {
      all->cancel(goal);
    }
  };
  events.set_points = [motions](const RosGoal& asked) {
    if (Motions* const all = motions()) {
      all->set_points(asked, monotonic());
    }
  };
  events.service = [&arm](RosService service) {
    return arm == nullptr ? RosReply{false, kNoNode} : arm->run_service(service);
  };
  return events;
}

}  // namespace indurop::ros
