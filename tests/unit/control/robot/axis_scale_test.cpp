// SPDX-License-Identifier: Apache-2.0
// Drives that count in their own way: each axis with its own counts, direction, gear and zero. What the arm does is the
// same as with drives that all count alike, and each drive gets what the formula of the docs gives.
#include <cmath>
#include <random>

#include "group_cell.h"
#include "robot_fixture.h"

namespace indurop::robot {
namespace {

constexpr std::size_t kSix = 6;

struct Ways {
  std::vector<double> counts, zero;

  [[nodiscard]] std::int32_t count(std::size_t axis, double degree) const {
    return static_cast<std::int32_t>(std::llround((degree - zero[axis]) * counts[axis] / 360));
  }
};

Ways any_ways(std::mt19937& random) {
  Ways ways;
  for (std::size_t i = 0; i < kSix; ++i) {
    const double counts = std::uniform_real_distribution<double>(2e5, 2e7)(random);
    ways.counts.push_back(random() % 2 == 0 ? counts : -counts);
    ways.zero.push_back(std::uniform_real_distribution<double>(-90, 90)(random));
  }
  return ways;
}

void start(Cell& cell) {
  EXPECT_TRUE(cell.serve(Service::GroupEnable));
  cell.in.service.job = 1;
  cell.ask(Service::JobStart);
}

TEST(Axis_scale, Drives_of_any_counts_directions_and_zeros_move_the_arm_alike) {
  constexpr const char* kJob = "SPEED 100%\nMOVJ P1\nMOVL P2\nMOVJ P1\n";
  std::mt19937 random(3);
  for (int run = 0; run < 10; ++run) {
    const Ways ways = any_ways(random);
    Settings settings;
    settings.counts_per_turn = ways.counts;
    settings.zero = ways.zero;
    Cell alike(kJob);
    Cell sut(kJob, 10, 0, true, settings);
    for (std::size_t i = 0; i < kSix; ++i) {
      sut.in.drives[i].position = ways.count(i, 0);
    }
    start(alike);
    start(sut);
    int seen = 0;
    for (int k = 0; k < 1000 && alike.out.job.state != JobState::Ended; ++k) {
      alike.step();
      sut.step();
      for (std::size_t i = 0; i < kSix; ++i) {
        // Where it begins is a count off at most.
        ASSERT_NEAR(sut.out.command[i], alike.out.command[i], 0.002) << "axis " << i + 1 << ", period " << k;
        ASSERT_NEAR(sut.out.drives[i].position, ways.count(i, sut.out.command[i]), 1) << "axis " << i + 1;
        ASSERT_NEAR(sut.out.joints[i], alike.out.joints[i], 0.005);
      }
      ++seen;
    }
    EXPECT_EQ(sut.out.job.state, JobState::Ended);
    EXPECT_GT(seen, 100);
  }
}

// Homing calls the mark count 0, and the joint is at `zero` there.
TEST(Axis_scale, The_mark_of_homing_is_where_zero_says) {
  Settings settings;
  settings.absolute = false;
  settings.zero = {10, -20, 30, 0, 45, -5};
  settings.counts_per_turn = {-1'320'000};
  Cell sut("", 10, 0, true, settings);
  ASSERT_TRUE(sut.serve(Service::GroupEnable));
  ASSERT_TRUE(sut.serve(Service::GroupHome));
  for (std::size_t i = 0; i < kSix; ++i) {
    EXPECT_NEAR(sut.out.joints[i], settings.zero[i], 1e-3);
  }
}

}  // namespace
}  // namespace indurop::robot
