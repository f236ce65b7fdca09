// SPDX-License-Identifier: Apache-2.0
// One axis as a part of the arm, whatever was commanded: its drive, its motion, its limits, where it is and what it
// does.

#pragma once

#include <span>

#include "control/robot/axis/bounds.h"
#include "control/robot/axis/drive.h"
#include "control/robot/axis/following.h"
#include "control/robot/axis/motion.h"
#include "control/robot/axis/neighbours.h"
#include "control/robot/axis/torque_mode.h"
#include "control/robot/axis/units.h"

namespace indurop::robot {

// The parts that the control of an axis works on.
struct AxisParts {
  AxisUnits units;
  AxisBounds bounds;
  AxisNeighbours row;
  Drive drive;
  AxisMotion motion;
  AxisFollowing following;
  TorqueMode pushing;
  AxisState state = AxisState::Disabled;
  TorqueMode::Measured measured;
  bool homed = true;

  // All functions are real-time safe.
  [[nodiscard]] const LineState& commanded() const noexcept {
    return following.over() ? following.state() : motion.state();
  }
  // Returns whether it is in a motion of its own.
  [[nodiscard]] bool busy() const noexcept;
  [[nodiscard]] bool in_group() const noexcept {
    return state == AxisState::SynchronizedMotion && !following.coupled();
  }
  // The drive follows set points again, and the axis brakes from its present position and speed.
  void leave_torque() noexcept;
};

class AxisBody {
 public:
  // Permits pushing with up to `most`, in N m or N; 0: the torque unit of its drive is unknown. Real-time safe, like
  // all functions of this class.
  void allow_torque(double most) noexcept { parts_.pushing.allow(most); }
  void carry(const TorqueControl::Load& load) noexcept { parts_.pushing.carry(load); }
  // Part of the speed of its own motions, from 0 (hold) to 1, and the factors on accelerations and jerks of motions
  // that begin.
  void set_override(double part) noexcept;
  void set_factors(double acceleration, double jerk) noexcept { parts_.bounds.set_factors(acceleration, jerk); }
  // Sets the commanded state, whatever the axis was doing.
  void put(const LineState& state) noexcept;
  // The gate has brought it to this state.
  void braked(const LineState& state) noexcept { parts_.motion.lend(state); }
  // Rests at the commanded position: the group's motion has ended.
  void rest() noexcept { parts_.motion.reset({parts_.motion.state().position, 0, 0}); }

  [[nodiscard]] const Drive& drive() const noexcept { return parts_.drive; }
  [[nodiscard]] AxisState state() const noexcept { return parts_.state; }
  [[nodiscard]] bool homed() const noexcept { return parts_.homed; }
  [[nodiscard]] bool in_group() const noexcept { return parts_.in_group(); }
  [[nodiscard]] bool busy() const noexcept { return parts_.busy(); }
  [[nodiscard]] bool at_rest() const noexcept { return !parts_.following.over() && parts_.motion.at_rest(); }
  // Returns whether other axes may follow this one.
  [[nodiscard]] bool leads() const noexcept;
  [[nodiscard]] std::span<const AxisLeader> leaders() const noexcept { return parts_.following.leaders(); }
  // Returns whether its gate has to bring it to rest; the gate then reports its state to braked().
  [[nodiscard]] bool brakes() const noexcept { return parts_.following.brakes(); }
  // Returns whether the drive has not followed since the last period: the commanded position may be anywhere.
  [[nodiscard]] bool displaced() const noexcept { return displaced_; }
  // Returns whether it pushes with a torque: the set point is the drive's position.
  [[nodiscard]] bool pushes() const noexcept { return parts_.pushing.pushes(); }
  // Returns whether it pushes with all of the torque.
  [[nodiscard]] bool pushes_fully() const noexcept { return parts_.pushing.pushes() && parts_.pushing.reached(); }
  [[nodiscard]] bool led_by_drive() const noexcept { return parts_.pushing.led_by_drive(); }
  // Returns the torque for its drive in addition to what the arm needs, in N m or N.
  [[nodiscard]] double torque() const noexcept { return parts_.pushing.torque(); }
  [[nodiscard]] double unit() const noexcept { return parts_.units.unit(); }
  // Return 1 or -1: the sign of the drive's torque relative to the axis, for measured and for commanded values.
  [[nodiscard]] double drive_way() const noexcept { return parts_.units.drive_way(); }
  [[nodiscard]] double command_way() const noexcept { return parts_.units.command_way(); }
  [[nodiscard]] double measured() const noexcept { return parts_.measured.position; }
  [[nodiscard]] const LineState& commanded() const noexcept { return parts_.commanded(); }
  [[nodiscard]] const AxisUnits& units() const noexcept { return parts_.units; }
  [[nodiscard]] const AxisBounds& bounds() const noexcept { return parts_.bounds; }

 protected:
  [[nodiscard]] AxisParts& parts() noexcept { return parts_; }
  [[nodiscard]] const AxisParts& parts() const noexcept { return parts_; }
  void set_up(const AxisUnits::Scale& scale, const AxisBounds& bounds, bool absolute,
              const AxisNeighbours& row) noexcept;
  // Takes the measured position.
  void measure(const DriveIn& in, double seconds) noexcept;
  void set_displaced() noexcept { displaced_ = true; }

 private:
  AxisParts parts_;
  bool sensed_ = false;
  bool displaced_ = true;
};

}  // namespace indurop::robot
