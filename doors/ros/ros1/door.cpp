// SPDX-License-Identifier: Apache-2.0
#include "doors/ros/ros1/door.h"

#include <algorithm>
#include <thread>
#include <utility>

#include "core/base/name_patterns.h"
#include "core/rt/clock.h"
#include "core/schema/ros_name.h"

namespace indurop::ros {
namespace {

using std::chrono::milliseconds;

constexpr milliseconds kTurn{5};
constexpr milliseconds kWait{300};
constexpr milliseconds kFeedback{50};
constexpr std::chrono::seconds kMasterCheck{2};
constexpr std::chrono::seconds kServiceLimit{5};
constexpr const char* kRosTopicRoot = "rt/";

Motions::Time monotonic() {
  return rt::MonoClock::now().time_since_epoch();
}

}  // namespace

Ros1Door::Ros1Door(Ros1Options options, std::vector<Joint> joints, std::string urdf_text)
    : options_(std::move(options)),
      joints_(std::move(joints)),
      urdf_text_(std::move(urdf_text)),
      log_("indurop-ros1", options_.node.empty() ? "local" : options_.node, options_.quiet),
      ros_("indurop", options_.arguments) {}

// Returns false after a signal. What is waited for is said once.
bool Ros1Door::wait_for(base::StopSignal& stop, const std::string& what) {
  if (what != waited_for_) {
    log_.info("waits: {}", what);
  }
  waited_for_ = what;
  return stop.wait(kWait) == 0;
}

void Ros1Door::add_topics(Session& session) {
  for (const std::string& name : session.node.variables()) {
    if (!base::matches_any(options_.variables, name)) {
      continue;
    }
    auto variable = Variable::find(session.node, name);
    if (!variable) {
      continue;
    }
    const MessageType type = message_type(name, variable->layout());
    const std::string topic = schema::ros_topic(name);
    const std::size_t number =
        ros_.add_topic(topic.substr(std::string(kRosTopicRoot).size()), type.name, type.definition, type.md5);
    session.topics.push_back({std::move(*variable), number, {}});
  }
  if (session.topics.empty() && !options_.variables.empty()) {
    log_.warning("no variable of the node matches --variables; names are full ones, such as 'PLC_ROBOT::*'");
  }
}

Result<void, base::Problem> Ros1Door::find_arm(Session& session) {
  auto arm = Arm::find(session.node, options_.robot);
  if (!arm) {
    return std::move(arm).error();
  }
  session.arm = std::move(*arm);
  if (!options_.move) {
    return {};
  }
  auto commands = Commands::find(session.node, options_.robot);
  if (!commands) {
    return std::move(commands).error();
  }
  if (commands->tables() < joints_.size()) {
    return base::Problem{"MC_PROFILE has fewer tables than the arm has axes; use the plc_robot.glb of this release"};
  }
  session.commands = std::move(*commands);
  session.motions.emplace(*session.arm, *session.commands, joints_, motion_events());
  return {};
}

Result<void, base::Problem> Ros1Door::begin() {
  auto node = Node::open(options_.node, options_.move);
  if (!node) {
    return std::move(node).error();
  }
  if (!node->runs()) {
    return base::Problem{"the node has ended"};
  }
  auto session = std::make_unique<Session>(std::move(*node));
  if (!joints_.empty()) {
    if (auto found = find_arm(*session); !found) {
      return found;
    }
  }
  ros_.remove_topics();
  add_topics(*session);
  session_ = std::move(session);
  log_.info("node {}: {} variables{}", session_->node.name(), session_->topics.size(),
            joints_.empty() ? ""
            : options_.move ? ", and the arm, which clients may move"
                            : ", and the arm");
  return {};
}

MotionEvents Ros1Door::motion_events() {
  return {[this](int goal) { ros_.accept(goal); },
          [this](int goal, RosOutcome outcome, int code, const std::string& text) {
            if (code != 0) {
              log_.warning("goal {}: {}", goal, text);
            }
            ros_.finish(goal, outcome, code, text);
          },
          [this](const std::string& text) { log_.warning("{}", text); }};
}

RosEvents Ros1Door::ros_events() {
  RosEvents events;
  events.goal = [this](int goal, const RosGoal& asked) {
    if (session_ && session_->motions) {
      session_->motions->want(goal, asked, monotonic());
    } else {
      ros_.finish(goal, RosOutcome::Rejected, static_cast<int>(GoalCode::InvalidGoal), "the node does not run");
    }
  };
  events.cancel = [this](int goal) {
    if (session_ && session_->motions) {
      session_->motions->cancel(goal);
    }
  };
  events.set_points = [this](const RosGoal& asked) {
    if (session_ && session_->motions) {
      session_->motions->set_points(asked, monotonic());
    }
  };
  events.service = [this](RosService service) { return run_service(service); };
  return events;
}

// Serves the arm while it waits.
RosReply Ros1Door::run_service(RosService service) {
  if (!session_ || !session_->motions) {
    return {false, "the node does not run"};
  }
  const auto code = service == RosService::Enable    ? robot::Service::GroupEnable
                    : service == RosService::Disable ? robot::Service::GroupDisable
                                                     : robot::Service::GroupReset;
  if (std::string wrong = session_->motions->request(code); !wrong.empty()) {
    return {false, std::move(wrong)};
  }
  for (const Time end = monotonic() + kServiceLimit; monotonic() < end;) {
    serve_arm(monotonic(), false);
    if (auto ended = session_->motions->service_end()) {
      return {ended->empty(), ended->empty() ? std::string("done") : std::move(*ended)};
    }
    std::this_thread::sleep_for(kTurn);
  }
  return {false, "it did not end within 5 s"};
}

void Ros1Door::publish_joints(const Arm& arm) {
  RosJoints joints;
  bool has_torque = false;
  for (std::size_t i = 0; i < std::min(arm.size(), joints_.size()); ++i) {
    const AxisNow& axis = arm.axis(i);
    joints.names.push_back(joints_[i].name);
    joints.positions.push_back(axis.position * joints_[i].unit);
    joints.velocities.push_back(axis.velocity * joints_[i].unit);
    joints.efforts.push_back(axis.torque);
    has_torque = has_torque || axis.torque != 0;
  }
  if (!has_torque) {
    joints.efforts.clear();
  }
  ros_.publish_joints(joints);
}

void Ros1Door::serve_arm(Time now, bool is_due) {
  Arm& arm = *session_->arm;
  if (!arm.read()) {
    return;
  }
  if (session_->motions) {
    session_->motions->step(now);
    if (const int goal = session_->motions->active(); goal != 0 && now >= next_feedback_) {
      next_feedback_ = now + kFeedback;
      RosFeedback feedback;
      for (std::size_t i = 0; i < std::min(arm.size(), joints_.size()); ++i) {
        feedback.names.push_back(joints_[i].name);
        feedback.desired.push_back(arm.axis(i).command * joints_[i].unit);
        feedback.actual.push_back(arm.axis(i).position * joints_[i].unit);
      }
      ros_.feedback(goal, feedback);
    }
  }
  if (is_due) {
    publish_joints(arm);
  }
}

void Ros1Door::publish_values() {
  std::vector<std::uint8_t> message;
  for (Topic& topic : session_->topics) {
    const auto bytes = topic.variable.bytes();
    if (!topic.variable.read() ||
        std::equal(bytes.begin(), bytes.end(), topic.published.begin(), topic.published.end())) {
      continue;
    }
    topic.published.assign(bytes.begin(), bytes.end());
    message.clear();
    write_message(topic.variable.layout(), bytes, message);
    ros_.publish(topic.number, message);
  }
}

Result<void, base::Problem> Ros1Door::run(base::StopSignal& stop) {
  while (!ros_.has_master()) {
    if (!wait_for(stop, "no master at " + ros_.master() + "; start rosmaster, or set ROS_MASTER_URI")) {
      return {};
    }
  }
  ros_.start();
  if (!joints_.empty()) {
    ros_.add_arm(options_.controller, urdf_text_, options_.move, ros_events());
  }
  const Time period(static_cast<std::int64_t>(1e9 / options_.rate_hz));
  while (stop.wait(kTurn) == 0) {
    if (!session_) {
      ros_.spin();  // what was wanted while the node is away is rejected now, and not executed when it is back
      if (const auto begun = begin(); !begun && !wait_for(stop, begun.error().text)) {
        break;
      }
      continue;
    }
    const Time now = monotonic();
    if (now >= next_check_ && !ros_.has_master()) {
      return base::Problem{"the master at " + ros_.master() + " has ended, or is another one now"};
    }
    next_check_ = now >= next_check_ ? now + kMasterCheck : next_check_;
    ros_.spin();
    const bool is_due = now >= next_;
    next_ = is_due ? std::max(next_ + period, now) : next_;
    if (session_->arm) {
      serve_arm(now, is_due);
    }
    if (is_due) {
      publish_values();
    }
    if (!session_->node.runs()) {
      if (session_->motions) {
        session_->motions->abandon("the node has ended, or has other variables");
      }
      session_.reset();
    }
  }
  if (session_ && session_->motions) {
    session_->motions->abandon("indurop-ros1 has ended");
  }
  return {};
}

}  // namespace indurop::ros
