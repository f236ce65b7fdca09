// SPDX-License-Identifier: Apache-2.0
// The product's coordinates move with a conveyor or a rotary table, and the tool follows: it synchronizes with the belt
// as an axis does with its gear, and leaves it by coming to rest. Knows nothing of arms: its result is how much the
// tool has been carried along.

#pragma once

#include "control/robot/axis/coupling.h"
#include "control/robot/group/belt_estimator.h"
#include "control/robot/kinematics/geometry.h"

namespace indurop::robot {

class Tracking {
 public:
  struct Carrier {
    bool turns = false;  // about z of `origin`; else it goes along x of it
    int belt = 0;        // index of the belt, from 0
    Pose origin;         // in the base
    Pose product;        // in `origin`, at the present position of the belt
  };
  explicit Tracking(double period = 0.01) noexcept : period_(period) {}

  // The product's coordinates move from now on. It must not be tracking. Real-time safe, like all functions of this
  // class.
  void set(const Carrier& carrier, const BeltEstimator& belt) noexcept;
  // The product's coordinates stay where they are.
  void forget() noexcept { known_ = false; }
  [[nodiscard]] bool known() const noexcept { return known_; }
  [[nodiscard]] const Carrier& carrier() const noexcept { return carrier_; }
  // Metres or radians per mm or degree.
  [[nodiscard]] double scale() const noexcept { return carrier_.turns ? kPi / 180 : 0.001; }
  // m or rad since set(), and the same per s.
  [[nodiscard]] LineState belt(const BeltEstimator& belt) const noexcept { return seen(belt.now()); }
  // Moves a pose in the base by this much of the carrier's motion.
  [[nodiscard]] static Pose carried(const Carrier& carrier, double by, const Pose& pose) noexcept;
  // The product's pose when the carrier is at `place`.
  [[nodiscard]] Pose product(double place) const noexcept {
    return carried(carrier_, place, carrier_.origin * carrier_.product);
  }

  // Synchronizes with the belt within the limits `way`; neither the motion nor the belt may exceed `most`. If it
  // tracked the belt before, it returns to its earlier place on the belt.
  void join(const BeltEstimator& belt, const LineLimits& way, const LineLimits& most) noexcept;
  // Leaves the belt and comes to rest. `stays`: it will continue at the present place on the belt.
  void leave(const LineLimits& way, bool stays) noexcept;
  // Ends at once, wherever it is; the caller brings the arm to rest.
  void drop() noexcept;
  // Computes the next period. Errors: Speed, Acceleration, Jerk: the belt exceeds its limits; then tracking has to end.
  ErrorCode step(const BeltEstimator& belt) noexcept;

  // Returns whether it moves the tool, or has to bring it to rest.
  [[nodiscard]] bool on() const noexcept { return phase_ != Phase::Off; }
  // Returns whether it is synchronized: each of its steps equals the belt's.
  [[nodiscard]] bool is_synchronized() const noexcept { return phase_ == Phase::Synchronized; }
  [[nodiscard]] bool leaves() const noexcept { return phase_ == Phase::Leaving; }
  [[nodiscard]] bool at_rest() const noexcept { return !on() || (leaves() && gate_.at_rest()); }
  // The position on the belt's path to which the tool has been carried; while synchronized the product is at place() -
  // lag().
  [[nodiscard]] double place() const noexcept { return gate_.state().position; }
  [[nodiscard]] double lag() const noexcept { return lag_; }
  // Later commands refer to the present position of the carrier.
  void anchor() noexcept { anchor_ = place(); }
  [[nodiscard]] double anchored() const noexcept { return anchor_; }
  // Moves a pose that was planned there with the carrier.
  [[nodiscard]] Pose carried(const Pose& pose) const noexcept { return carried(tracked_, place() - anchor_, pose); }
  // The carrier it follows, also after the product has been set elsewhere.
  [[nodiscard]] const Carrier& tracked() const noexcept { return tracked_; }

 private:
  enum class Phase { Off, Joining, Synchronized, Leaving };
  [[nodiscard]] LineState seen(const LineState& belt) const noexcept;
  void put(double position) noexcept;

  double period_;
  bool known_ = false;
  Carrier carrier_, tracked_;
  double zero_ = 0;  // mm or degrees, position of the belt at set()
  Phase phase_ = Phase::Off;
  SetPointGate gate_;
  AxisCoupling coupling_;
  Profile to_rest_;
  double time_ = 0;
  double anchor_ = 0;
  bool has_lag_ = false;
  double lag_ = 0;
};

}  // namespace indurop::robot
