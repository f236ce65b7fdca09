// SPDX-License-Identifier: Apache-2.0
#include "control/robot/plan/motion_rehearsal.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "robot_fixture.h"

namespace indurop::robot {
namespace {

// A line of 20 cm, followed by a profile that takes long, with two narrow places that are named to it.
class MotionRehearsals : public testing::Test {
 protected:
  MotionRehearsals() {
    Segment& s = draft.segment;
    draft.joints = cell_limits();
    draft.work.begin(true);
    s.move = Move::Line;
    s.from = joints_of({0, 0.2, 0.1, 0, 0.8, 0});
    s.start = s.end = arm.forward(s.from);
    s.end.position += Vec3(0.2, 0, 0);
    s.way = s.length = 0.2;
    s.limits = {0.02, 1, 10};
    findings.begin();
    Rates slow;
    slow.first = Joints::Constant(50);
    findings.bound(slow, kSlow, 0.01, joints_on_path(kSlow));
    findings.note_volume(1e-9, kSingular, joints_on_path(kSingular));
  }
  [[nodiscard]] Joints joints_on_path(double place) const {
    Joints q = draft.segment.from;
    for (int i = 1; i <= 100; ++i) {
      EXPECT_EQ(places.on(draft.segment, place * i / 100, q, q), Reach::Ok);
    }
    return q;
  }
  // s, of all instants in the order of their rehearsal.
  std::vector<double> rehearse(bool narrow_first) {
    std::vector<double> times;
    sut.begin_profile(profile, narrow_first);
    do {
      EXPECT_TRUE(sut.check_next());
      times.push_back(sut.time());
    } while (sut.advance() && times.size() < 1000000);
    return times;
  }
  // s, when the profile is there, by a search through all instants.
  [[nodiscard]] double time_at(double place) const {
    double time = 0;
    for (; time < profile.duration() && profile.at(time).position < place; time += 1e-4) {
    }
    return time;
  }

  static constexpr double kSlow = 0.05, kSingular = 0.15;
  Arm arm = cell_arm();
  Inverse inverse{arm};
  Places places{arm, inverse};
  Draft draft;
  PathFindings findings{places, draft};
  MotionRehearsal sut{places, draft, findings};
  Profile profile = Profile::to_position({}, 0.2, 0, {0.02, 1, 10});
};

TEST_F(MotionRehearsals, Begin_where_the_path_is_narrow_and_end_with_all_of_it) {
  ASSERT_TRUE(sut.is_fine());
  const std::vector<double> times = rehearse(true);
  // Where time runs backwards, the next part begins.
  std::vector<std::vector<double>> parts(1);
  for (const double time : times) {
    if (!parts.back().empty() && time < parts.back().back()) {
      parts.emplace_back();
    }
    parts.back().push_back(time);
  }
  ASSERT_GE(parts.size(), 2U);
  const auto covers = [](const std::vector<double>& part, double time) {
    return part.front() < time && time < part.back();
  };
  EXPECT_TRUE(covers(parts[0], time_at(kSlow)));
  EXPECT_LT(parts[0].size(), 500U);
  // The second narrow place comes later on the path, so no step back in time divides it from the first one.
  EXPECT_TRUE(covers(parts[0], time_at(kSingular)));
  EXPECT_FALSE(
      std::any_of(parts[0].begin(), parts[0].end(), [&](double time) { return std::abs(time - time_at(0.1)) < 0.5; }));
  const std::vector<double>& whole = parts.back();
  EXPECT_LT(whole.front(), 0.002);
  EXPECT_NEAR(whole.back(), profile.duration(), 1e-9);
  EXPECT_GE(whole.size(), static_cast<std::size_t>(profile.duration() / 0.001));
}

TEST_F(MotionRehearsals, Go_through_the_whole_motion_at_once_if_that_is_requested) {
  const std::vector<double> times = rehearse(false);
  EXPECT_TRUE(std::is_sorted(times.begin(), times.end()));
  EXPECT_LT(times.front(), 0.002);
  EXPECT_NEAR(times.back(), profile.duration(), 1e-9);
}

TEST_F(MotionRehearsals, Count_their_work) {
  sut.begin_profile(profile, false);
  const int before = draft.work.places();
  ASSERT_TRUE(sut.check_next());
  EXPECT_EQ(draft.work.places(), before + 1);
}

}  // namespace
}  // namespace indurop::robot
