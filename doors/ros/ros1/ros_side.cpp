// SPDX-License-Identifier: Apache-2.0
#include "doors/ros/ros1/ros_side.h"

#include <actionlib/server/action_server.h>
#include <control_msgs/FollowJointTrajectoryAction.h>
#include <ros/ros.h>
#include <sensor_msgs/JointState.h>
#include <std_srvs/Trigger.h>
#include <topic_tools/shape_shifter.h>
#include <trajectory_msgs/JointTrajectory.h>

#include <algorithm>
#include <map>
#include <optional>

namespace indurop::ros {
namespace {

using Action = control_msgs::FollowJointTrajectoryAction;
using ActionServer = actionlib::ActionServer<Action>;
using GoalHandle = ActionServer::GoalHandle;

constexpr unsigned kQueue = 10;

std::vector<RosTolerance> tolerances_in(const std::vector<control_msgs::JointTolerance>& from) {
  std::vector<RosTolerance> tolerances;
  for (const auto& one : from) {
    tolerances.push_back({one.name, one.position});
  }
  return tolerances;
}

RosGoal goal_in(const trajectory_msgs::JointTrajectory& trajectory) {
  RosGoal goal;
  goal.names = trajectory.joint_names;
  for (const auto& point : trajectory.points) {
    goal.points.push_back({point.time_from_start.toSec(), point.positions, point.velocities});
  }
  if (!trajectory.header.stamp.isZero()) {
    goal.start_in = (trajectory.header.stamp - ::ros::Time::now()).toSec();
  }
  return goal;
}

RosGoal goal_in(const control_msgs::FollowJointTrajectoryGoal& from) {
  RosGoal goal = goal_in(from.trajectory);
  goal.path = tolerances_in(from.path_tolerance);
  goal.goal = tolerances_in(from.goal_tolerance);
  goal.time_tolerance = from.goal_time_tolerance.toSec();
  return goal;
}

}  // namespace

struct RosSide::Parts {
  std::unique_ptr<::ros::NodeHandle> node;
  std::string run;  // of the master, by its parameter
  struct Topic {
    topic_tools::ShapeShifter message;
    ::ros::Publisher publisher;
  };
  std::vector<Topic> topics;
  ::ros::Publisher joints;
  ::ros::Subscriber command;
  std::vector<::ros::ServiceServer> services;
  std::unique_ptr<ActionServer> action;
  std::map<int, GoalHandle> goals;
  int last_goal = 0;
  RosEvents events;

