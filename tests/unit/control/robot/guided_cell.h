// SPDX-License-Identifier: Apache-2.0
// An arm with masses that a hand guides. Its drives follow set points at once; the torques that they report are those
// that orocos-kdl computes for the motion, for what the arm really holds and for the hand at its end, rounded and with
// noise as those of real drives.

#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <kdl/chainfksolverpos_recursive.hpp>
#include <kdl/chainjnttojacsolver.hpp>
#include <random>
#include <string>
#include <vector>

#include "group_cell.h"
#include "heavy_arm.h"

namespace indurop::robot {

class GuidedCell {
 public:
  struct Setup {
    HeavyArm arm;
    std::vector<double> rated;
    std::string job;
    double period = 0.004;
    std::vector<double> workspace{};
    unsigned seed = 1;
  };
  explicit GuidedCell(Setup given)
      : setup(std::move(given)),
        period(setup.period),
        cell(setup.job, 1000 * setup.period, 0, true, settings(), setup.arm.urdf),
        random_(setup.seed),
        jacobian_(setup.arm.chain),
        places_(setup.arm.chain) {
    cell.in.mode = {OperatingMode::Manual, true, 0};
  }
  static Setup of_cell(const std::string& job = "") {
    return {heavy_cell_arm(joints_of_six({250, 250, 130, 26, 22, 12})), {400, 400, 200, 60, 50, 30}, job};
  }

  void step() {
    cell.step();
    seen_ = {seen_[1], seen_[2], Joints::Zero()};
    for (int i = 0; i < count(); ++i) {
      seen_[2][i] = of_counts(i, cell.in.drives[at(i)].position);
    }
    const Joints velocity = (seen_[2] - seen_[1]) / period;
    const Joints acceleration = (seen_[2] - 2 * seen_[1] + seen_[0]) / (period * period);
    const Joints torque = kdl_torques(setup.arm, held, seen_[2], velocity, acceleration) - hand_torques(seen_[2]);
    for (int i = 0; i < count(); ++i) {
      const double noise = std::uniform_real_distribution<double>(-1.5, 1.5)(random_);
      const double raw = std::round(1000 * torque[i] / setup.rated[at(i)] + noise);
      if (!stale) {
        cell.in.drives[at(i)].torque = static_cast<std::int16_t>(std::clamp(raw, -32767.0, 32767.0));
      }
    }
  }
  void run(double seconds) {
    for (int i = 0; i < seconds / period; ++i) {
      step();
    }
  }
  template <class Condition>
  [[nodiscard]] bool until(const Condition& condition, double seconds) {
    for (int i = 0; i < seconds / period && !condition(); ++i) {
      step();
    }
    return condition();
  }
  [[nodiscard]] bool enable() {
    cell.ask(Service::GroupEnable);
    return until([&] { return cell.out.state == GroupState::Standby; }, 2);
  }
  // Takes the axes there (rad, m), in automatic mode.
  [[nodiscard]] bool go(const Joints& q) {
    cell.in.mode.mode = OperatingMode::Automatic;
    run(0.02);
    for (int i = 0; i < count(); ++i) {
      cell.in.service.target[at(i)] = to_users(i, q[i]);
    }
    cell.ask(Service::DirectAbsolute);
    const bool there = until([&] { return cell.out.done == cell.in.service.number; }, 20);
    cell.in.mode.mode = OperatingMode::Manual;
    run(0.02);
    return there && cell.out.error == ErrorCode::Ok;
  }
  void press(bool held_down = true) {
    cell.in.jog = {};
    cell.in.jog.enabled = held_down;
    cell.in.jog.frame = JogFrame::Hand;
  }
  // Presses the enabling device, and waits until the hand may move the arm.
  [[nodiscard]] bool guide() {
    press();
    return until([&] { return cell.out.guided; }, 1);
  }

  [[nodiscard]] int count() const { return setup.arm.count; }
  [[nodiscard]] bool slides(int i) const { return moving_joint(i).getType() != KDL::Joint::RotAxis; }
  // Set points, rad and m; their place, and how the arm's end moves with the axes.
  [[nodiscard]] Joints commanded() const {
    Joints q = Joints::Zero();
    for (int i = 0; i < count(); ++i) {
      q[i] = cell.out.command[at(i)] * (slides(i) ? 0.001 : kPi / 180);
    }
    return q;
  }
  // The frame after segment `part` of the chain; -1: the arm's end.
  [[nodiscard]] KDL::Frame place(const Joints& q, int part = -1) {
    KDL::Frame frame;
    places_.JntToCart(kdl(q), frame, part);
    return frame;
  }
  [[nodiscard]] KDL::Jacobian jacobian(const Joints& q) {
    KDL::Jacobian out(static_cast<unsigned>(count()));
    jacobian_.JntToJac(kdl(q), out);
    return out;
  }
  [[nodiscard]] Joints hand_torques(const Joints& q) {
    Joints torque = Joints::Zero();
    Eigen::Matrix<double, 6, 1> wrench;
    wrench << force, moment;
    torque.head(count()) = jacobian(q).data.transpose() * wrench;
    return torque;
  }

  Setup setup;
  const double period;
  Cell cell;
  Body held{};                                       // what the arm really holds
  Vec3 force = Vec3::Zero(), moment = Vec3::Zero();  // of the hand at the arm's end, N and N m, along the base
  bool stale = false;                                // the drives report the same torques again and again

  static Joints joints_of_six(const std::array<double, 6>& numbers) {
    Joints q = Joints::Zero();
    std::copy(numbers.begin(), numbers.end(), q.data());
    return q;
  }

 private:
  [[nodiscard]] Settings settings() const {
    Settings out;
    out.rated_torque = setup.rated;
    out.workspace = setup.workspace;
    return out;
  }
  [[nodiscard]] const KDL::Joint& moving_joint(int i) const {
    int seen = 0;
    for (const KDL::Segment& segment : setup.arm.chain.segments) {
      if (segment.getJoint().getType() != KDL::Joint::None && seen++ == i) {
        return segment.getJoint();
      }
    }
    return setup.arm.chain.segments.back().getJoint();
  }
  [[nodiscard]] double of_counts(int i, std::int32_t counts) const {
    return slides(i) ? counts / 1e6 : 2 * kPi * counts / 1'320'000;
  }
  [[nodiscard]] double to_users(int i, double value) const { return slides(i) ? 1000 * value : 180 / kPi * value; }
  [[nodiscard]] KDL::JntArray kdl(const Joints& q) const {
    KDL::JntArray out(static_cast<unsigned>(count()));
    out.data = q.head(count());
    return out;
  }

  std::mt19937 random_;
  KDL::ChainJntToJacSolver jacobian_;
  KDL::ChainFkSolverPos_recursive places_;
  std::array<Joints, 3> seen_{Joints::Zero(), Joints::Zero(), Joints::Zero()};
};

}  // namespace indurop::robot
