// SPDX-License-Identifier: Apache-2.0
// Random jobs at full override: the tool goes where the group reported that it would go, as fast as it reported.
// INDUROP_ROBOT_JOBS says how many jobs, INDUROP_ROBOT_SEED from which one on.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "group_cell.h"
#include "random_job.h"
#include "robot_fixture.h"

namespace indurop::robot {
namespace {

struct Set {                // point of one period
  Vec3 tip = Vec3::Zero();  // mm
  double speed = 0;         // mm/s
};

Vec3 place_of(const ToolWay& way, std::size_t i) {
  return Eigen::Vector3f(way.place[i].data()).cast<double>();
}

double length_of(const ToolWay& way) {
  double length = 0;
  for (std::size_t i = 1; i < way.count; ++i) {
    length += (place_of(way, i) - place_of(way, i - 1)).norm();
  }
  return length;
}

double off_line(const Vec3& a, const Vec3& b, const Vec3& at) {
  const Vec3 along = b - a;
  const double square = along.squaredNorm();
  const double part = square > 0 ? std::clamp(along.dot(at - a) / square, 0.0, 1.0) : 0;
  return (a + part * along - at).norm();
}

// For each place of the way the period in which the tool comes near to it, in their order, as late as possible: before,
// it may have been on another way that crosses this one. The sum of the squares of what is not near is as small as
// possible.
std::vector<std::size_t> match(const ToolWay& way, const std::vector<Set>& run) {
  const double near = std::min(0.02, 0.002 * length_of(way));  // mm
  std::vector<std::vector<std::size_t>> from(way.count, std::vector<std::size_t>(run.size(), 0));
  std::vector<double> sum(run.size(), 0);
  for (std::size_t i = 0; i < way.count; ++i) {
    double best = std::numeric_limits<double>::infinity();
    std::size_t at = 0;
    std::vector<double> next(run.size());
    for (std::size_t k = 0; k < run.size(); ++k) {
      if (sum[k] <= best) {
        best = sum[k];
        at = k;
      }
      from[i][k] = at;
      const double step = k > 0 ? (run[k].tip - run[k - 1].tip).norm() : 0;
      next[k] = best + std::pow(std::max(0.0, (run[k].tip - place_of(way, i)).norm() - near - step), 2);
    }
    sum = next;
  }
  std::vector<std::size_t> matched(way.count);
  std::size_t at = static_cast<std::size_t>(std::min_element(sum.begin(), sum.end()) - sum.begin());
  for (std::size_t i = way.count; i-- > 0;) {
    matched[i] = at;
    at = from[i][at];
  }
  return matched;
}

class Ways_ahead : public testing::Test {
 protected:
  int checked = 0, speeds = 0;
  double farthest = 0;  // part of what is tolerated

  void check(const ToolWay& way, const std::vector<Set>& run) {
    ++checked;
    const double tolerated = std::max(1.0, 0.02 * length_of(way));
    // A chain of many lines has more corners than there are places.
    const double between = way.count == kWayPlaces ? 2.5 * tolerated : tolerated;
    const std::vector<std::size_t> at = match(way, run);
    for (std::size_t i = 0; i < way.count; ++i) {
      // Between two set points the tool is on the line between them.
      const std::size_t k = std::clamp<std::size_t>(at[i], 1, run.size() - 2);
      const double off = std::min(off_line(run[k - 1].tip, run[k].tip, place_of(way, i)),
                                  off_line(run[k].tip, run[k + 1].tip, place_of(way, i)));
      farthest = std::max(farthest, off / tolerated);
      ASSERT_LE(off, tolerated) << "place " << i << " of " << way.count << " of a way of " << length_of(way) << " mm";
      check_speed(way, i, run, k);
    }
    for (std::size_t i = 1; i < way.count; ++i) {
      for (std::size_t k = at[i - 1] + 1; k < at[i]; ++k) {
        const double off = off_line(place_of(way, i - 1), place_of(way, i), run[k].tip);
        farthest = std::max(farthest, off / between);
        ASSERT_LE(off, between) << "between places " << i - 1 << " and " << i << " of a way of " << length_of(way)
                                << " mm";
      }
    }
  }

  // Not where it changes much within a few periods.
  void check_speed(const ToolWay& way, std::size_t i, const std::vector<Set>& run, std::size_t k) {
    constexpr std::size_t kAround = 3;
    // Places of a shorter way are nearer to each other than those of two periods.
    if (length_of(way) < 5 || k < kAround || k + kAround >= run.size()) {
      return;
    }
    double least = run[k].speed;
    double most = least;
    for (std::size_t j = k - kAround; j <= k + kAround; ++j) {
      least = std::min(least, run[j].speed);
      most = std::max(most, run[j].speed);
    }
    if (most - least > 0.05 * most || most < 1) {
      return;
    }
    ++speeds;
    ASSERT_NEAR(way.speed[i], run[k].speed, 0.1 * run[k].speed + 1)
        << "place " << i << " of " << way.count << " of a way of " << length_of(way) << " mm";
  }

  struct Known {
    ToolWay way;  // as it was reported last
    std::size_t since = 0;
  };