  void add_service(const std::string& name, RosService service) {
    services.push_back(node->advertiseService<std_srvs::Trigger::Request, std_srvs::Trigger::Response>(
        name, [this, service](std_srvs::Trigger::Request& /*request*/, std_srvs::Trigger::Response& response) {
          const RosReply reply = events.service(service);
          response.success = static_cast<std::uint8_t>(reply.done);
          response.message = reply.text;
          return true;
        }));
  }
  int number_of(const GoalHandle& handle) const {
    const auto found = std::find_if(goals.begin(), goals.end(), [&](const auto& one) { return one.second == handle; });
    return found == goals.end() ? 0 : found->first;
  }
};

RosSide::RosSide(const std::string& name, const std::vector<std::string>& arguments)
    : parts_(std::make_unique<Parts>()) {
  std::vector<std::string> words = arguments;
  words.insert(words.begin(), name);
  std::vector<char*> pointers;
  for (std::string& word : words) {
    pointers.push_back(word.data());
  }
  int count = static_cast<int>(pointers.size());
  ::ros::init(count, pointers.data(), name, ::ros::init_options::NoSigintHandler);
}

RosSide::~RosSide() {
  parts_.reset();
  ::ros::shutdown();
}

bool RosSide::has_master() const {
  std::string run;
  return ::ros::master::check() && (parts_->run.empty() || (::ros::param::get("/run_id", run) && run == parts_->run));
}

std::string RosSide::master() const {
  return ::ros::master::getURI();
}

void RosSide::start() {
  parts_->node = std::make_unique<::ros::NodeHandle>();
  ::ros::param::get("/run_id", parts_->run);
}

void RosSide::spin() {
  ::ros::spinOnce();
}

std::size_t RosSide::add_topic(const std::string& name, const std::string& type, const std::string& definition,
                               const std::string& md5) {
  Parts::Topic& topic = parts_->topics.emplace_back();
  topic.message.morph(md5, type, definition, "1");
  topic.publisher = topic.message.advertise(*parts_->node, name, kQueue, true);
  return parts_->topics.size() - 1;
}

void RosSide::remove_topics() {
  parts_->topics.clear();
}

void RosSide::publish(std::size_t topic, const std::vector<std::uint8_t>& bytes) {
  Parts::Topic& to = parts_->topics[topic];
  std::vector<std::uint8_t> copy = bytes;
  ::ros::serialization::OStream stream(copy.data(), static_cast<std::uint32_t>(copy.size()));
  to.message.read(stream);
  to.publisher.publish(to.message);
}

void RosSide::add_arm(const std::string& controller, const std::string& urdf, bool may_move, RosEvents events) {
  Parts& parts = *parts_;
  parts.events = std::move(events);
  if (!parts.node->hasParam("robot_description")) {
    parts.node->setParam("robot_description", urdf);
  }
  parts.joints = parts.node->advertise<sensor_msgs::JointState>("joint_states", kQueue);
  if (!may_move) {
    return;
  }
  parts.command = parts.node->subscribe<trajectory_msgs::JointTrajectory>(
      controller + "/command", 1,
      [this](const trajectory_msgs::JointTrajectory::ConstPtr& asked) { parts_->events.set_points(goal_in(*asked)); });
  parts.action = std::make_unique<ActionServer>(
      *parts.node, controller + "/follow_joint_trajectory",
      [this](GoalHandle handle) {
        parts_->goals[++parts_->last_goal] = handle;
        parts_->events.goal(parts_->last_goal, goal_in(*handle.getGoal()));
      },
      [this](GoalHandle handle) {
        if (const int goal = parts_->number_of(handle); goal != 0) {
          parts_->events.cancel(goal);
        }
      },
      false);
  parts.action->start();
  parts.add_service(controller + "/enable", RosService::Enable);
  parts.add_service(controller + "/disable", RosService::Disable);
  parts.add_service(controller + "/reset", RosService::Reset);
}

void RosSide::publish_joints(const RosJoints& joints) {
  sensor_msgs::JointState state;
  state.header.stamp = ::ros::Time::now();
  state.name = joints.names;
  state.position = joints.positions;
  state.velocity = joints.velocities;
  state.effort = joints.efforts;
  parts_->joints.publish(state);
}

void RosSide::accept(int goal) {
  parts_->goals[goal].setAccepted();
}

void RosSide::feedback(int goal, const RosFeedback& feedback) {
  control_msgs::FollowJointTrajectoryFeedback message;
  message.header.stamp = ::ros::Time::now();
  message.joint_names = feedback.names;
  message.desired.positions = feedback.desired;
  message.actual.positions = feedback.actual;
  for (std::size_t i = 0; i < feedback.actual.size(); ++i) {
    message.error.positions.push_back(feedback.desired[i] - feedback.actual[i]);
  }
  parts_->goals[goal].publishFeedback(message);
}

void RosSide::finish(int goal, RosOutcome outcome, int code, const std::string& text) {
  GoalHandle handle = parts_->goals[goal];
  parts_->goals.erase(goal);
  control_msgs::FollowJointTrajectoryResult result;
  result.error_code = code;
  result.error_string = text;
  switch (outcome) {
    case RosOutcome::Rejected:
      handle.setRejected(result, text);
      return;
    case RosOutcome::Succeeded:
      handle.setSucceeded(result, text);
      return;
    case RosOutcome::Aborted:
      handle.setAborted(result, text);
      return;
    case RosOutcome::Cancelled:
      handle.setCanceled(result, text);
      return;
  }
}

}  // namespace indurop::ros
