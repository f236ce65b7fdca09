// SPDX-License-Identifier: Apache-2.0
#include "doors/ros/ros1/door.h"

#include <algorithm>
#include <utility>

#include "core/base/name_patterns.h"
#include "core/schema/ros_name.h"

namespace indurop::ros {
namespace {

using std::chrono::milliseconds;

constexpr milliseconds kTurn{5};
constexpr milliseconds kWait{300};
constexpr std::chrono::seconds kMasterCheck{2};
constexpr const char* kRosTopicRoot = "rt/";

}  // namespace

Ros1Door::Ros1Door(Ros1Options options, ArmFile arm)
    : options_(std::move(options)),
      choice_{options_.arm.robot, options_.arm.move, std::move(arm.joints)},
      urdf_(std::move(arm.text)),
      log_("indurop-ros1", options_.arm.node.empty() ? "local" : options_.arm.node, options_.arm.quiet),
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

Result<void, base::Problem> Ros1Door::begin() {
  auto node = Node::open(options_.arm.node, options_.arm.move);
  if (!node) {
    return std::move(node).error();
  }
  auto session = std::make_unique<Session>(std::move(*node));
  if (!choice_.joints.empty()) {
    auto arm = ServedArm::find(session->node, choice_, ros_, log_);
    if (!arm) {
      return std::move(arm).error();
    }
    arm_ = std::move(*arm);
  }
  ros_.remove_topics();
  add_topics(*session);
  session_ = std::move(session);
  log_.info("node {}: {} variables{}", session_->node.name(), session_->topics.size(),
            arm_ == nullptr     ? ""
            : options_.arm.move ? ", and the arm, which clients may move"
                                : ", and the arm");
  return {};
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

void Ros1Door::end(const std::string& why) {
  if (arm_) {
    arm_->abandon(why);
  }
  arm_.reset();
  session_.reset();
}

Result<void, base::Problem> Ros1Door::run(base::StopSignal& stop) {
  while (!ros_.has_master()) {
    if (!wait_for(stop, "no master at " + ros_.master() + "; start rosmaster, or set ROS_MASTER_URI")) {
      return {};
    }
  }
  ros_.start();
  if (!choice_.joints.empty()) {
    ros_.add_arm(options_.arm.controller, urdf_, options_.arm.move, events_of(arm_, ros_, log_));
  }
  const Time period(static_cast<std::int64_t>(1e9 / options_.arm.rate_hz));
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
    if (arm_) {
      arm_->serve(now, is_due);
    }
    if (is_due) {
      publish_values();
    }
    if (!session_->node.runs()) {
      end("the node has ended, or has other variables");
    }
  }
  end("indurop-ros1 has ended");
  return {};
}

}  // namespace indurop::ros
