// SPDX-License-Identifier: Apache-2.0
// A program lets the tool press in random directions, with sensors that say anything, holds and overrides, and ends it
// in random ways: no set point breaks a limit, and the distance from the path and its rate, as differences of set
// points, are within what the command declares. INDUROP_ROBOT_PRESSES says how many runs, INDUROP_ROBOT_SEED from which
// one on.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "press_command_cell.h"

namespace indurop::robot {
namespace {

class Random_press_commands : public PressCommandCell {
 protected:
  int one_of(int many) { return std::uniform_int_distribution<int>(0, many - 1)(random); }
  double in(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random); }
  Vec3 forces(double most) { return {in(-most, most), in(-most, most), in(-most, most)}; }
  // Something that happens about every `s`.
  bool every(double s) { return one_of(static_cast<int>(s / period)) == 0; }

  CommandCell::Given begin() {
    limit = in(1, 15);
    rate = in(2, 60);
    Vec3 stiffness(in(0.5, 40), in(0.5, 40), in(0.5, 40));
    for (int k = 0; k < 2; ++k) {
      stiffness[k] *= one_of(2);
    }
    return press(forces(20), stiffness, 1e4, limit, rate);
  }
  void say_anything() {
    sensor = [this, left = 0, said = Vec3()]() mutable {
      if (--left < 0) {
        left = one_of(static_cast<int>(0.6 / period));
        said = forces(60);
        wanted = one_of(3) == 0 ? forces(20) : wanted;
      }
      return Vec3(said + forces(1));
    };
  }
  void at_standstill(double seconds) {
    Vec3 before = shift();
    for (double t = 0; t < seconds && !HasFailure(); t += period) {
      step();
      EXPECT_LE(shift().norm(), limit + 1e-3) << cell().periods;
      EXPECT_LE((shift() - before).norm() / period, rate * 1.001 + 0.01) << cell().periods;
      before = shift();
      if (every(0.5)) {
        cell().in.hold = one_of(3) == 0;
        cell().in.speed_override = one_of(2) == 0 ? 100 : one_of(100);
      }
    }
    cell().in.hold = false;
    cell().in.speed_override = 100;
  }
  // Along x.
  void along_a_line(double seconds) {
    line(200 + in(50, 400), 0, 1300, in(20, 400));
    for (double t = 0; t < seconds && !HasFailure(); t += period) {
      step();
      EXPECT_LE(std::hypot(shift()[1], shift()[2]), limit + 1e-3) << cell().periods;
    }
  }
  // 0: released, 1: MC_GroupHalt, 2: MC_GroupStop, 3: emergency stop, 4: the program stops.
  void end(const CommandCell::Given& given, int kind) {
    if (kind == 0) {
      release();
    } else if (kind <= 2) {
      sut->give(kind == 1 ? Service::Halt : Service::Stop);
    } else {
      cell().in.emergency = kind == 3;
      talks = kind == 3;
    }
    ASSERT_TRUE(
        until([&] { return sut->ended(given) && cell().out.tool_speed == 0; }, 100'000, kind == 3 ? kEmergency : 1));
    EXPECT_EQ(sut->state(given), kind == 0   ? CommandState::Done
                                 : kind <= 2 ? CommandState::Aborted
                                             : CommandState::Error);
    talks = true;
  }
  std::mt19937 random;
  double limit = 0;
  double rate = 0;
};

TEST_F(Random_press_commands, Break_no_limit_however_they_end) {
  const int seed = number_of("INDUROP_ROBOT_SEED", 1);
  const int runs = number_of("INDUROP_ROBOT_PRESSES", 20);
  for (int each = seed; each < seed + runs && !HasFailure(); ++each) {
    SCOPED_TRACE(each);
    random.seed(static_cast<unsigned>(each));
    constexpr std::array<double, 5> kPeriods{0.5, 1, 2, 4, 10};
    sensor = nullptr;
    start(kPeriods[static_cast<std::size_t>(one_of(5))]);
    const CommandCell::Given given = begin();
    say_anything();
    at_standstill(in(0.2, 3));
    along_a_line(in(0, 1));
    end(given, one_of(5));
  }
}

}  // namespace
}  // namespace indurop::robot