  void run(unsigned seed, const std::string& urdf) {
    std::mt19937 random(seed);
    const std::string job = random_job(arm_from_urdf("arm.urdf", urdf).value().arm, random).text;
    Cell cell(job, 2, 0, true, {}, urdf);
    ASSERT_TRUE(cell.serve(Service::GroupEnable));
    cell.in.service.job = 1;
    cell.ask(Service::JobStart);
    std::vector<Set> run;
    std::vector<Known> ahead;
    const int planned = checked;
    for (int i = 0; i < 20000; ++i) {
      cell.step();
      const Outputs& out = cell.out;
      run.push_back({Vec3(out.position[0], out.position[1], out.position[2]), out.tool_speed});
      if (out.ways_changed) {
        note(out, run, ahead);
        if (HasFatalFailure()) {
          FAIL() << "seed " << seed << ", period " << i << ", line " << out.job.line << "\n" << job;
        }
      }
      if (out.state == GroupState::Stopping) {
        ahead.clear();  // it does not go to the end of the motion
      }
      if (i > 10 && out.state != GroupState::Moving && out.state != GroupState::Stopping) {
        break;
      }
    }
    EXPECT_EQ(cell.out.ways[0], nullptr);
    EXPECT_TRUE(checked > planned || cell.out.error != ErrorCode::Ok) << job;
  }

  void note(const Outputs& out, const std::vector<Set>& run, std::vector<Known>& ahead) {
    std::vector<Known> now;
    for (const ToolWay* way : out.ways) {
      if (way == nullptr) {
        break;
      }
      const auto old =
          std::find_if(ahead.begin(), ahead.end(), [way](const Known& one) { return one.way.number == way->number; });
      // One that replaces another begins where that began.
      const bool cut =
          old == ahead.end() && now.size() < ahead.size() && place_of(ahead[now.size()].way, 0) == place_of(*way, 0);
      now.push_back({*way, old != ahead.end() ? old->since : cut ? ahead[now.size()].since : run.size() - 1});
    }
    const auto begins = [](const Known& a, const Known& b) { return place_of(a.way, 0) == place_of(b.way, 0); };
    // The first one has ended unless it is still there, perhaps cut off.
    if (!ahead.empty() && out.state == GroupState::Moving && (now.empty() || !begins(now.front(), ahead.front()))) {
      const std::size_t since = ahead.front().since;
      check(ahead.front().way, {run.begin() + static_cast<std::ptrdiff_t>(since), run.end()});
    }
    ahead = now;
  }
};

TEST_F(Ways_ahead, Are_those_that_the_tool_goes) {
  const int first = number_of("INDUROP_ROBOT_SEED", 1);
  const int jobs = number_of("INDUROP_ROBOT_JOBS", 40);
  for (int i = 0; i < jobs && !HasFatalFailure(); ++i) {
    run(static_cast<unsigned>(first + i), cell_urdf());
  }
  EXPECT_GT(checked, jobs / 2);
  EXPECT_GT(speeds, jobs / 2);
  fmt::print("{} motions, {} speeds, {:.0f} % of what is tolerated at most\n", checked, speeds, 100 * farthest);
}

TEST_F(Ways_ahead, Of_other_arms_too) {
  const int first = number_of("INDUROP_ROBOT_SEED", 1);
  const int jobs = number_of("INDUROP_ROBOT_JOBS", 40) / 10;
  for (const char* arm : {"delta", "five_axis", "gantry", "iiwa14", "palletiser", "scara", "turntable", "ur5"}) {
    for (int i = 0; i < jobs && !HasFatalFailure(); ++i) {
      run(static_cast<unsigned>(first + i), urdf_of(arm));
    }
  }
  fmt::print("{} motions, {} speeds, {:.0f} % of what is tolerated at most\n", checked, speeds, 100 * farthest);
}

TEST_F(Ways_ahead, Are_gone_after_a_stop_and_at_the_end) {
  Cell cell("POINT A = JOINT 40 20 -20 0 60 0\nPOINT B = JOINT -40 20 -20 0 60 0\nMOVJ A\nMOVJ B\nMOVJ A\n");
  ASSERT_TRUE(cell.serve(Service::GroupEnable));
  EXPECT_EQ(cell.out.ways[0], nullptr);
  cell.in.service.job = 1;
  for (const bool stops : {true, false}) {
    cell.ask(Service::JobStart);
    ASSERT_TRUE(cell.until([&] { return cell.out.ways[0] != nullptr; }));
    EXPECT_TRUE(cell.out.ways_changed);
    EXPECT_GE(cell.out.ways[0]->count, 2U);
    cell.step();
    if (stops) {
      cell.ask(Service::JobStop);
    }
    ASSERT_TRUE(cell.until([&] { return cell.out.ways[0] == nullptr && cell.out.state == GroupState::Standby; }));
    cell.step();
    EXPECT_FALSE(cell.out.ways_changed);
  }
  cell.ask(Service::JobStart);
  ASSERT_TRUE(cell.until([&] { return cell.out.ways[0] != nullptr; }));
  cell.in.emergency = true;
  ASSERT_TRUE(cell.until([&] { return cell.out.ways_changed && cell.out.ways[0] == nullptr; }));
  EXPECT_TRUE(cell.out.state == GroupState::ErrorStop || cell.out.state == GroupState::Stopping);
}

}  // namespace
}  // namespace indurop::robot
