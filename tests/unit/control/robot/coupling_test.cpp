// SPDX-License-Identifier: Apache-2.0
// Rounding of followers: it grows with the ratio and with where the master is, and is no reason to leave it.
#include "control/robot/axis/coupling.h"

#include <cmath>
#include <random>
#include <utility>

#include "follow_cell.h"

namespace indurop::robot {
namespace {

// What a law passes on is proportional to what it is computed from: steps that are too short to bend it show nothing
// but rounding, whatever the ratio and wherever its master is.
TEST(CouplingLaws, Round_no_further_than_they_say) {
  std::mt19937 random(5);
  const auto in = [&random](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  const auto decades = [&in](double low, double high) { return std::exp(in(std::log(low), std::log(high))); };
  double most = 0;
  for (int i = 0; i < 20'000; ++i) {
    const double far = decades(1e-3, 1e7);
    CouplingLaw law;
    law.ratio = decades(1e-6, 1e6);
    law.master_zero = i % 2 == 0 ? 0 : in(-far, far);
    law.slave_zero = in(-3, 3);
    double master = in(-far, far);
    double step = 1e-9 * decades(1e-6, 1);
    if (i % 3 == 1) {
      CamTable table;
      table.points = 5;
      for (std::size_t k = 0; k < 5; ++k) {
        table.master[k] = 60 * static_cast<double>(k) + in(0, 30);
        table.slave[k] = in(-20, 20);
      }
      ASSERT_EQ(law.cam.set(table, i % 2 == 0), ErrorCode::Ok);
      law.master_scale = decades(1e-3, 1e3) * kPi / 180;
      law.slave_scale = decades(1e-3, 1e3) * kPi / 180;
    } else if (i % 3 == 2) {
      const double to = in(-far, far);
      const double from = to + in(-3, 3);
      law.approach = {from, to, in(-3, 3), law.slave_zero, law.ratio};
      master = from + in(0, 1) * (to - from);
      step *= std::abs(to - from);
    }
    double third = 0;
    for (const auto& [k, factor] : {std::pair{0, -1.0}, {1, 3.0}, {2, -3.0}, {3, 1.0}}) {
      third += factor * law.at(master + k * step);
    }
    const double part = std::abs(third) / (8 * law.rounding_at(master, 0));
    ASSERT_LE(part, 1) << i << " ratio " << law.ratio << " master " << master;
    most = std::max(most, part);
  }
  EXPECT_GT(most, 0.1) << "it says no more than ten times what it is";
}

// The periods are short, so that differences of set points show their rounding.
class EndlessGears : public FollowCell {
 public:
  EndlessGears() : FollowCell(0.1, endless(), 1e-10) {}

 protected:
  void SetUp() override {}
  // The ratio is kept at constant speeds of the master, here 4 and 20 deg/s of the follower.
  void follow(double ratio) {
    const Given in = gear(2, 1, ratio);
    for (const double speed : {4.0, 20.0}) {
      Command& master = command(give(1, AxisService::MoveVelocity, 0, speed / std::abs(ratio)));
      master.acceleration = 100 / std::abs(ratio);
      master.jerk = 2000 / std::abs(ratio);
      ASSERT_TRUE(until([&] { return reached(in) && std::abs(moved(1)) > 0.99e-4 * speed; }, 30'000))
          << ratio << " error " << static_cast<int>(error(in));
      for (int i = 0; i < 2000; ++i) {
        step();
        ASSERT_TRUE(reached(in)) << ratio << " error " << static_cast<int>(error(in));
        ASSERT_NEAR(moved(1), ratio * moved(0), 1e-7) << ratio;
      }
    }
    for (const int i : {2, 1}) {
      const Given halt = give(i, AxisService::Halt);
      ASSERT_TRUE(until([&] { return ended(halt); }, 30'000));
    }
  }
  static std::string endless() {
    std::string urdf = cell_urdf();
    const std::string kind = "type=\"revolute\"";
    for (std::size_t at = urdf.find(kind); at != std::string::npos; at = urdf.find(kind)) {
      urdf.replace(at, kind.size(), "type=\"continuous\"");
    }
    return urdf;
  }
};

TEST_F(EndlessGears, Keep_large_ratios) {
  power_on({1, 2});
  const Given there = give(1, AxisService::MoveAbsolute, 170);
  ASSERT_TRUE(until([&] { return ended(there); }, 30'000));
  for (const double ratio : {0.1, 1.0, -1e3, 1e5}) {
    follow(ratio);
  }
}

TEST_F(EndlessGears, Keep_their_ratio_after_thousands_of_turns_of_the_master) {
  cell.in.drives[0].position = 1'890'000'000;  // 1432 turns
  power_on({1, 2});
  for (const double ratio : {0.1, 1.0, -25.0}) {
    follow(ratio);
  }
}

}  // namespace
}  // namespace indurop::robot
