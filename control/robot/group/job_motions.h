// SPDX-License-Identifier: Apache-2.0
// The motions, tools and loads of the running job, as JobRunner asks for them.

#pragma once

#include "control/robot/group/group_push.h"
#include "control/robot/group/interrupt_shelf.h"
#include "control/robot/group/off_path.h"
#include "control/robot/group/plans.h"
#include "control/robot/group/resuming.h"
#include "control/robot/group/robot.h"
#include "control/robot/group/torque_watch.h"

namespace indurop::robot {

class JobMotions final : public MotionPort {
 public:
  JobMotions(Robot& robot, Plans& plans, Resuming& resuming, InterruptShelf& shelf, TorqueWatch& torques,
             const OffPath& off_path) noexcept
      : robot_(robot),
        plans_(plans),
        resuming_(resuming),
        shelf_(shelf),
        torques_(torques),
        conveyor_(off_path.conveyor),
        correction_(off_path.correction),
        push_(robot) {}

  [[nodiscard]] bool ready() const noexcept override { return plans_.ahead().has_room(); }
  // An interrupted job keeps what was to be planned.
  [[nodiscard]] bool settled() const noexcept override {
    return (resuming_.aside() || plans_.ahead().empty()) && plans_.free() && robot_.follower.idle() &&
           (correction_.presses() || correction_.at_rest()) && !push_.on();
  }
  [[nodiscard]] bool is_moving() const noexcept override { return !robot_.follower.at_rest(); }
  Fault move(const MoveCommand& command) noexcept override;
  void halt() noexcept override;
  bool take_tool(int tool) noexcept override;
  bool take_load(int load) noexcept override;
  bool begin_correction(const CorrectionWay& way) noexcept override;
  bool end_correction() noexcept override;
  void correct(const Vec3& shift) noexcept override { correction_.want(shift); }
  void press(const PressNeeds& needs) noexcept override { correction_.press(needs); }
  [[nodiscard]] bool rests() const noexcept override { return settled() && correction_.at_rest(); }
  Fault push(const PushWay& way) noexcept override { return push_.begin(way); }
  [[nodiscard]] PushState pushing() const noexcept override { return push_.state(); }
  void end_push() noexcept override { push_.end(); }
  // Called once per period while the group moves. Returns true if an axis pushes instead.
  bool step_push() noexcept { return push_.step(); }
  // How far the robot is with the motions of the job, for its report.
  [[nodiscard]] JobProgress progress() const noexcept;
  Fault track(const BeltWay& way) noexcept override;
  bool ride(bool on_product, ErrorCode& error) noexcept override;
  [[nodiscard]] Pose product() const noexcept override { return conveyor_.product_ahead(); }
  void release_product() noexcept override { conveyor_.release(); }
  [[nodiscard]] PathPlace place() const noexcept override { return robot_.follower.path_place(); }

  [[nodiscard]] double tip_speed() const noexcept override;
  [[nodiscard]] Joints commanded() const noexcept override { return robot_.commanded(); }
  [[nodiscard]] Joints measured() const noexcept override { return robot_.axes.measured(); }
  bool step_aside() noexcept override { return shelf_.step_aside(); }
  [[nodiscard]] const Joints* left_at() const noexcept override { return shelf_.left_at(); }
  [[nodiscard]] Pose tip_at(const Joints& q) const noexcept override { return robot_.tip(q); }
  [[nodiscard]] Pose world_at(const Joints& q) const noexcept override {
    const ChainFrame world = robot_.parts.arm.world(q);
    return {world.shift, Quat(world.turn)};
  }
  bool come_back(Fault& fault) noexcept override { return shelf_.come_back(fault); }
  [[nodiscard]] bool is_back() const noexcept override { return resuming_.way_back() == Resuming::Return::None; }

 private:
  Robot& robot_;
  Plans& plans_;
  Resuming& resuming_;
  InterruptShelf& shelf_;
  TorqueWatch& torques_;
  ConveyorTracking& conveyor_;
  PathCorrection& correction_;
  GroupPush push_;
};

}  // namespace indurop::robot
