// SPDX-License-Identifier: Apache-2.0
// The arm of a node as a program of ROS serves it, as long as the node has its variables: joint states, feedback, the
// requests of clients. For one thread.

#pragma once

#include <indurop/result.h>

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/base/log.h"
#include "core/base/problem.h"
#include "doors/ros/arm/arm.h"
#include "doors/ros/arm/commands.h"
#include "doors/ros/arm/motions.h"
#include "doors/ros/arm/ros_types.h"
#include "doors/ros/model/joints.h"
#include "doors/ros/model/node.h"

namespace indurop::ros {

Motions::Time monotonic();

class ServedArm {
 public:
  using Time = Motions::Time;
  struct Choice {
    std::string group;      // namespace of its variables
    bool may_move = false;  // by clients
    std::vector<Joint> joints;
  };

  // All but the node are borrowed until the end, the node until this one's. Errors: the node has no such robot, or one
  // of another release.
  static Result<std::unique_ptr<ServedArm>, base::Problem> find(const Node& node, const Choice& choice,
                                                                RosClients& clients, const base::Log& log);
  ServedArm(const ServedArm&) = delete;
  ServedArm& operator=(const ServedArm&) = delete;

  // Reads the arm, follows what moves it, and publishes joint states if that is due.
  void serve(Time now, bool is_due);
  // Serves the arm while it waits, at most 5 s.
  RosReply run_service(RosService service);
  // The robot or this program is going.
  void abandon(const std::string& why);
  // What clients want of it; null: they may not move it.
  [[nodiscard]] Motions* motions() noexcept { return motions_ ? &*motions_ : nullptr; }

 private:
  ServedArm(Arm arm, const std::vector<Joint>& joints, RosClients& clients)
      : arm_(std::move(arm)), joints_(&joints), clients_(&clients) {}
  void publish_joints();
  void send_feedback(int goal);

  Arm arm_;
  const std::vector<Joint>* joints_;
  RosClients* clients_;
  std::optional<Commands> commands_;
  std::optional<Motions> motions_;
  Time next_feedback_{0};
};

// What clients want goes to the arm that there is now; without one it is rejected. All are borrowed until the end.
RosEvents events_of(const std::unique_ptr<ServedArm>& arm, RosClients& clients, const base::Log& log);

}  // namespace indurop::ros
