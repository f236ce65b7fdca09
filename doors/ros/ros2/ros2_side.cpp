// SPDX-License-Identifier: Apache-2.0
#include "doors/ros/ros2/ros2_side.h"

#include <utility>

#include "core/rt/clock.h"
#include "doors/ros/arm/served_arm.h"
#include "doors/ros/ros2/message.h"
#include "network/dds/lent.h"

namespace indurop::ros {

Result<void, base::Problem> Ros2Side::add_controller(const std::string& controller) {
  // As a controller of ros2_control: of set points that come faster than they are read, the last one counts.
  auto trajectories = participant_.subscription<TrajectoryMessage>(controller + "/joint_trajectory", {1, false});
  if (!trajectories) {
    return std::move(trajectories).error();
  }
  trajectories_ = std::move(*trajectories);
  if (auto opened = action_.open(participant_, controller + "/follow_joint_trajectory", events_); !opened) {
    return opened;
  }
  for (const auto& [name, service] :
       {std::pair("/enable", RosService::Enable), std::pair("/disable", RosService::Disable),
        std::pair("/reset", RosService::Reset)}) {
    Power& power = power_.emplace_back(Power{service, {}});
    if (auto opened = power.ends.open(participant_, controller + name); !opened) {
      return opened;
    }
  }
  return {};
}

Result<void, base::Problem> Ros2Side::add_arm(const std::string& controller, const std::string& urdf,
                                              RosEvents events) {
  events_ = std::move(events);
  auto joints = participant_.publisher<JointStateMessage>("joint_states");
  auto description = participant_.publisher<TextMessage>("robot_description", {1, true});
  for (auto* const made : {&joints, &description}) {
    if (!*made) {
      return std::move(*made).error();
    }
  }
  joints_ = std::move(*joints);
  description_ = std::move(*description);
  (void)dds::write(description_.get(), TextMessage{dds::lent(urdf)});
  if (!controller.empty()) {
    if (auto added = add_controller(controller); !added) {
      return added;
    }
  }
  return participant_.announce();
}

std::uint64_t Ros2Side::spin() {
  const auto now = monotonic();
  std::uint64_t strangers = 0;
  if (trajectories_.ok()) {
    dds::take_all<TrajectoryMessage>(trajectories_.get(),
                                     [this](const TrajectoryMessage& message, const dds::SampleInfo& info) {
                                       if (info.valid) {
                                         events_.set_points(goal_in(message, rt::wall_ns()));
                                       }
                                     });
    action_.spin(now);
    strangers += action_.take_strangers();
  }
  for (Power& power : power_) {
    power.ends.take([this, &power](const TriggerRequest& /*request*/, const Caller& caller) {
      const RosReply done = events_.service(power.service);
      power.ends.reply(
          caller,
          [done](TriggerReply& reply) {
            reply.success = done.done;
            reply.message = dds::lent(done.text);
          },
          monotonic());
    });
    power.ends.step(now);
    strangers += power.ends.take_strangers();
  }
  return strangers;
}

void Ros2Side::publish_joints(const RosJoints& joints) {
  MessageMemory memory;
  (void)dds::write(joints_.get(), joint_state(joints, rt::wall_ns(), memory));
}

void Ros2Side::accept(int goal) {
  action_.accept(goal, monotonic());
}

void Ros2Side::feedback(int goal, const RosFeedback& feedback) {
  action_.feedback(goal, feedback);
}

void Ros2Side::finish(int goal, RosOutcome outcome, int code, const std::string& text) {
  action_.finish(goal, outcome, code, text, monotonic());
}

}  // namespace indurop::ros
