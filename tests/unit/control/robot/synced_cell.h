// SPDX-License-Identifier: Apache-2.0
// A cell with an axis that belongs to no group, axis 7. Every set point of all axes is judged, and orocos-kdl measures
// how far the tool has gone.

#pragma once

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <string>
#include <utility>

#include "command_cell.h"
#include "drive_faults.h"
#include "limit_judge.h"
#include "robot_fixture.h"

namespace indurop::robot {

// The file of an arm with a joint "feeder" that slides, endlessly for what tests do with it.
inline std::string with_feeder(std::string urdf, double velocity = 10, const std::string& range = "-1000 1000") {
  const std::size_t root = urdf.find("<link name=\"") + 12;
  const std::string base = urdf.substr(root, urdf.find('"', root) - root);
  const std::string lower = range.substr(0, range.find(' '));
  const std::string upper = range.substr(range.find(' ') + 1);
  const std::string feeder =
      fmt::format(R"(<link name="wire"/><joint name="feeder" type="prismatic"><parent link="{}"/><child link="wire"/>)"
                  R"(<axis xyz="0 0 1"/><limit lower="{}" upper="{}" velocity="{}" effort="1"/></joint>)"
                  R"(<single_axes joints="feeder"/>)",
                  base, lower, upper, velocity);
  return urdf.insert(urdf.rfind("</robot>"), feeder);
}

class SyncedCell : public CommandCell {
 public:
  static constexpr int kFeeder = 7;
  static constexpr std::size_t kAt = 6;  // its index

  explicit SyncedCell(double period_ms = 10, double velocity = 10, const std::string& range = "-1000 1000",
                      const std::string& job = "")
      : CommandCell(period_ms, in_tick(), with_feeder(cell_spec().urdf(), velocity, range), job),
        period_(period_ms / 1000),
        most_{velocity * 1000, velocity * 1000 / 0.25, velocity * 1000 / 0.025},
        judge_(period_, cell_spec().urdf()),
        places_(cell_spec(), KDL::Frame::Identity()) {}
  static Settings in_tick() {
    Settings settings;
    settings.plan_in_tick = true;
    return settings;
  }

  [[nodiscard]] bool start() {
    const bool group = cell.serve(Service::GroupEnable);
    const Given power = give(kFeeder, AxisService::PowerOn);
    return group && until([&] { return state(power) == CommandState::Done; });
  }
  // The tool stands in front of the arm.
  [[nodiscard]] bool go_to_begin() {
    const Given there =
        give(Service::DirectAbsolute, {500, 100, 400, 180, 0, 180}, 0, BufferMode::Aborting, CoordSystem::Machine);
    const bool arrived = until([&] { return ended(there); }) && state(there) == CommandState::Done;
    way = 0;
    return arrived;
  }
  [[nodiscard]] bool reset_group() {
    cell.ask(Service::GroupReset);
    return until([&] { return cell.out.done == cell.in.service.number; }) && cell.out.error == ErrorCode::Ok;
  }
  // The hardness of a stop in progress is allowed for.
  void step(double hardness = 1) {
    const KDL::Vector before = places_.at(cell.out.command).tip;
    const double feeder = cell.out.command[kAt];
    cell.step();
    const KDL::Vector by = places_.at(cell.out.command).tip - before;
    gone = 1000 * std::sqrt(KDL::dot(by, by));  // Norm() of orocos-kdl is 0 below 1 um
    fed = cell.out.command[kAt] - feeder;
    way += gone;
    EXPECT_EQ(judge_.look(cell, hardness), "") << "period " << cell.periods;
    judge_feeder(hardness);
  }
  template <class Condition>
  [[nodiscard]] bool until(const Condition& condition, int most = 4000, double hardness = 1) {
    for (int i = 0; i < most && !testing::Test::HasFailure(); ++i) {
      if (condition()) {
        return true;
      }
      step(hardness);
    }
    return condition();
  }
  Given follow(double numerator, double denominator = 1, BufferMode buffer = BufferMode::Aborting) {
    const Given given = give(kFeeder, AxisService::FollowPath, numerator, 0, buffer);
    command(given).to[1] = denominator;
    return given;
  }
  Given line(double x, double y, double z, double velocity = 200, BufferMode buffer = BufferMode::Buffered,
             double transition = 0) {
    return give(Service::LinearAbsolute, {x, y, z, 180, 0, 180}, velocity, buffer, CoordSystem::Machine, transition);
  }

  double gone = 0;  // mm of the tool in the last period
  double fed = 0;   // mm of the feeder in the last period
  double way = 0;   // mm of the tool

 private:
  void judge_feeder(double hardness) {
    const double p = cell.out.command[kAt];
    if (cell.in.drives[kAt].status != 0x27 || cell.in.drives[kAt].mode != 8) {
      seen_ = {p, 0, 0};
      return;
    }
    const double v = (p - seen_[0]) / period_;
    const double a = (v - seen_[1]) / period_;
    const double j = (a - seen_[2]) / period_;
    const double rounding = 8 * 1e-7 / (period_ * period_ * period_);  // mm, of tool paths
    EXPECT_LE(std::abs(v), most_[0] * 1.001) << "period " << cell.periods;
    EXPECT_LE(std::abs(a), most_[1] * 1.001 * hardness) << "period " << cell.periods;
    EXPECT_LE(std::abs(j), most_[2] * 1.001 * hardness * hardness + rounding) << "period " << cell.periods;
    seen_ = {p, v, a};
  }

  double period_;
  std::array<double, 3> most_;  // mm/s and so on
  std::array<double, 3> seen_{};
  Judge judge_;
  KdlPlaces places_;
};

}  // namespace indurop::robot
