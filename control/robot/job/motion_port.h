// SPDX-License-Identifier: Apache-2.0
// The services of the group that a job uses.

#pragma once

#include <array>

#include "control/robot/job/press_need.h"
#include "control/robot/job/push_way.h"
#include "control/robot/kinematics/errors.h"
#include "control/robot/path/segment.h"

namespace indurop::robot {

// How motions are shifted: along which axes, and the limits of the shift along each of them. A tool that presses is
// shifted along some of them only, also while the path is at rest; the limits are those of the whole shift.
struct CorrectionWay {
  Quat axes = Quat::Identity();  // in the base
  bool by_tool = false;          // along the axes of the tool instead
  double limit = 0;              // m
  double rate = 0;               // m/s
  // Whether the tool presses along x, y and z; along none of them: it does not press.
  std::array<bool, 3> pressed{};
  [[nodiscard]] int directions() const noexcept { return pressed[0] + pressed[1] + pressed[2]; }
};

// A frame that moves with a belt, along x of `origin`, or with a table, about z of it.
struct BeltWay {
  int belt = 1;
  bool turns = false;
  Pose origin;
  Pose frame;  // where it is now, in the base
};

class MotionPort {
 public:
  virtual ~MotionPort() = default;
  // Returns whether another motion can be accepted now.
  [[nodiscard]] virtual bool ready() const noexcept = 0;
  // Returns whether all commanded motions have ended.
  [[nodiscard]] virtual bool settled() const noexcept = 0;
  // Returns whether the robot moves along its path in this period.
  [[nodiscard]] virtual bool is_moving() const noexcept { return !settled(); }
  virtual Fault move(const MoveCommand& command) noexcept = 0;
  // Comes to rest on the path as soon as its limits allow, and discards the rest of it.
  virtual void halt() noexcept {}
  // Selects a tool when all motions have ended. Returns false if it is not done yet.
  virtual bool take_tool(int) noexcept { return true; }
  // Selects a load when all motions have ended. Returns false if it is not done yet.
  virtual bool take_load(int) noexcept { return true; }
  // Begins and ends shifting all motions when they have ended. Each returns false if it is not done yet. The motion
  // after the end begins where the arm is then.
  virtual bool begin_correction(const CorrectionWay&) noexcept { return true; }
  virtual bool end_correction() noexcept { return true; }
  // How far to shift from now on, m along the axes; what exceeds the limit is cut off.
  virtual void correct(const Vec3&) noexcept {}
  // What is missing in this period to a tool that presses. If it is not called, the tool comes to rest.
  virtual void press(const PressNeeds&) noexcept {}
  // Returns whether no set point changes: all motions have ended, and a tool that presses rests.
  [[nodiscard]] virtual bool rests() const noexcept { return settled(); }
  // Lets an axis push from now on; all motions must have ended. settled() is false until end_push() has brought it to
  // rest. Errors: Value, NoTorque, Torque, State.
  virtual Fault push(const PushWay&) noexcept { return {}; }
  [[nodiscard]] virtual PushState pushing() const noexcept { return {}; }
  virtual void end_push() noexcept {}
  // Lets the product's coordinates move with a belt. Errors: Belt.
  virtual Fault track(const BeltWay&) noexcept { return {}; }
  // Brings the tool to where a motion has to begin when all have ended: at rest on the product, or off any belt.
  // Returns false if it is not there yet; with an error it never will be. Errors: Belt, Unreachable, Speed.
  virtual bool ride(bool /*on_product*/, ErrorCode& /*error*/) noexcept { return true; }
  // The product's coordinates for the next motion on it; and they no longer move.
  [[nodiscard]] virtual Pose product() const noexcept { return {}; }
  virtual void release_product() noexcept {}
  [[nodiscard]] virtual PathPlace place() const noexcept { return {}; }
  // m/s of the tip of the selected tool, of the last set point.
  [[nodiscard]] virtual double tip_speed() const noexcept { return 0; }
  // Joint values: the set point, and as the drives report them.
  [[nodiscard]] virtual Joints commanded() const noexcept { return Joints::Zero(); }
  [[nodiscard]] virtual Joints measured() const noexcept { return commanded(); }
  // The tip of the selected tool at these joint values.
  [[nodiscard]] virtual Pose tip_at(const Joints&) const noexcept { return {}; }
  // The world as seen from the workpiece, if axes move that; else where it is.
  [[nodiscard]] virtual Pose world_at(const Joints&) const noexcept { return {}; }
  // Begins an interrupt: comes to rest on the path and saves the rest of it. Returns false if it is not done yet.
  virtual bool step_aside() noexcept { return true; }
  // Joint values where the path was left; null if no interrupt is being served.
  [[nodiscard]] virtual const Joints* left_at() const noexcept { return nullptr; }
  // Returns to where the path was left; all motions must have ended. Returns false if it is not done yet. Errors: Away.
  virtual bool come_back(Fault&) noexcept { return true; }
  // Returns whether it is back on the path.
  [[nodiscard]] virtual bool is_back() const noexcept { return true; }
};

}  // namespace indurop::robot
