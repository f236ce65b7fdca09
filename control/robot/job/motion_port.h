// SPDX-License-Identifier: Apache-2.0
// The services of the group that a job uses.

#pragma once

#include "control/robot/kinematics/errors.h"
#include "control/robot/path/segment.h"

namespace indurop::robot {

class MotionPort {
 public:
  virtual ~MotionPort() = default;
  // Returns whether another motion can be accepted now.
  [[nodiscard]] virtual bool ready() const noexcept = 0;
  // Returns whether all commanded motions have ended.
  [[nodiscard]] virtual bool settled() const noexcept = 0;
  virtual Fault move(const MoveCommand& command) noexcept = 0;
  // Comes to rest on the path as soon as its limits allow, and discards the rest of it.
  virtual void halt() noexcept {}
  // Selects a tool when all motions have ended. Returns false if it is not done yet.
  virtual bool take_tool(int) noexcept { return true; }
  // Selects a load when all motions have ended. Returns false if it is not done yet.
  virtual bool take_load(int) noexcept { return true; }
  [[nodiscard]] virtual PathPlace place() const noexcept { return {}; }
  // Joint values: the set point, and as the drives report them.
  [[nodiscard]] virtual Joints commanded() const noexcept { return Joints::Zero(); }
  [[nodiscard]] virtual Joints measured() const noexcept { return commanded(); }
  // The tip of the selected tool at these joint values.
  [[nodiscard]] virtual Pose tip_at(const Joints&) const noexcept { return {}; }
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
