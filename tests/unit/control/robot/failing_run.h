// SPDX-License-Identifier: Apache-2.0
// A robot in manual mode of which something fails in mid-motion, watched by a second opinion: orocos-kdl says how fast
// the tool's tip and the arm's end are, of set points and of places that drives have come to.

#pragma once

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <random>
#include <string>

#include "drive_faults.h"
#include "limit_judge.h"

namespace indurop::robot {

inline constexpr double kTooFast = 250.2;  // mm/s; drives count in steps

// What an axis does whose drive has no power: it stands at once, goes on as fast as it was, or something in between.
enum class Coasting { Stands, GoesOn, SlowsDown };
enum class Failure { Drive, Power, Following, Switch, Emergency, Belt, Nothing };
enum class Motion { Line, Job, Jog, Axes, Blocks, Belt };

struct Tally {
  double set_points = 0, places = 0;  // mm/s
  int moved = 0, failed = 0, stopped_by_gate = 0;
  double longest = 0;  // s from the failure to rest
};

// Drives count from where the arm begins.
inline Settings fine_counts(const ArmSpec& spec, double period_ms) {
  Settings settings;
  settings.zero.clear();
  for (std::size_t i = 0; i < spec.parts.size(); ++i) {
    settings.zero.push_back(spec.parts[i].slides ? 1000 * spec.start[i] : degrees(spec.start[i]));
  }
  settings.counts_per_turn = {4e7};
  settings.counts_per_mm = {1e5};
  settings.plan_in_tick = true;
  settings.period = std::chrono::nanoseconds(static_cast<std::int64_t>(period_ms * 1e6));
  return settings;
}

class Run : public CommandCell {
 public:
  Run(const ArmSpec& spec, unsigned seed, double period_ms, const std::string& text, bool long_tool)
      : CommandCell(period_ms, fine_counts(spec, period_ms), spec.urdf(), text),
        random(seed),
        job(text),
        spec_(spec),
        period_(period_ms / 1000),
        places_(spec, long_tool ? KDL::Frame(KDL::Rotation::RPY(radians(20), 0, 0), KDL::Vector(0, 0.1, 0.3))
                                : KDL::Frame::Identity()),
        judge_(period_, spec.urdf()) {
    cell.in.mode.mode = OperatingMode::Manual;
    cell.in.mode.enabled = true;
  }
  double in(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random); }
  int one_of(int many) { return std::uniform_int_distribution<int>(0, many - 1)(random); }

  // One period of robot and drives.
  void step() {
    time += period_;
    if (belt_reported) {
      cell.in.belts[0] = {1000 * belt_speed * time, cell.in.belts[0].beat + 1};
    }
    const auto before = cell.in.drives;
    cell.step();
    fail_drives(before);
    look();
  }
  template <class Condition>
  bool until(const Condition& condition, double most) {
    for (const double end = time + most; time < end && broken.empty();) {
      if (condition()) {
        return true;
      }
      step();
    }
    return false;
  }
  // The drive of that axis, from 0.
  void fail(Failure failure, std::size_t axis, Coasting coasting) {
    failed_ = failure;
    axis_ = axis;
    coasting_ = coasting;
    const double now = cell.in.drives[axis].position;
    speed_ = now - last_position_[axis];
    stuck_at_ = cell.in.drives[axis].position;
    coasted_ = now;
    if (failure == Failure::Drive || failure == Failure::Power) {
      cell.in.drives[axis].status = failure == Failure::Drive ? Cell::kFault : Cell::kSwitchOnDisabled;
    }
  }
  [[nodiscard]] bool coasts() const { return std::abs(speed_) > 0.5; }
  [[nodiscard]] bool stands() const {
    return std::all_of(cell.out.speed.begin(), cell.out.speed.end(), [](double v) { return std::abs(v) < 1e-9; });
  }
  // Of the commands to the drives.
  [[nodiscard]] double speed() const { return speed_of_set_points_; }

  std::mt19937 random;
  const std::string job;
  double time = 0;
  double belt_speed = 0;  // m/s
  bool belt_reported = false;
  double hardness = 1;
  Tally tally;
  std::string broken;

 private:
  void fail_drives(const std::array<DriveIn, kJoints>& before) {
    for (std::size_t i = 0; i < kJoints; ++i) {
      last_position_[i] = before[i].position;
    }
    DriveIn& drive = cell.in.drives[axis_];
    if (failed_ == Failure::Following) {
      drive.position = stuck_at_;
    }
    if (failed_ != Failure::Drive && failed_ != Failure::Power) {
      return;
    }
    drive.status = failed_ == Failure::Drive ? Cell::kFault : Cell::kSwitchOnDisabled;
    speed_ *= coasting_ == Coasting::Stands ? 0 : coasting_ == Coasting::SlowsDown ? std::exp(-15 * period_) : 1;
    speed_ *= since_ > 0.4 ? std::exp(-30 * period_) : 1;
    since_ += period_;
    coasted_ += speed_;
    drive.position = static_cast<std::int32_t>(std::lround(coasted_));
  }

  void look() {
    const std::string limits = judge_.look(cell, hardness);
    const KdlPlaces::Place wanted = places_.at(cell.out.command);
    AxisNumbers there;
    for (std::size_t i = 0; i < spec_.parts.size(); ++i) {
      const double zero = spec_.start[i] * (spec_.parts[i].slides ? 1000 : 180 / kPi);
      there[i] = zero + cell.in.drives[i].position * (spec_.parts[i].slides ? 1e-5 : 360 / 4e7);
    }
    const KdlPlaces::Place place = places_.at(there);
    const double wanted_speed = first_ ? 0 : 1000 * KdlPlaces::apart(wanted, wanted_) / period_;
    const double speed = first_ ? 0 : 1000 * KdlPlaces::apart(place, place_) / period_;
    first_ = false;
    wanted_ = wanted;
    place_ = place;
    speed_of_set_points_ = wanted_speed;
    // That an axis does not follow shows only once it is far behind. It is said to be there when it loses its power.
    const bool behind = failed_ == Failure::Following;
    const bool jumps = behind && cell.in.drives[axis_].status != 0x27;
    const bool too_fast = (wanted_speed > kTooFast && !jumps) || (speed > kTooFast && !behind);
    tally.set_points = std::max(tally.set_points, jumps ? 0 : wanted_speed);
    tally.places = std::max(tally.places, behind ? 0 : speed);
    if (!limits.empty() || too_fast) {
      broken = fmt::format("{}set points {:.1f} mm/s, places {:.1f} mm/s, at {:.3f} s, {} s after it failed", limits,
                           wanted_speed, speed, time, since_);
    }
  }

  ArmSpec spec_;
  double period_;
  KdlPlaces places_;
  Judge judge_;
  Failure failed_ = Failure::Nothing;
  std::size_t axis_ = 0;
  Coasting coasting_ = Coasting::Stands;
  double speed_ = 0, coasted_ = 0;  // counts for each period, counts
  double since_ = 0;
  std::int32_t stuck_at_ = 0;
  std::array<double, kJoints> last_position_{};
  bool first_ = true;
  KdlPlaces::Place wanted_, place_;
  double speed_of_set_points_ = 0;
};

}  // namespace indurop::robot
