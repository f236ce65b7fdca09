// SPDX-License-Identifier: Apache-2.0
// Belts carry the tool towards walls that the robot has to keep out of: it stops before, wherever the wall is, by
// orocos-kdl.

#include <fmt/format.h>

#include <random>

#include "belt_cell.h"

namespace indurop::robot {
namespace {

// Next to the working area of the arm, mm.
struct Wall {
  explicit Wall(int seed) : random(static_cast<unsigned>(seed)), left(seed % 2 == 0), place(between(150, 400)) {}
  double between(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random); }
  [[nodiscard]] std::string line() const {
    return fmt::format("KEEPOUT wall = BOX -900 {} 0 900 {} 1500\n", left ? place : -place, left ? 900 : -900);
  }
  // mm of the tip before it.
  [[nodiscard]] double before(const KDL::Vector& tip) const { return place - 1000 * (left ? tip.y() : -tip.y()); }
  // Degrees about z: towards it.
  [[nodiscard]] double way() const { return left ? 90 : -90; }

  std::mt19937 random;
  bool left;
  double place;
};

class TrackedZones : public Belts, public testing::WithParamInterface<int> {
 protected:
  TrackedZones() : Belts(in_tick(), solid_cell_urdf(), Wall(GetParam()).line()) {}
};

TEST_P(TrackedZones, The_tool_gets_off_before_the_wall) {
  Wall wall(GetParam());
  const double speed = wall.between(20, 150);
  const double height = wall.between(100, 200);
  belt = [=](double t) { return speed * t; };
  begin_tracking({450, 0, 250, 0, 0, wall.way()}, {0, 0, 0, 0, 0, -wall.way()});
  const Given motion = product(0, 0, height);
  double nearest = 1e9;
  ASSERT_TRUE(until([&] {
    nearest = std::min(nearest, wall.before(kdl.at(cell.out.command).p));
    return cell.out.state == GroupState::ErrorStop || state(motion) == CommandState::Error;
  }));
  ASSERT_TRUE(until([&] { return cell.out.state != GroupState::Moving && cell.out.state != GroupState::Stopping; }));
  EXPECT_TRUE(stands());
  EXPECT_GT(nearest, 0);
  EXPECT_LT(nearest, 250);
  const ErrorCode code = cell.out.state == GroupState::ErrorStop ? cell.out.error : error(motion);
  EXPECT_EQ(code, ErrorCode::Collision) << to_string(code);
  EXPECT_NE(message().find("'wall' would touch"), std::string::npos) << message();
}

INSTANTIATE_TEST_SUITE_P(Walls, TrackedZones, testing::Range(1, 25));

}  // namespace
}  // namespace indurop::robot
