// SPDX-License-Identifier: Apache-2.0
// A cell with axes that follow others, every set point of which is judged.

#pragma once

#include <fmt/format.h>

#include <utility>
#include <vector>

#include "command_cell.h"
#include "limit_judge.h"
#include "robot_fixture.h"

namespace indurop::robot {

class FollowCell : public testing::Test, public CommandCell {
 public:
  // `urdf`: of another arm. `rounding`: of its set points, rad.
  explicit FollowCell(double period_ms = 10, const std::string& urdf = "", double rounding = 1e-14)
      : CommandCell(period_ms, in_tick(), urdf),
        judge_(period_ms / 1000, urdf.empty() ? cell_urdf() : urdf, rounding) {}
  static Settings in_tick() {
    Settings settings;
    settings.plan_in_tick = true;
    return settings;
  }

 protected:
  void SetUp() override { power_on({1, 2, 3}); }
  void power_on(std::initializer_list<int> all) {
    for (const int i : all) {
      ASSERT_TRUE(done(give(i, AxisService::PowerOn)));
    }
  }
  Given gear(int slave, int master, double numerator, double denominator = 1,
             BufferMode buffer = BufferMode::Aborting) {
    const Given given = give(slave, AxisService::GearIn, numerator, 0, buffer);
    command(given).to[1] = denominator;
    command(given).option = static_cast<std::int16_t>(master);
    return given;
  }
  // A place of a table, and what is asked of it.
  Given select(std::int16_t number, const std::vector<std::pair<double, double>>& points, bool periodic) {
    CamTable& table = cell.in.cams[static_cast<std::size_t>(number) - 1];
    table.points = static_cast<std::int16_t>(points.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
      table.master[i] = points[i].first;
      table.slave[i] = points[i].second;
    }
    const Given given = give(Service::SelectCam);
    command(given).option = number;
    command(given).job = periodic ? 1 : 0;
    return given;
  }
  struct CamUse {
    double master_offset = 0, slave_offset = 0, master_scale = 1, slave_scale = 1;
    bool master_absolute = true, slave_absolute = true;
  };
  Given cam(int slave, int master, std::int16_t number, const CamUse& use) {
    const Given given = give(slave, AxisService::CamIn);
    Command& c = command(given);
    c.option = static_cast<std::int16_t>(master);
    c.job = number;
    c.to = {use.master_offset, use.slave_offset, use.master_scale, use.slave_scale};
    c.aux = {use.master_absolute ? 1.0 : 0.0, use.slave_absolute ? 1.0 : 0.0};
    return given;
  }
  void step() {
    for (std::size_t i = 0; i < kJoints; ++i) {
      before_[i] = cell.out.command[i];
    }
    cell.step();
    EXPECT_EQ(judge_.look(cell, 1), "") << "period " << cell.periods;
  }
  template <class Condition>
  [[nodiscard]] bool until(const Condition& condition, int most = 3000) {
    for (int i = 0; i < most && !HasFailure(); ++i) {
      if (condition()) {
        return true;
      }
      step();
    }
    return false;
  }
  // As that of CommandCell, under the judge.
  [[nodiscard]] bool done(const Given& given) {
    return until([&] { return ended(given); }) && state(given) == CommandState::Done;
  }
  [[nodiscard]] double moved(std::size_t i) const { return cell.out.command[i] - before_[i]; }

  Judge judge_;
  std::array<double, kJoints> before_{};
};

}  // namespace indurop::robot
