// SPDX-License-Identifier: Apache-2.0
// The path of a free motion as a curve, and the search for it.
#include <gtest/gtest.h>

#include <cstdio>
#include <random>

#include "control/robot/path/joint_path.h"
#include "control/robot/plan/planner.h"
#include "robot_fixture.h"
#include "scene.h"

namespace indurop::robot {
namespace {

class Joint_path : public testing::Test {
 protected:
  double in(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random); }

  void begin(int points) {
    velocity = cell_limits().velocity;
    corners.clear();
    for (int i = 0; i < points; ++i) {
      Joints q = Joints::Zero();
      for (int axis = 0; axis < 6; ++axis) {
        q[axis] = in(-2, 2);
      }
      corners.push_back(q);
    }
    sut.begin(corners[0]);
    for (int i = 1; i < points; ++i) {
      ASSERT_TRUE(sut.add(corners[static_cast<std::size_t>(i)], velocity));
    }
    for (int i = 1; i + 1 < points; ++i) {
      const double most = std::min(sut.place(i) - sut.place(i - 1), sut.place(i + 1) - sut.place(i)) / 2;
      sut.round(i, in(0.05, 1) * most);
    }
  }

  std::mt19937 random{11};
  Joints velocity;
  std::vector<Joints> corners;
  JointPath sut;
};

// Corners by integrating their bend, (1 - u^2)^2, from one direction to the other.
TEST_F(Joint_path, Is_straight_between_corners_that_bend_smoothly) {
  for (int round = 0; round < 8; ++round) {
    begin(2 + round % 6);
    EXPECT_EQ(sut.at(0), corners.front());
    EXPECT_EQ(sut.at(sut.length()), corners.back());
    EXPECT_EQ(sut.end(), corners.back());
    constexpr int kParts = 8000;
    const double step = sut.length() / kParts;
    Joints q = corners.front();
    for (int i = 0; i < kParts; ++i) {
      const double place = (i + 0.5) * step;
      Joints direction = Joints::Zero();
      for (int k = 0; k + 1 < sut.points(); ++k) {
        const auto weight = [&](int corner) {  // how far the path has turned at a corner
          if (corner == 0) {
            return 1.0;
          }
          if (corner == sut.points() - 1) {
            return 0.0;
          }
          const double u = std::clamp((place - sut.place(corner)) / sut.zone(corner), -1.0, 1.0);
          return 0.5 + 15.0 / 16 * (u - 2 * u * u * u / 3 + u * u * u * u * u / 5);
        };
        const auto p = static_cast<std::size_t>(k);
        direction += (weight(k) - weight(k + 1)) * (corners[p + 1] - corners[p]) / (sut.place(k + 1) - sut.place(k));
      }
      q += direction * step;
      ASSERT_LT((sut.at((i + 1) * step) - q).cwiseAbs().maxCoeff(), 1e-4);
      ASSERT_LE(direction.cwiseAbs().cwiseQuotient(velocity).maxCoeff(), 1 + 1e-9);
      ASSERT_LE((direction.cwiseAbs() - sut.fastest()).maxCoeff(), 1e-9);
    }
  }
}

TEST_F(Joint_path, Travels_no_farther_than_it_says) {
  for (int round = 0; round < 50; ++round) {
    begin(2 + round % 7);
    for (int i = 0; i < 20; ++i) {
      double from = in(0, sut.length());
      double to = in(0, sut.length());
      if (from > to) {
        std::swap(from, to);
      }
      Joints travelled = Joints::Zero();
      constexpr int kParts = 500;
      for (int k = 0; k < kParts; ++k) {
        travelled +=
            (sut.at(from + (to - from) * (k + 1) / kParts) - sut.at(from + (to - from) * k / kParts)).cwiseAbs();
      }
      const Joints said = sut.travel(from, to);
      EXPECT_GE((said - travelled).minCoeff(), -1e-9);
      EXPECT_LE((said - (to - from) * velocity).maxCoeff(), 1e-9);
    }
  }
}

TEST_F(Joint_path, Is_one_curve_up_to_the_next_bound) {
  begin(5);
  double place = 0;
  int bounds = 0;
  for (; place < HUGE_VAL && bounds < 100; ++bounds) {
    const double next = sut.smooth_until(place);
    EXPECT_GT(next, place);
    place = next;
  }
  EXPECT_EQ(bounds, 3 * 5 + 1);
}

TEST_F(Joint_path, Takes_as_many_points_as_it_has_room_for) {
  begin(JointPath::kMostPoints);
  EXPECT_FALSE(sut.add(Joints::Zero(), velocity));
  sut.begin(Joints::Zero());
  EXPECT_EQ(sut.length(), 0);
  EXPECT_EQ(sut.at(0), Joints::Zero());
  EXPECT_FALSE(sut.add(Joints::Zero(), velocity));
}

}  // namespace
}  // namespace indurop::robot
