// SPDX-License-Identifier: Apache-2.0
#include "control/robot/plan/path_findings.h"

#include <gtest/gtest.h>

#include <random>
#include <vector>

#include "robot_fixture.h"

namespace indurop::robot {
namespace {

class Findings : public testing::Test {
 protected:
  Findings() {
    draft.joints = cell_limits();
    draft.segment.from = joints_of({0, 0.2, 0.1, 0, 0.8, 0});
    draft.segment.length = 2;
    draft.segment.limits = {1, 3, 30};
    sut.begin();
  }
  Rates any_rates() {
    Rates rates;
    for (int i = 0; i < 6; ++i) {
      rates.first[i] = in(0, 1);
      rates.second[i] = in(0, 4);
      rates.third[i] = in(0, 30);
    }
    return rates;
  }
  double in(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random); }

  Arm arm = cell_arm();
  Inverse inverse{arm};
  Places places{arm, inverse};
  Draft draft;
  PathFindings sut{places, draft};
  std::mt19937 random{3};
};

// Each part of the path has the lowest bound of all stretches that cover it, by a search through all of them.
TEST_F(Findings, Bound_the_parts_of_the_path_that_they_cover) {
  struct Stretch {
    double from, to, speed;
  };
  std::vector<Stretch> all;
  constexpr double kPart = 2.0 / PathBounds::kParts;
  for (int i = 0; i < 100; ++i) {
    const Rates rates = any_rates();
    const double from = kPart * std::floor(in(0, PathBounds::kParts - 40));
    const double length = kPart * std::floor(in(1, 40));
    sut.bound(rates, from, length, Joints::Zero());
    all.push_back({from, from + length, velocity_for(rates, draft.joints, HUGE_VAL)});
  }
  for (std::size_t i = 0; i < PathBounds::kParts; ++i) {
    const double middle = kPart * (static_cast<double>(i) + 0.5);
    double lowest = 1;  // the tool's
    for (const Stretch& one : all) {
      lowest = one.from < middle && middle < one.to ? std::min(lowest, one.speed) : lowest;
    }
    EXPECT_DOUBLE_EQ(sut.bounds().speed[i], lowest) << i;
  }
}

TEST_F(Findings, Name_the_slowest_place_and_the_most_singular_one) {
  Rates slow;
  slow.first = Joints::Constant(50);
  const Joints there = Joints::Constant(0.5);
  sut.bound(slow, 1.2, 0.1, there);
  sut.bound(any_rates(), 0.4, 0.1, Joints::Zero());
  sut.note_volume(1e-7, 0.7, 2 * there);
  sut.note_volume(-1e-6, 0.8, Joints::Zero());
  ASSERT_EQ(sut.narrow().size(), 2U);
  EXPECT_EQ(sut.narrow()[0].place, 0.7);
  EXPECT_EQ(sut.narrow()[0].joints, 2 * there);
  EXPECT_EQ(sut.narrow()[1].place, 1.2);
  EXPECT_EQ(sut.narrow()[1].joints, there);
  EXPECT_TRUE(sut.nearly_singular());
  sut.begin();
  EXPECT_FALSE(sut.nearly_singular());
  EXPECT_EQ(sut.narrow()[0].joints, draft.segment.from);
}

// Rates for which there is no room left make the path slower, never faster.
TEST_F(Findings, Leave_no_more_for_changes_than_all_rates_allow) {
  LineLimits one_by_one = draft.segment.limits;
  std::vector<Rates> all;
  for (int i = 0; i < PathFindings::kMaxNoted + 50; ++i) {
    all.push_back(any_rates());
    sut.note(all.back());
    one_by_one.velocity = velocity_for(all.back(), draft.joints, one_by_one.velocity);
  }
  EXPECT_EQ(draft.segment.limits.velocity, one_by_one.velocity);
  for (const Rates& rates : all) {
    leave_for_changes(rates, draft.joints, one_by_one);
  }
  sut.leave_for_changes();
  EXPECT_LE(draft.segment.limits.acceleration, one_by_one.acceleration);
  EXPECT_LE(draft.segment.limits.jerk, one_by_one.jerk);
  EXPECT_GT(draft.segment.limits.acceleration, 0);
  EXPECT_GT(draft.segment.limits.jerk, 0);
}

TEST(Planning_work, Counts_places_by_what_they_take) {
  PlanningWork sut;
  sut.begin(true);
  sut.add(10);
  sut.add_on_path(10);
  EXPECT_EQ(sut.places(), 20);
  sut.begin(false);
  sut.add_on_path(10);
  EXPECT_EQ(sut.places(), 40);
  EXPECT_FALSE(sut.settles_slowly());
  sut.settle_slowly();
  sut.add_on_path(10);
  EXPECT_EQ(sut.places(), 90);
  EXPECT_TRUE(sut.settles_slowly());
  sut.add(PlanningWork::kMaxRefusalWork - 90);
  EXPECT_TRUE(sut.may_refuse());
  sut.add(1);
  EXPECT_FALSE(sut.may_refuse());
}

}  // namespace
}  // namespace indurop::robot
