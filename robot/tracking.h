// SPDX-License-Identifier: Apache-2.0
// The product's coordinates go with a conveyor or a rotary table, and the tool rides along: it gets onto the belt as an
// axis gets into gear, and off it to rest. Knows nothing of arms: what it says is how far the tool has been carried.

#pragma once

#include "robot/axis_coupling.h"
#include "robot/belt_watch.h"
#include "robot/geometry.h"

namespace indurop::robot {

class Tracking {
 public:
  struct Carrier {
    bool turns = false;  // about z of `origin`; else it goes along x of it
    int belt = 0;        // whose place counts, from 0
    Pose origin;         // in the base
    Pose product;        // in `origin`, where the belt is now
  };
  explicit Tracking(double period = 0.01) noexcept : period_(period) {}

  // The product's coordinates move from here on. It does not ride. Real-time safe, as all here.
  void set(const Carrier& carrier, const BeltWatch& watch) noexcept;
  // They stay where they are.
  void forget() noexcept { known_ = false; }
  [[nodiscard]] bool known() const noexcept { return known_; }
  [[nodiscard]] const Carrier& carrier() const noexcept { return carrier_; }
  // Of metres or radians, what mm or degrees are.
  [[nodiscard]] double scale() const noexcept { return carrier_.turns ? kPi / 180 : 0.001; }
  // m or rad since it was set, and the same per s.
  [[nodiscard]] LineState belt(const BeltWatch& watch) const noexcept { return seen(watch.now()); }
  // What a carrier does to a pose in the base when it goes so far.
  [[nodiscard]] static Pose carried(const Carrier& carrier, double by, const Pose& pose) noexcept;
  // Where the product is when the carrier is there.
  [[nodiscard]] Pose product(double place) const noexcept {
    return carried(carrier_, place, carrier_.origin * carrier_.product);
  }

  // Gets onto the belt, within `way`; neither it nor the belt may do more than `most`. If it has been on it before, it
  // comes to where on the belt it was then.
  void join(const BeltWatch& watch, const LineLimits& way, const LineLimits& most) noexcept;
  // Comes to rest beside it. `stays`: it will go on where on the belt it is now.
  void leave(const LineLimits& way, bool stays) noexcept;
  // At once, wherever it is; somebody else brings the arm to rest.
  void drop() noexcept;
  // One period on. Errors: Speed, Acceleration, Jerk: the belt does more than it may; then it has to leave.
  ErrorCode step(const BeltWatch& watch) noexcept;

  // It carries the tool, or has to bring it to rest.
  [[nodiscard]] bool on() const noexcept { return phase_ != Phase::Off; }
  // Each of its steps is the belt's.
  [[nodiscard]] bool rides() const noexcept { return phase_ == Phase::Riding; }
  [[nodiscard]] bool leaves() const noexcept { return phase_ == Phase::Leaving; }
  [[nodiscard]] bool at_rest() const noexcept { return !on() || (leaves() && gate_.at_rest()); }
  // Where on the belt's way the tool has been carried to; while it rides the product is at place() - lag().
  [[nodiscard]] double place() const noexcept { return gate_.state().position; }
  [[nodiscard]] double lag() const noexcept { return lag_; }
  // What is commanded from here on is seen from where the carrier is now.
  void anchor() noexcept { anchor_ = place(); }
  [[nodiscard]] double anchored() const noexcept { return anchor_; }
  // What was planned there, carried along.
  [[nodiscard]] Pose carried(const Pose& pose) const noexcept { return carried(ridden_, place() - anchor_, pose); }
  // What it rides on, also once the product is elsewhere.
  [[nodiscard]] const Carrier& ridden() const noexcept { return ridden_; }

 private:
  enum class Phase { Off, Joining, Riding, Leaving };
  [[nodiscard]] LineState seen(const LineState& told) const noexcept;
  void put(double position) noexcept;

  double period_;
  bool known_ = false;
  Carrier carrier_, ridden_;
  double zero_ = 0;  // mm or degrees, where the belt was
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
