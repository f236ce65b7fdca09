// SPDX-License-Identifier: Apache-2.0
// Splines of the tool: through their points, smooth, within all limits, and how long they take.
// INDUROP_ROBOT_SPLINES says how many.
#include "control/robot/path/spline.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <memory>
#include <random>
#include <vector>

#include "control/robot/axis/set_point_gate.h"
#include "control/robot/path/follower.h"
#include "group_cell.h"
#include "jerk_reference.h"

namespace indurop::robot {
namespace {

int splines_wanted(int otherwise) {
  const char* text = std::getenv("INDUROP_ROBOT_SPLINES");
  return text == nullptr ? otherwise : std::atoi(text);
}

class Splines : public testing::Test {
 protected:
  Arm arm = cell_arm();
  Inverse inverse{arm};
  Places places{arm, inverse};
  JointLimits limits = cell_limits();
  ToolLimits tool{1, 4, 40, kPi, 4 * kPi, 40 * kPi};
  Planner planner{places, limits, tool};
  Follower follower{places, limits};
  Spline sut;
  std::mt19937 random{23};

  double in(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random); }
  // Through random points; false if it cannot be followed.
  bool plan(const Joints& from) {
    sut.begin(arm.forward(from), tool);
    const int points = 2 + static_cast<int>(in(0, 8));
    Joints q = from;
    for (int i = 0; i < points; ++i) {
      for (int a = 0; a < arm.count(); ++a) {
        q[a] += in(-0.25, 0.25);
      }
      sut.add({arm.forward(q), 1, 0, i + 1});
    }
    sut.finish();
    Fault fault = planner.begin(sut, from);
    while (fault.ok() && !planner.done()) {
      fault = planner.check(1000);
    }
    return fault.ok();
  }
};

TEST_F(Splines, Pass_their_points_and_bend_smoothly) {
  for (int i = 0; i < 200; ++i) {
    std::vector<Pose> poses{{Vec3(in(-1, 1), in(-1, 1), in(-1, 1)), rotation_by({in(-2, 2), in(-2, 2), in(-2, 2)})}};
    sut.begin(poses[0], tool);
    const int points = 1 + static_cast<int>(in(0, 20));
    for (int k = 0; k < points; ++k) {
      poses.push_back({Vec3(in(-1, 1), in(-1, 1), in(-1, 1)), rotation_by({in(-2, 2), in(-2, 2), in(-2, 2)})});
      ASSERT_TRUE(sut.add({poses.back(), 1, 0, k}));
    }
    sut.finish();
    for (int k = 0; k <= points; ++k) {
      const double place = sut.place_of(k);
      EXPECT_LT(distance(sut.pose_at(place), poses[static_cast<std::size_t>(k)]), 1e-12);
      // Second derivatives on both sides of a point are the same.
      const double h = 1e-4;
      if (k == 0 || k == points) {
        continue;
      }
      const auto bend = [&](double at) {
        return Vec3((sut.pose_at(at + h).position - 2 * sut.pose_at(at).position + sut.pose_at(at - h).position) /
                    (h * h));
      };
      EXPECT_LT((bend(place + 1e-3) - bend(place - 1e-3)).norm(), 0.2 + 0.1 * bend(place).norm());
    }
  }
}

TEST_F(Splines, A_point_where_the_one_before_is_does_not_count) {
  const Pose start = arm.forward(Joints::Zero());
  sut.begin(start, tool);
  EXPECT_FALSE(sut.add({start, 1, 0, 1}));
  EXPECT_EQ(sut.count(), 0);
}

TEST_F(Splines, Through_random_points_keep_all_limits_and_pass_them) {
  constexpr double kStep = 0.001;
  int followed = 0;
  double off = 0;
  const int wanted = splines_wanted(30);
  for (int tries = 0; followed < wanted && tries < 20 * wanted; ++tries) {
    const Joints from = anywhere(arm, random, 0.6);
    if (!plan(from)) {
      continue;
    }
    ++followed;
    std::vector<SetPointGate> gates;
    for (int a = 0; a < arm.count(); ++a) {
      const Axis& axis = arm.axis(a);
      gates.emplace_back(SetPointGate::Range{axis.lowest(), axis.highest()},
                         LineLimits{limits.velocity[a], limits.acceleration[a], limits.jerk[a]}, kStep);
      gates.back().stand(from[a]);
    }
    // What the joints make of the path at the points.
    Joints q = from;
    for (double place = 0; place < sut.length(); place += sut.length() / 500) {
      ASSERT_EQ(places.on(planner.segment(), place, q, q), Reach::Ok);
      for (int k = 0; k <= sut.count(); ++k) {
        if (std::abs(sut.place_of(k) - place) <= sut.length() / 1000) {
          Joints there = q;
          ASSERT_EQ(places.on(planner.segment(), sut.place_of(k), q, there), Reach::Ok);
          off = std::max(off, (arm.forward(there).position - sut.pose_at(sut.place_of(k)).position).norm());
        }
      }
    }
    follower.reset(from);
    follower.add(planner.segment());
    for (int n = 0; n < 100000 && !follower.idle(); ++n) {
      ASSERT_TRUE(follower.step(kStep).ok());
      for (int a = 0; a < arm.count(); ++a) {
        SetPointGate& gate = gates[static_cast<std::size_t>(a)];
        ASSERT_EQ(gate.check(follower.joints()[a], 1), ErrorCode::Ok) << tries << " axis " << a + 1;
        gate.pass(follower.joints()[a], 1);
      }
    }
    EXPECT_LT(distance(arm.forward(follower.joints()), sut.end()), 1e-9);
  }
  fmt::print("{} splines, at their points off by {:.1e} mm at most\n", followed, off * 1000);
  EXPECT_EQ(followed, wanted);
  EXPECT_LT(off, 1e-9);
}

// The joints alone: the tool may be ten times as fast.
TEST_F(Splines, Against_the_least_time) {
  std::vector<double> ratios;
  tool = {10, 400, 40000, 10 * kPi, 4000 * kPi, 400000 * kPi};
  auto other = std::make_unique<Planner>(places, limits, tool);
  const int wanted = splines_wanted(12);
  for (int tries = 0; static_cast<int>(ratios.size()) < wanted && tries < 20 * wanted; ++tries) {
    const Joints from = anywhere(arm, random, 0.6);
    plan(from);
    Fault fault = other->begin(sut, from);
    while (fault.ok() && !other->done()) {
      fault = other->check(1000);
    }
    if (!fault.ok()) {
      continue;
    }
    const Segment& s = other->segment();
    JerkTask task;
    task.speeds.path = [&, near = from](double x) mutable {
      places.on(s, x, near, near);
      return near;
    };
    task.speeds.length = s.length;
    task.speeds.most_speed = limits.velocity;
    task.speeds.most_acceleration = limits.acceleration;
    task.speeds.fastest = 1;
    task.speeds.hardest = task.jerk = 1e6;
    task.most_jerk = limits.jerk;
    const double least = least_time(task);
    if (least <= 0) {
      continue;
    }
    const double took =
        s.timing.known() ? s.timing.duration() : Profile::to_position({}, s.length, 0, s.limits).duration();
    ratios.push_back(took / least);
  }
  std::sort(ratios.begin(), ratios.end());
  double sum = 0;
  for (const double ratio : ratios) {
    sum += ratio;
  }
  const double nearly_all = ratios[ratios.size() * 9 / 10];
  fmt::print("{} splines: mean {:.3f}, median {:.3f}, p90 {:.3f}, most {:.3f} of the least time\n", ratios.size(),
             sum / static_cast<double>(ratios.size()), ratios[ratios.size() / 2], nearly_all, ratios.back());
  EXPECT_LT(sum, 1.15 * static_cast<double>(ratios.size()));
  EXPECT_LT(nearly_all, 1.25);
  EXPECT_LT(ratios.back(), 1.6);  // where the bend of the path changes abruptly at a point, between two knots
}

const char* const kJob =
    "POINT Q1 = POSE 500 -200 300 RPY 180 0 180\nPOINT Q2 = POSE 550 -60 340 RPY 170 10 180\n"
    "POINT Q3 = POSE 480 80 280 RPY 180 0 160\nPOINT Q4 = POSE 520 200 320 RPY 180 0 180\n";

TEST(Spline_job, Passes_its_points_without_a_stop) {
  Cell cell(kJob + std::string("MOVJ Q1\nSPEED 200 mm/s\nMOVS Q2 Q3 Q4\n"), 1);
  ASSERT_TRUE(cell.serve(Service::GroupEnable));
  cell.in.service.job = 1;
  cell.ask(Service::JobStart);
  std::vector<double> nearest(3, HUGE_VAL);
  const Vec3 points[] = {{550, -60, 340}, {480, 80, 280}, {520, 200, 320}};
  double slowest = HUGE_VAL;
  double fastest = 0;
  bool begun = false;
  ASSERT_TRUE(cell.until(
      [&] {
        const Vec3 here(cell.out.position[0], cell.out.position[1], cell.out.position[2]);
        for (std::size_t i = 0; i < 3; ++i) {
          nearest[i] = std::min(nearest[i], (here - points[i]).norm());
        }
        begun = begun || (here - Vec3(500, -200, 300)).norm() < 1e-3;
        if (begun) {
          slowest = here[1] > -60 && here[1] < 80 ? std::min(slowest, cell.out.tool_speed) : slowest;
          fastest = std::max(fastest, cell.out.tool_speed);
        }
        return cell.out.done == cell.in.service.number;
      },
      20000));
  EXPECT_EQ(cell.out.error, ErrorCode::Ok) << cell.out.job.message;
  EXPECT_GT(slowest, 100);
  EXPECT_LT(fastest, 202);
  for (const double one : nearest) {
    EXPECT_LT(one, 0.2);  // a set point is at most half of 0.2 mm away
  }
  EXPECT_NEAR(cell.out.position[1], 200, 1e-6);
}

TEST(Spline_job, A_point_out_of_reach_is_an_error_of_the_file) {
  const auto read = [] {
    return controller_of(cell_urdf(),
                         kJob + std::string("POINT FAR = POSE 5000 0 300 RPY 180 0 180\nMOVS Q2 FAR Q4\n"));
  };
  try {
    read();
    FAIL();
  } catch (const std::exception& wrong) {
    EXPECT_NE(std::string(wrong.what()).find(":6:1: error: the spline cannot pass point 'FAR'"), std::string::npos)
        << wrong.what();
  }
}

}  // namespace
}  // namespace indurop::robot
