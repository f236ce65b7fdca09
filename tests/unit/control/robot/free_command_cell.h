// SPDX-License-Identifier: Apache-2.0
// A cell with the arm of the scenes that is given free motions by commands, and whose set points are judged.

#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <sstream>
#include <string>

#include "command_cell.h"
#include "limit_judge.h"
#include "solid_reference.h"

namespace indurop::robot {

// Whether the tick finds plans ready: the thread has to seem late.
inline bool& plans_are_ready() {
  static bool is = true;
  return is;
}

// The numbers of a point with joint angles, as the job has them.
inline std::array<double, 8> numbers_of(const std::string& job, const std::string& point) {
  const std::string begin = "POINT " + point + " = JOINT";
  std::istringstream text(job.substr(job.find(begin) + begin.size()));
  std::array<double, 8> numbers{};
  for (std::size_t i = 0; i < 6; ++i) {
    text >> numbers[i];
  }
  return numbers;
}

class Free_command : public testing::Test {
 protected:
  using Given = CommandCell::Given;
  static constexpr double kPeriod = 0.004;  // s
  static constexpr double kCounts = 1'320'000 / 360.0;

  // The arm of the scenes stands at these angles, with power.
  void begin(const std::string& job, const std::array<double, 8>& start, Settings settings = {}) {
    settings.learned = [](bool what) noexcept -> bool { return what && plans_are_ready(); };
    plans_are_ready() = true;
    const std::string urdf = ReferenceArm::usual().urdf();
    sut = std::make_unique<CommandCell>(1000 * kPeriod, settings, urdf, job);
    for (std::size_t i = 0; i < 6; ++i) {
      sut->cell.in.drives[i].position = static_cast<std::int32_t>(std::lround(kCounts * start[i]));
    }
    sut->cell.step();
    judge = std::make_unique<Judge>(kPeriod, urdf);
    ASSERT_EQ(judge->look(sut->cell, 1), "");
    ASSERT_TRUE(sut->done(sut->give(Service::GroupEnable)));
  }
  Given free(const std::array<double, 8>& to, double seed = 0, double velocity = 0,
             BufferMode mode = BufferMode::Aborting, CoordSystem coords = CoordSystem::Axes, double within = 0) {
    const Given given = sut->give(Service::FreeAbsolute, to, velocity, mode, coords);
    sut->command(given).aux = {seed, within};
    return given;
  }
  void step(int periods = 1) {
    for (int i = 0; i < periods; ++i) {
      sut->cell.step();
      const std::string broken = judge->look(sut->cell, kEmergency);
      ASSERT_EQ(broken, "") << "period " << sut->cell.periods;
    }
  }
  // The state at its end.
  CommandState end_of(const Given& given) {
    for (int i = 0; i < 20000 && !sut->ended(given) && !HasFatalFailure(); ++i) {
      step();
    }
    return sut->state(given);
  }
  [[nodiscard]] const Outputs& out() const { return sut->cell.out; }
  [[nodiscard]] bool stands() const {
    return std::all_of(out().speed.begin(), out().speed.end(), [](double v) { return v == 0; });
  }
  [[nodiscard]] Joints commanded() const {
    Joints q = Joints::Zero();
    for (int i = 0; i < 6; ++i) {
      q[i] = radians(out().command[at(i)]);
    }
    return q;
  }

  std::unique_ptr<CommandCell> sut;
  std::unique_ptr<Judge> judge;
};

}  // namespace indurop::robot
