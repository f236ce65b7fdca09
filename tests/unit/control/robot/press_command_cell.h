// SPDX-License-Identifier: Apache-2.0
// A cell in which a program lets the tool press, as the block RobotPress does. Every set point is judged.

#pragma once

#include <cmath>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "command_cell.h"
#include "limit_judge.h"
#include "press_springs.h"
#include "robot_fixture.h"

namespace indurop::robot {

class PressCommandCell : public testing::Test {
 protected:
  // Stands at A, with the tool downwards.
  void start(double period_ms = 4, const std::string& job = "") {
    period = period_ms / 1000;
    Settings settings;
    settings.plan_in_tick = true;
    sut = std::make_unique<CommandCell>(period_ms, settings, urdf_of("gantry"), job);
    judge = std::make_unique<Judge>(period, urdf_of("gantry"));
    pressing.reset();
    force = Vec3::Zero();
    ASSERT_TRUE(cell().serve(Service::GroupEnable));
    ASSERT_TRUE(done(to_a()));
  }
  Cell& cell() { return sut->cell; }
  CommandCell::Given to_a() {
    return sut->give(Service::DirectAbsolute, kA, 0, BufferMode::Aborting, CoordSystem::Machine);
  }
  CommandCell::Given line(double x, double y, double z, double velocity, BufferMode buffer = BufferMode::Buffered) {
    return sut->give(Service::LinearAbsolute, {x, y, z, 180, 0, 0}, velocity, buffer, CoordSystem::Machine);
  }
  // Along the axes of the base.
  CommandCell::Given press(const Vec3& wanted_force, const Vec3& stiffness, double most = 60, double limit = 10,
                           double rate = 10, double age = 0) {
    wanted = wanted_force;
    pressing = sut->give(Service::Press, {}, rate, BufferMode::Aborting, CoordSystem::Machine);
    Command& c = sut->command(*pressing);
    c.aux = {stiffness[0], stiffness[1], stiffness[2], most, limit, age, 0, 0};
    c.execute = 1;
    tell();
    return *pressing;
  }
  [[nodiscard]] Vec3 shift() const {
    return {sut->cell.out.position[0] - kA[0], sut->cell.out.position[1] - kA[1], sut->cell.out.position[2] - kA[2]};
  }
  void tell() {
    if (pressing && talks && sut->command(*pressing).number == pressing->number) {
      Command& c = sut->command(*pressing);
      for (std::size_t i = 0; i < 3; ++i) {
        c.to[i] = wanted[static_cast<Eigen::Index>(i)];
        c.to[3 + i] = force[static_cast<Eigen::Index>(i)];
      }
      c.to[6] = count;
      ++c.updates;
    }
  }
  void step(double hardness = 1) {
    if (sensor) {
      force = sensor();
    }
    tell();
    cell().step();
    EXPECT_EQ(judge->look(cell(), hardness), "") << "period " << cell().periods;
  }
  template <class Condition>
  bool until(const Condition& condition, int most = 8000, double hardness = 1) {
    for (int i = 0; i < most && !HasFailure(); ++i) {
      if (condition()) {
        return true;
      }
      step(hardness);
    }
    return condition();
  }
  bool done(const CommandCell::Given& given) {
    return until([&] { return sut->ended(given); }) && sut->state(given) == CommandState::Done;
  }
  void floor(double stiffness, double depth) {
    Springs springs;
    springs.add(stiffness, -Vec3::UnitZ(), depth);
    sensor = [this, springs] { return springs.force(shift()); };
  }
  void release() { sut->command(*pressing).execute = 0; }

  static constexpr std::array<double, 8> kA{200, 0, 1300, 180, 0, 0};
  std::unique_ptr<CommandCell> sut;
  std::unique_ptr<Judge> judge;
  std::optional<CommandCell::Given> pressing;
  std::function<Vec3()> sensor;
  Vec3 wanted = Vec3::Zero();
  Vec3 force = Vec3::Zero();
  double count = 0;
  double period = 0.004;
  bool talks = true;
};

}  // namespace indurop::robot
