// SPDX-License-Identifier: Apache-2.0
// The cell's arm with masses, and drives that are some periods away and know positions and torques (CiA 402, modes 8
// and 10). One of its axes moves as orocos-kdl says for the torque that its drive gives, against friction and walls.

#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <random>
#include <string>
#include <vector>

#include "command_cell.h"
#include "drive_answer.h"
#include "heavy_arm.h"
#include "robot_fixture.h"

namespace indurop::robot {

// What an axis runs into: from `place` (rad) on, upwards or downwards.
struct Wall {
  double place = 0;
  double way = 0;  // 1, -1; 0: there is none
  double stiffness = 20000;
  double damping = 200;
  [[nodiscard]] double force(double q, double velocity) const {
    const double in = way * (q - place);
    return way != 0 && in > 0 ? -way * std::max(0.0, stiffness * in + damping * way * velocity) : 0;
  }
};

inline const std::vector<double> kRatedTorque{400, 400, 200, 60, 50, 30};
inline const std::vector<double> kRotors{3, 3, 1.5, 0.4, 0.35, 0.2};
inline Joints most_torques() {
  return joints_of({250, 250, 130, 26, 22, 12});
}

class TorqueCell : public CommandCell {
 public:
  struct Setup {
    std::size_t axis = 0;
    double period = 0.004;
    std::size_t late_out = 0, late_in = 0;
    double friction = 0;
    std::string job{};
  };
  explicit TorqueCell(const Setup& setup) : TorqueCell(setup, heavy_cell_arm(most_torques())) {}

  void step() {
    cell.step();
    for (std::size_t i = 0; i < 6; ++i) {
      drives_[i].commands.push_back(cell.out.drives[i]);
      const DriveOut now = drives_[i].commands.front();
      drives_[i].commands.pop_front();
      act(i, now);
      drives_[i].says.push_back(in_[i]);
      cell.in.drives[i] = drives_[i].says.front();
      drives_[i].says.pop_front();
    }
    judge();
  }
  template <class Condition>
  [[nodiscard]] bool until(const Condition& condition, int most = 5000) {
    for (int i = 0; i < most && !condition(); ++i) {
      step();
    }
    return condition();
  }
  void run(double seconds) {
    for (int i = 0; i < seconds / setup_.period; ++i) {
      step();
    }
  }
  Given push(double torque, double ramp = 0, double most_velocity = 20, BufferMode buffer = BufferMode::Aborting) {
    const Given given = give(number(), AxisService::TorqueControl, torque, most_velocity, buffer);
    command(given).to[1] = ramp;
    return given;
  }
  [[nodiscard]] int number() const { return static_cast<int>(setup_.axis) + 1; }
  [[nodiscard]] AxisState now() const { return cell.out.axes[setup_.axis].state; }
  [[nodiscard]] const DriveOut& commanded() const { return cell.out.drives[setup_.axis]; }
  // The drive changes its mode on its own.
  void force_mode(int mode) { in_[setup_.axis].mode = static_cast<std::int8_t>(mode); }
  // N m that the drive gets in addition to what the arm needs.
  [[nodiscard]] double commanded_torque() const { return commanded().torque / 1000.0 * kRatedTorque[setup_.axis]; }
  [[nodiscard]] double against_wall() const { return -wall.force(q, velocity); }

  Wall wall;
  bool has_torque_mode = true;
  bool stays_in_mode = false;  // 10, whatever is commanded
  double q = 0, velocity = 0;  // rad
  double pull = 0;             // from outside, N m
  double most_given = 0;       // N m beyond what the arm needed, in mode 10
  double fastest = 0;          // rad/s
  std::string broken;          // limits of set points, first one
  double end_lower = 0, end_upper = 0;

