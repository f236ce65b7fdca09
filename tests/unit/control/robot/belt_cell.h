// SPDX-License-Identifier: Apache-2.0
// A cell with a belt or table, that checks each set point: at the joints' limits, and at where orocos-kdl says that
// the tip is on the product.

#pragma once

#include <functional>
#include <kdl/chainfksolverpos_recursive.hpp>
#include <string>
#include <utility>

#include "command_cell.h"
#include "limit_judge.h"

namespace indurop::robot {

using Eight = std::array<double, 8>;

// The cell's arm, typed in again.
class KdlTip {
 public:
  KdlTip() : chain_(chain()), solver_(chain_) {}
  [[nodiscard]] KDL::Frame at(const AxisNumbers& degrees_of) {
    KDL::JntArray q(6);
    for (unsigned i = 0; i < 6; ++i) {
      q(i) = radians(degrees_of[i]);
    }
    KDL::Frame frame;
    solver_.JntToCart(q, frame);
    return frame;
  }

 private:
  static KDL::Chain chain() {
    using KDL::Joint;
    KDL::Chain chain;
    const auto add = [&](Joint::JointType kind, const KDL::Vector& before) {
      chain.addSegment(KDL::Segment(Joint(Joint::None), KDL::Frame(before)));
      chain.addSegment(KDL::Segment(Joint(kind)));
    };
    add(Joint::RotZ, {0, 0, 0.30});
    add(Joint::RotY, {0.07, 0, 0.10});
    add(Joint::RotY, {0, 0, 0.47});
    add(Joint::RotX, {0.25, 0, 0.05});
    add(Joint::RotY, {0.22, 0, 0});
    add(Joint::RotX, {0.09, 0, 0});
    chain.addSegment(
        KDL::Segment(Joint(Joint::None), KDL::Frame(KDL::Rotation::RPY(0, kPi / 2, 0), KDL::Vector(0.14, 0, 0))));
    return chain;
  }
  KDL::Chain chain_;
  KDL::ChainFkSolverPos_recursive solver_;  // of that one
};

inline KDL::Frame frame_of(const Eight& numbers) {
  return {KDL::Rotation::RPY(radians(numbers[3]), radians(numbers[4]), radians(numbers[5])),
          KDL::Vector(numbers[0], numbers[1], numbers[2]) / 1000};
}

class Belts : public testing::Test, public CommandCell {
 protected:
  explicit Belts(Settings settings = in_tick(), const std::string& urdf = "", const std::string& job = "")
      : CommandCell(10, std::move(settings), urdf, job), judge(0.01, urdf.empty() ? cell_urdf() : urdf) {}
  static Settings in_tick() {
    Settings settings;
    settings.plan_in_tick = true;
    return settings;
  }
  void SetUp() override {
    belt = [](double) { return 0.0; };
    ASSERT_TRUE(run(give(Service::GroupEnable)));
    ASSERT_TRUE(run(give(Service::DirectAbsolute, {0, 10, -20, 0, 60, 0})));
    ASSERT_TRUE(run(machine(500, 0, 400)));
  }

  // One period, with the belt where it is then.
  void step() {
    time += 0.01;
    if (reported) {
      cell.in.belts[0] = {std::round(belt(time) / resolution) * resolution, cell.in.belts[0].beat + 1};
    }
    cell.step();
    const std::string broken = judge.look(cell, hardness);
    EXPECT_EQ(broken, "") << "at " << time;
    failed = failed || !broken.empty();
  }
  [[nodiscard]] bool until(const std::function<bool()>& condition, int most = 3000) {
    for (int i = 0; i < most && !failed; ++i) {
      if (condition()) {
        return true;
      }
      step();
    }
    return false;
  }
  [[nodiscard]] bool run(const Given& given) {
    return until([&] { return ended(given); }) && state(given) == CommandState::Done;
  }
  Given machine(double x, double y, double z, double speed = 250) {
    return give(Service::LinearAbsolute, {x, y, z, 180, 0, 180}, speed, BufferMode::Aborting, CoordSystem::Machine);
  }
  Given product(double x, double y, double z, double speed = 250, BufferMode mode = BufferMode::Aborting) {
    return give(Service::LinearAbsolute, {x, y, z, 180, 0, 180}, speed, mode, CoordSystem::Product);
  }
  Given track(const Eight& from, const Eight& on_it, bool turns = false) {
    const Given given = give(turns ? Service::TrackTable : Service::TrackBelt, from);
    command(given).aux = on_it;
    command(given).option = 1;
    origin = frame_of(from);
    object = frame_of(on_it);
    table = turns;
    return given;
  }
  // The product is tracked, from where the belt is now on.
  void begin_tracking(const Eight& from, const Eight& on_it = {}, bool turns = false) {
    for (int i = 0; i < 50; ++i) {
      step();
    }
    const Given given = track(from, on_it, turns);
    step();
    zero = belt(time);
    ASSERT_EQ(state(given), CommandState::Done) << static_cast<int>(error(given));
  }
  // Where the product really is.
  [[nodiscard]] KDL::Frame product_now() const {
    const double gone = belt(time) - zero;
    const KDL::Frame moved =
        table ? KDL::Frame(KDL::Rotation::RotZ(radians(gone))) : KDL::Frame(KDL::Vector(gone / 1000, 0, 0));
    return origin * moved * object;
  }
  // mm and the turn in degrees from there.
  [[nodiscard]] KDL::Frame tip_on_product() { return product_now().Inverse() * kdl.at(cell.out.command); }
  [[nodiscard]] KDL::Vector tip() { return 1000 * tip_on_product().p; }
  [[nodiscard]] bool stands() {
    return std::all_of(cell.out.speed.begin(), cell.out.speed.end(), [](double v) { return std::abs(v) < 1e-9; });
  }
  [[nodiscard]] std::string message() const { return cell.out.job.message; }
  // From one place of the product straight to the other, as far as `near` mm.
  void expect_on_line(const KDL::Vector& from, const KDL::Vector& to, double near) {
    const KDL::Vector along = to - from;
    const double part = KDL::dot(tip() - from, along) / KDL::dot(along, along);
    EXPECT_LT((tip() - from - along * part).Norm(), near) << "at " << time;
    EXPECT_GT(part * along.Norm(), -near);
    EXPECT_LT((part - 1) * along.Norm(), near);
  }
  void expect_at(const KDL::Vector& place, double near) { EXPECT_LT((tip() - place).Norm(), near) << "at " << time; }

  static constexpr Eight kAlongY{450, -150, 250, 0, 0, 90};
  std::function<double(double)> belt;  // mm or degrees at a time
  double resolution = 1e-4;
  bool reported = true;
  double time = 0, zero = 0, hardness = 1;
  bool failed = false, table = false;
  KDL::Frame origin, object;
  KdlTip kdl;
  Judge judge;
};

}  // namespace indurop::robot
