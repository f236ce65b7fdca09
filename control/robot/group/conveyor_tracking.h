// SPDX-License-Identifier: Apache-2.0
// The product's coordinates, and products that move with a conveyor or a rotary table. A motion in the product's
// coordinates is planned as if the product were where it was when the tool was last at rest on it; each set point is
// then moved along with the belt.

#pragma once

#include <array>

#include "control/robot/group/belt_estimator.h"
#include "control/robot/group/group_port.h"
#include "control/robot/group/plans.h"
#include "control/robot/group/robot.h"
#include "control/robot/group/tracking.h"

namespace indurop::robot {

class ConveyorTracking {
 public:
  ConveyorTracking(Robot& robot, GroupPort& group, Plans& plans) noexcept;

  // Reads the belts. All functions of this class are real-time safe.
  void sense(const std::array<BeltIn, kBelts>& belts) noexcept;
  // Commands: the product's coordinates move with a belt from now on (`turns`: with a table), or stand still.
  ErrorCode track(const Command& command, bool turns) noexcept;
  // The same for a carrier that is given. Errors: Belt.
  ErrorCode track(const Tracking::Carrier& carrier) noexcept;
  ErrorCode set_product(const Command& command) noexcept;

  // Returns whether a belt moves the tool, or the tool has to come to rest after that.
  [[nodiscard]] bool on() const noexcept { return tracking_.on(); }
  // Returns whether the tool is synchronized with the belt.
  [[nodiscard]] bool is_synchronized() const noexcept { return tracking_.is_synchronized(); }
  [[nodiscard]] bool at_rest() const noexcept { return tracking_.at_rest(); }
  // Returns whether the product moves with a belt; or should, but its position is unknown.
  [[nodiscard]] bool product_moves() const noexcept { return tracking_.known(); }
  [[nodiscard]] bool product_lost() const noexcept { return product_lost_; }
  // The product's coordinates no longer move.
  void release() noexcept;
  // Brings the tool to where a motion has to begin: at rest on the product, or off any belt. Returns false if it is
  // not there yet. Errors: Unreachable, Speed; it then never will be.
  [[nodiscard]] bool reaches(bool on_product, ErrorCode& error) noexcept;
  // Leaves the belt and comes to rest. `stays`: to continue at the present place on it.
  void leave(bool stays) noexcept;
  // Ends tracking when axes stop on their own, because of this error.
  void drop(ErrorCode code) noexcept;
  // Moves the set point of the path in this period along with the belt.
  [[nodiscard]] Fault carry(Joints& q) noexcept;
  // Where the next motion begins.
  [[nodiscard]] Joints planned_end() const noexcept;

  // As its reader reports it.
  [[nodiscard]] const BeltEstimator& belt(int number) const noexcept { return belts_[at(number)]; }
  // All motions are held, or not.
  void set_paused(bool paused) noexcept { paused_ = paused; }
  // Part of the accelerations that a motion which is planned now may use.
  [[nodiscard]] double acceleration() const noexcept;
  // Part of full speed, and tip speed in m/s, that the tracking leaves for motions on the product, and that it takes.
  [[nodiscard]] double pace() const noexcept { return pace_; }
  [[nodiscard]] double speed() const noexcept { return speed_; }

  // The product's coordinates; the same for the motion that is being planned; as it was set: mm and degrees.
  [[nodiscard]] const Pose& product() const noexcept { return product_; }
  [[nodiscard]] Pose product_ahead() const noexcept;
  [[nodiscard]] const std::array<double, 6>& product_given() const noexcept { return product_given_; }
  // Called once per period: a product on a belt has moved.
  void update_product() noexcept;

 private:
  // Limits of a carrier's motion; `tip`: m that the tip or the arm's end moves per m or rad of the carrier.
  struct Room {
    LineLimits limits;
    double tip = 0;
  };
  [[nodiscard]] const BeltEstimator& belt() const noexcept { return belts_[at(tracking_.carrier().belt)]; }
  [[nodiscard]] LineLimits most_of(const Tracking::Carrier& carrier) const noexcept;
  bool room_for(const Tracking::Carrier& carrier, Room& room) const noexcept;
  ErrorCode join() noexcept;
  void keep_to_product() noexcept;
  void steer() noexcept;
  void end_tracking() noexcept;
  void lose_product(const char* why) noexcept;
  void end_motion(ErrorCode code, const char* why) noexcept;

  Robot& robot_;
  GroupPort& group_;
  Plans& plans_;
  std::array<BeltEstimator, kBelts> belts_;
  Tracking tracking_;
  bool product_lost_ = false;
  bool held_ = false;    // it leaves the belt because all motions are held
  bool paused_ = false;  // all motions are held, also those without tracking
  double pace_ = 1;
  double speed_ = 0;
  Pose product_;
  std::array<double, 6> product_given_{};
};

}  // namespace indurop::robot