 private:
  struct Bus {
    std::deque<DriveOut> commands;
    std::deque<DriveIn> says;
  };
  static Settings settings() {
    Settings settings;
    settings.rated_torque = kRatedTorque;
    settings.rotor_inertia = kRotors;
    settings.plan_in_tick = true;
    return settings;
  }
  TorqueCell(const Setup& setup, HeavyArm heavy)
      : CommandCell(1000 * setup.period, settings(), heavy.urdf, setup.job), setup_(setup), heavy_(std::move(heavy)) {
    cell.stuck = true;
    for (std::size_t i = 0; i < 6; ++i) {
      in_[i].status = 0x40;
      drives_[i].commands.assign(setup.late_out, DriveOut{});
      drives_[i].says.assign(setup.late_in, in_[i]);
    }
    const Arm arm = arm_from_urdf("", heavy_.urdf)->arm;
    end_lower = arm.axis(static_cast<int>(setup.axis)).lower;
    end_upper = arm.axis(static_cast<int>(setup.axis)).upper;
  }
  void act(std::size_t i, const DriveOut& out) {
    DriveIn& in = in_[i];
    const unsigned control = out.control & 0x0FU;
    in.status = test::next_status(in.status, control);
    const bool takes = (out.mode != 10 || has_torque_mode) && !(in.mode == 10 && stays_in_mode);
    in.mode = takes ? out.mode : in.mode;
    const bool powered = in.status == 0x27;
    if (i != setup_.axis) {
      in.position = powered && in.mode == 8 ? out.position : in.position;
      return;
    }
    if (!powered) {
      velocity = 0;  // its brake holds it
      target_ = q;
    } else {
      move(in.mode, out);
    }
    in.position = static_cast<std::int32_t>(std::llround(q * kCounts));
  }
  // In ten steps; the other axes are held.
  void move(int mode, const DriveOut& out) {
    constexpr int kSteps = 10;
    const double h = setup_.period / kSteps;
    const auto k = static_cast<Eigen::Index>(setup_.axis);
    const double most = most_torques()[k];
    const double next = out.position / kCounts;
    const double target_speed = (next - target_) / setup_.period;
    Joints place = Joints::Zero();
    for (std::size_t i = 0; i < 6; ++i) {
      place[static_cast<Eigen::Index>(i)] = in_[i].position / kCounts;
    }
    for (int s = 0; s < kSteps; ++s) {
      place[k] = q;
      Joints speed = Joints::Zero();
      speed[k] = velocity;
      Joints one = Joints::Zero();
      one[k] = 1;
      const double needed = kdl_torques(heavy_, {}, place, speed, Joints::Zero())[k];
      const double inertia = kdl_torques(heavy_, {}, place, Joints::Zero(), one)[k] -
                             kdl_torques(heavy_, {}, place, Joints::Zero(), Joints::Zero())[k] + kRotors[setup_.axis];
      const double outside = wall.force(q, velocity) + pull - setup_.friction * std::tanh(velocity / 0.002);
      double given = (out.torque + out.torque_offset) / 1000.0 * kRatedTorque[setup_.axis];
      if (mode == 8) {
        target_ += target_speed * h;
        const double wanted = 60 * 60 * (target_ - q) + 2 * 60 * (target_speed - velocity);
        given = needed + inertia * wanted - outside;
      } else {
        most_given = std::max(most_given, std::abs(given - needed));
        target_ = next;
      }
      given = std::clamp(given, -1.2 * most, 1.2 * most);
      velocity += (given - needed + outside) / inertia * h;
      q += velocity * h;
    }
    target_ = next;
    fastest = std::max(fastest, std::abs(velocity));
  }
  // Set points of the drive that follows them, as differences; those before are where it was.
  void judge() {
    const AxisReport& report = cell.out.axes[setup_.axis];
    const double p = cell.out.command[setup_.axis];
    const double h = setup_.period;
    const bool follows = commanded().mode == 8 && before_ == 8;
    before_ = commanded().mode;
    if (follows && (cell.in.drives[setup_.axis].status & 0x6FU) == 0x27 && broken.empty()) {
      const double v = (p - place_) / h;
      const double a = (v - speed_) / h;
      const double j = (a - acceleration_) / h;
      const auto look = [&](const char* what, double value, double most) {
        if (std::abs(value) > most * 1.001 && broken.empty()) {
          broken = fmt::format("{} {} beyond {}", what, value, most);
        }
      };
      look("speed", v, report.most_velocity);
      look("acceleration", a, kHard * report.most_acceleration);
      look("jerk", std::max(0.0, std::abs(j) - 1e-7 / (h * h * h)), kHard * kHard * report.most_jerk);
      speed_ = v;
      acceleration_ = a;
    } else {
      speed_ = report.velocity;
      acceleration_ = report.acceleration;
    }
    place_ = p;
  }

  static constexpr double kCounts = 1'320'000 / (2 * kPi);
  static constexpr double kHard = 1.5;  // Settings::emergency_factor
  Setup setup_;
  HeavyArm heavy_;
  std::array<Bus, 6> drives_;
  std::array<DriveIn, 6> in_{};
  std::int8_t before_ = 0;  // commanded
  double target_ = 0;
  double place_ = 0, speed_ = 0, acceleration_ = 0;
};

}  // namespace indurop::robot
