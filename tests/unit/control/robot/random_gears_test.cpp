// SPDX-License-Identifier: Apache-2.0
// Axes in gear and on cams while masters and followers are commanded at random: no set point breaks a limit.
// INDUROP_ROBOT_GEARS says how many random runs, INDUROP_ROBOT_SEED from which one on.

#include <fmt/format.h>

#include <functional>
#include <random>

#include "control/robot/axis/cam.h"
#include "follow_cell.h"
#include "robot_fixture.h"

namespace indurop::robot {
namespace {

// Each period one thing or none happens: a motion of the master, a gear or a cam, a motion of the follower or on
// top of one of them, a stop.
class RandomGears : public FollowCell {
 public:
  RandomGears(unsigned seed, double period_ms)
      : FollowCell(period_ms), random_(seed), between_(static_cast<int>(std::max(60.0, 240 / period_ms))) {}
  void TestBody() override {}
  void run(int periods) {
    power_on({1, 2, 3});
    for (int i = 0; i < periods && !HasFailure(); ++i) {
      if (one_of(between_) == 0) {
        act();
      }
      const bool was = reached(in_) && state(in_) == CommandState::Active;
      step();
      const bool is = reached(in_) && state(in_) == CommandState::Active;
      if (was && is) {
        ++geared_;
        if (place_) {
          ASSERT_NEAR(joint(1), place_(joint(0)), 1e-7) << "period " << i;
        } else {
          ASSERT_NEAR(moved(1), ratio_ * moved(0), 2e-8) << "period " << i;
        }
      }
      ASSERT_NE(cell.out.state, GroupState::ErrorStop)
          << "period " << i << ", error " << static_cast<int>(cell.out.error) << " of axis " << cell.out.error_axis;
    }
  }
  [[nodiscard]] long geared() const { return geared_; }

 private:
  int one_of(int many) { return std::uniform_int_distribution<int>(0, many - 1)(random_); }
  double in(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random_); }
  void softly(const Given& given) {
    Command& c = command(given);
    c.acceleration = in(30, 900);
    c.deceleration = in(30, 900);
    c.jerk = in(500, 9000);
  }
  void act() {
    switch (one_of(10)) {
      case 0:
      case 1:
        softly(give(1, AxisService::MoveAbsolute, in(-90, 90), in(5, 150)));
        break;
      case 2:
        softly(give(1, AxisService::MoveVelocity, 0, in(-60, 60)));
        break;
      case 3:
        place_ = nullptr;
        ratio_ = in(-1.5, 1.5);
        in_ = gear(2, 1, ratio_);
        softly(in_);
        break;
      case 4:
        random_cam();
        break;
      case 5:
        softly(give(2, AxisService::MoveAbsolute, in(-60, 60), in(5, 150)));
        break;
      case 6:
        softly(give(1, AxisService::MoveSuperimposed, in(-40, 40), in(5, 60)));
        break;
      case 7:
        if (!place_) {
          softly(give(2, AxisService::MoveSuperimposed, in(-40, 40), in(5, 60)));
        } else {
          give(2, AxisService::HaltSuperimposed);
        }
        break;
      case 8:
        give(2, one_of(2) == 0 ? AxisService::Decouple : AxisService::Halt);
        break;
      default:
        command(give(2, AxisService::Stop)).execute = 0;
    }
  }

  // Of the numbers of its users, as the standard has them.
  void random_cam() {
    std::vector<std::pair<double, double>> points{{in(-60, 0), in(-20, 20)}};
    for (int many = one_of(5) + 2; many > 0; --many) {
      points.emplace_back(points.back().first + in(30, 80), in(-20, 20));
    }
    const bool periodic = one_of(2) == 0;
    if (periodic) {
      points.back().second = points.front().second;
    }
    select(2, points, periodic);
    Cam cam;
    ASSERT_EQ(cam.set(cell.in.cams[1], periodic), ErrorCode::Ok);
    const CamUse use{in(-30, 30), in(-20, 20), in(0.5, 2), in(-1.5, 1.5), true, true};
    place_ = [cam, use](double master) {
      return use.slave_offset + use.slave_scale * cam.at((master - use.master_offset) / use.master_scale);
    };
    in_ = this->cam(2, 1, 2, use);
    softly(in_);
    command(in_).velocity = in(10, 150);
  }

  std::mt19937 random_;
  int between_;                          // periods from one thing to the next, about
  std::function<double(double)> place_;  // of a cam
  Given in_;
  double ratio_ = 0;
  long geared_ = 0;
};

TEST(RandomGear, Breaks_no_limit_and_keeps_the_ratio) {
  const long runs = number_of("INDUROP_ROBOT_GEARS", 40);
  const long first = number_of("INDUROP_ROBOT_SEED", 1);
  long geared = 0;
  for (long i = first; i < first + runs && !HasFailure(); ++i) {
    SCOPED_TRACE(fmt::format("INDUROP_ROBOT_SEED={}", i));
    const double period_ms = std::array{10.0, 4.0, 10.0, 4.0, 0.1}[static_cast<std::size_t>(i) % 5];
    RandomGears sut(static_cast<unsigned>(i), period_ms);
    sut.run(period_ms < 1 ? 40'000 : 4000);
    geared += sut.geared();
  }
  EXPECT_GT(geared, runs * 100);
}

}  // namespace
}  // namespace indurop::robot
