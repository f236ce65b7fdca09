// SPDX-License-Identifier: Apache-2.0
// A single axis follows the tool on random paths that are held, slowed down, replaced and stopped at random: each of
// its steps is the ratio times the distance that orocos-kdl computes from the set points of the arm, and no set point
// of any axis breaks a limit. INDUROP_ROBOT_SYNCS says how many random runs, INDUROP_ROBOT_SEED from which one on.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <random>

#include "synced_cell.h"

namespace indurop::robot {
namespace {

class RandomFollowers : public SyncedCell {
 public:
  RandomFollowers(unsigned seed, double period_ms)
      : SyncedCell(period_ms), random_(seed), between_(static_cast<int>(300 / period_ms)) {}

  void run(int many) {
    ASSERT_TRUE(start());
    ASSERT_TRUE(go_to_begin());
    for (int i = 0; i < many && !testing::Test::HasFailure(); ++i) {
      if (one_of(between_) == 0) {
        act();
      }
      step_and_compare();
      // A fault of the path itself, a singular position for example, is not the topic here.
      if (cell.out.state == GroupState::ErrorStop) {
        ASSERT_TRUE(reset_group());
        synced_ = false;
      }
    }
  }
  // How long it was in step, mm of the tool meanwhile, and how often it left.
  long periods = 0;
  double together = 0;
  int errors = 0;

 private:
  int one_of(int many) { return std::uniform_int_distribution<int>(0, many - 1)(random_); }
  double in(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random_); }

  void step_and_compare() {
    const bool was = synced_;
    step();
    synced_ = sut_.number != 0 && reached(sut_) && state(sut_) == CommandState::Active;
    if (sut_.number != 0 && state(sut_) == CommandState::Error) {
      ++errors;
      EXPECT_THAT(error(sut_),
                  testing::AnyOf(ErrorCode::Speed, ErrorCode::Acceleration, ErrorCode::Jerk, ErrorCode::Master));
      sut_ = {};
    }
    if (was && synced_) {
      sum_ += ratio_ * gone;
      ++periods;
      together += gone;
      ASSERT_NEAR(fed, ratio_ * gone, 1e-5) << "period " << cell.periods << ", " << last_;
      ASSERT_NEAR(cell.out.command[kAt] - from_, sum_, 1e-3) << "period " << cell.periods;
    } else if (synced_) {
      from_ = cell.out.command[kAt];
      sum_ = 0;
    }
  }

  void act() {
    last_ = one_of(14);
    switch (last_) {
      case 0:
        cell.in.hold = !cell.in.hold;
        break;
      case 1:
        cell.in.speed_override = in(0, 120);
        break;
      case 2:
        cell.in.hold = false;
        cell.in.speed_override = 100;
        break;
      case 3:
        give(Service::Halt);
        break;
      case 4:
      case 5:
      case 6:
        line(in(350, 600), in(-300, 300), in(250, 500), in(20, 800),
             one_of(4) == 0 ? BufferMode::Aborting : BufferMode::BlendingLow, in(0, 60));
        break;
      case 7: {
        const Given circle = give(Service::CircularAbsolute, {in(400, 500), in(-100, 100), in(300, 400), 180, 0, 180},
                                  in(20, 500), BufferMode::Buffered, CoordSystem::Machine);
        command(circle).aux = {in(350, 600), in(-200, 200), in(250, 500)};
        break;
      }
      case 8:
        give(Service::DirectAbsolute, {in(-40, 40), in(-10, 30), in(-40, 0), in(-20, 20), in(50, 100), in(-60, 60)},
             in(5, 100), one_of(2) == 0 ? BufferMode::Aborting : BufferMode::Buffered);
        break;
      case 9:
      case 10:
      case 11:
        ratio_ = in(-1.5, 1.5);
        synced_ = false;
        sut_ = follow(ratio_);
        command(sut_).acceleration = in(2000, 40000);
        break;
      case 12:
        give(kFeeder, AxisService::MoveAbsolute, in(-500, 500), in(50, 2000));
        break;
      default:
        give(kFeeder, AxisService::MoveSuperimposed, in(-50, 50), in(50, 500));
    }
  }

  std::mt19937 random_;
  int between_;  // periods from one thing to the next, about
  Given sut_;
  int last_ = 0;
  double ratio_ = 0;
  bool synced_ = false;
  double from_ = 0, sum_ = 0;
};

TEST(RandomFollowPath, Is_the_ratio_times_the_way_and_breaks_no_limit) {
  const long runs = number_of("INDUROP_ROBOT_SYNCS", 20);
  const long first = number_of("INDUROP_ROBOT_SEED", 1);
  long periods = 0;
  double together = 0;
  int errors = 0;
  for (long i = first; i < first + runs && !testing::Test::HasFailure(); ++i) {
    SCOPED_TRACE(fmt::format("INDUROP_ROBOT_SEED={}", i));
    RandomFollowers sut(static_cast<unsigned>(i), std::array{10.0, 4.0, 1.0}[static_cast<std::size_t>(i) % 3]);
    sut.run(4000);
    periods += sut.periods;
    together += sut.together;
    errors += sut.errors;
  }
  fmt::print("in step for {} periods and {:.1f} m; left {} times\n", periods, together / 1000, errors);
  EXPECT_GT(periods, runs * 400);
}

}  // namespace
}  // namespace indurop::robot
