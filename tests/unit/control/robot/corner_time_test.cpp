// SPDX-License-Identifier: Apache-2.0
// How long corners with a zone take: never longer than with a stop there, less for greater zones and speeds, and not
// much longer than the least time that a reference finds for the same rounded path. INDUROP_ROBOT_CORNERS says how many
// random ones.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <random>
#include <string>
#include <vector>

#include "control/robot/path/chain.h"
#include "group_cell.h"

namespace indurop::robot {
namespace {

constexpr double kCornerPeriod = 0.004;

int corners(int usual) {
  const char* wanted = std::getenv("INDUROP_ROBOT_CORNERS");
  return wanted != nullptr ? std::atoi(wanted) : usual;
}

std::string point_line(const std::string& name, const Pose& pose) {
  const Vec3 p = 1000 * pose.position;
  const Vec3 rpy = to_rpy(pose.orientation);
  return fmt::format("POINT {} = POSE {:.9f} {:.9f} {:.9f} RPY {:.9f} {:.9f} {:.9f}\n", name, p.x(), p.y(), p.z(),
                     degrees(rpy.x()), degrees(rpy.y()), degrees(rpy.z()));
}

// Runs a job; its motions begin after "WAIT 0.1s".
class CornerRun {
 public:
  CornerRun(
      const std::string& job, int axes, const std::string& urdf = "",
      const std::function<void(Inputs&, int)>& disturb = [](Inputs&, int) {})
      : cell_(job, 1000 * kCornerPeriod, 0, true, Settings{}, urdf), axes_(axes) {
    if (!cell_.serve(Service::GroupEnable)) {
      return;
    }
    cell_.in.service.job = 1;
    cell_.ask(Service::JobStart);
    int moving = 0;
    int since_move = 0;
    for (int i = 0; i < 100000 && running(); ++i) {
      const auto before = cell_.out.command;
      disturb(cell_.in, i);
      cell_.step();
      const bool moves = cell_.out.command != before;
      if (moves && since_move > 20) {
        moving = 0;  // after the wait
        places.clear();
      }
      since_move = moves ? 0 : since_move + 1;
      if (moves) {
        ++moving;
        places.push_back(joints());
      }
    }
    good = cell_.out.job.state == JobState::Ended;
    seconds = moving * kCornerPeriod;
  }

  bool good = false;
  double seconds = 0;  // of the motions after the wait
  std::vector<Joints> places;

 private:
  [[nodiscard]] bool running() const {
    return cell_.out.job.state != JobState::Ended && cell_.out.job.state != JobState::Failed;
  }
  [[nodiscard]] Joints joints() const {
    Joints q = Joints::Zero();
    for (int i = 0; i < axes_; ++i) {
      q[i] = radians(cell_.out.command[at(i)]);
    }
    return q;
  }

  Cell cell_;
  int axes_;
};

struct RandomCorners {
  std::string name;
  std::string urdf;
  Arm arm;
  std::mt19937 random;

  double in(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random); }
  // Lines of a job with one or two corners, and the same with this zone.
  struct Job {
    std::string points, moves;
    double zone = 0;
    int speed = 0;
    [[nodiscard]] std::string with(double zone_of_it) const {
      std::string text = moves;
      for (std::size_t at = text.find("$Z"); at != std::string::npos; at = text.find("$Z")) {
        text.replace(at, 2, fmt::format("{:.3f}", zone_of_it));
      }
      return points + text;
    }
  };
  // Lines only, or circles and joint motions among them.
  Job next(bool mixed) {
    Job job;
    job.zone = std::exp(in(std::log(0.5), std::log(120)));
    job.speed = in(0, 1) < 0.5 ? 100 : static_cast<int>(in(3, 100));
    Joints q = anywhere(arm, random, 0.3);
    job.points = "POINT A = JOINT";
    for (int i = 0; i < arm.count(); ++i) {
      job.points += fmt::format(" {:.9f}", degrees(q[i]));
    }
    job.points += "\n";
    job.moves = fmt::format("MOVJ A\nWAIT 0.1s\nSPEED {}%\nZONE $Z mm\n", job.speed);
    const int motions = in(0, 1) < 0.6 ? 2 : 3;
    for (int i = 0; i < motions; ++i) {
      const double far = std::exp(in(std::log(0.03), std::log(0.5)));
      const double kind = mixed ? in(0, 1) : 0;
      const std::string point(1, static_cast<char>('B' + i));
      if (kind > 0.75) {
        job.points += point_line("MID" + point, arm.forward(near(q, far / 2)));
      }
      q = near(q, far);
      job.points += point_line(point, arm.forward(q));
      job.moves += i + 1 == motions ? "ZONE 0\n" : "";
      job.moves += kind > 0.75   ? "MOVC MID" + point + " " + point + "\n"
                   : kind > 0.35 ? "MOVJ " + point + "\n"
                                 : "MOVL " + point + "\n";
    }
    return job;
  }
  Joints near(const Joints& q, double far) {
    Joints to = q;
    for (int k = 0; k < arm.count(); ++k) {
      to[k] = std::clamp(q[k] + in(-far, far), arm.axis(k).lower + 0.01, arm.axis(k).upper - 0.01);
    }
    return to;
  }
};

RandomCorners corners_of(const std::string& name) {
  const bool cell = name == "cell";
  return {name, cell ? cell_urdf() : urdf_of(name), cell ? cell_arm() : arm_of(name), std::mt19937(7)};
}

class Corner_time : public testing::TestWithParam<const char*> {
 protected:
  // A period more may pass at the end of each motion that stops.
  static void compare(bool mixed) {
    RandomCorners all = corners_of(GetParam());
    const int many = corners(60) / 6;
    int slower = 0;
    int done = 0;
    double worst = 0;
    double with = 0;
    double without = 0;
    for (int tries = 0; done < many && tries < 20 * many; ++tries) {
      const RandomCorners::Job job = all.next(mixed);
      const CornerRun stopping(job.with(0), all.arm.count(), all.urdf);
      if (!stopping.good) {
        continue;
      }
      ++done;
      const CornerRun rounded(job.with(job.zone), all.arm.count(), all.urdf);
      EXPECT_TRUE(rounded.good) << job.with(job.zone);
      const bool more = rounded.seconds > stopping.seconds + 1.5 * kCornerPeriod;
      EXPECT_FALSE(more) << rounded.seconds << " s instead of " << stopping.seconds << ":\n" << job.with(job.zone);
      slower += more ? 1 : 0;
      worst = std::max(worst, rounded.seconds / stopping.seconds);
      with += rounded.seconds;
      without += stopping.seconds;
    }
    fmt::print("{}: {} of {} corners are slower with a zone, {:.3f} times at most; in all {:.3f} of the time\n",
               all.name, slower, done, worst, with / without);
  }
};

TEST_P(Corner_time, Of_lines_is_never_more_than_with_a_stop) {
  compare(false);
}

TEST_P(Corner_time, Of_any_motions_is_never_more_than_with_a_stop) {
  compare(true);
}

INSTANTIATE_TEST_SUITE_P(Arms, Corner_time, testing::Values("cell", "ur3e", "ur5", "ur10", "offset_wrist", "iiwa14"),
                         [](const auto& arm) { return std::string(arm.param); });

// Right angle of two lines of 200 mm.
std::string right_angle(double zone, const std::string& speed) {
  return fmt::format(
      "POINT A = POSE 500 -200 400 RPY 180 0 180\nPOINT B = POSE 500 0 400 RPY 180 0 180\n"
      "POINT C = POSE 300 0 400 RPY 180 0 180\nMOVJ A\nWAIT 0.1s\nSPEED {}\nZONE {} mm\nMOVL B\nZONE 0\nMOVL C\n",
      speed, zone);
}

// A circle of 100 mm radius in chords.
std::string circle_of_chords(int chords, double zone) {
  std::string points;
  std::string moves;
  for (int i = 0; i <= chords; ++i) {
    const double angle = 2 * kPi * i / chords;
    points += fmt::format("POINT C{} = POSE {:.9f} {:.9f} 400 RPY 180 0 180\n", i, 500 + 100 * std::cos(angle),
                          100 * std::sin(angle));
    moves += i == chords ? "ZONE 0\n" : "";
    moves +=
        i == 0 ? fmt::format("MOVJ C0\nWAIT 0.1s\nSPEED 300 mm/s\nZONE {} mm\n", zone) : fmt::format("MOVL C{}\n", i);
  }
  return points + moves;
}

// 2.09 s without any ramps.
TEST(Corner_times, A_circle_of_chords_takes_2_4_seconds_from_zones_of_0_3_chords_on) {
  for (const double zone : {1.5, 2.0, 2.4, 2.6, 3.5, 5.0, 8.0, 20.0}) {
    const CornerRun run(circle_of_chords(126, zone), 6, cell_urdf());
    ASSERT_TRUE(run.good);
    fmt::print("circle of chords of 5 mm, zone {} mm: {:.3f} s\n", zone, run.seconds);
    EXPECT_LT(run.seconds, 2.4) << zone;
    EXPECT_GT(run.seconds, 2.05) << zone;
  }
}

TEST(Corner_times, Fall_with_the_zone_and_with_the_speed) {
  double before = 100;
  for (const double zone : {0.0, 1.0, 2.0, 5.0, 10.0, 20.0, 30.0, 50.0, 80.0, 120.0, 200.0}) {
    const CornerRun run(right_angle(zone, "100%"), 6, cell_urdf());
    ASSERT_TRUE(run.good);
    fmt::print("right angle, zone {} mm: {:.3f} s\n", zone, run.seconds);
    EXPECT_LT(run.seconds, before + 2 * kCornerPeriod) << zone;
    before = run.seconds;
  }
  before = 100;
  for (const int speed : {50, 100, 200, 300, 500, 700, 1000}) {
    const CornerRun run(right_angle(30, fmt::format("{} mm/s", speed)), 6, cell_urdf());
    ASSERT_TRUE(run.good);
    fmt::print("right angle, zone 30 mm, {} mm/s: {:.3f} s\n", speed, run.seconds);
    EXPECT_LT(run.seconds, before + 2 * kCornerPeriod) << speed;
    before = run.seconds;
  }
}

// How far the tool of a run is from the path of a chain, at most, in m.
double farthest(const CornerRun& run, const Chain& chain) {
  constexpr int kPlaces = 20000;
  const Arm arm = cell_arm();
  std::vector<Vec3> path;
  for (int i = 0; i <= kPlaces; ++i) {
    path.push_back(chain.pose_at(chain.length() * i / kPlaces).position);
  }
  double most = 0;
  std::size_t k = 0;
  for (const Joints& q : run.places) {
    const Vec3 p = arm.forward(q).position;
    const auto off = [&](std::size_t i) {
      const Vec3 way = path[i + 1] - path[i];
      const double part = std::clamp((p - path[i]).dot(way) / way.squaredNorm(), 0.0, 1.0);
      return (path[i] + part * way - p).norm();
    };
    while (k + 2 < path.size() && off(k + 1) <= off(k)) {
      ++k;  // the run goes along the path
    }
    most = std::max(most, off(k));
  }
  return most;
}

TEST(Corner_times, The_path_depends_on_neither_speed_nor_override) {
  Chain chain;
  const Quat down = from_rpy({kPi, 0, kPi});
  chain.begin({Vec3(0.5, -0.2, 0.4), down}, {1, 4, 40, kPi, 4 * kPi, 40 * kPi});
  chain.add({{Vec3(0.5, 0, 0.4), down}, 0.03, 1, 0, 1});
  chain.add({{Vec3(0.3, 0, 0.4), down}, 0, 1, 0, 2});
  chain.finish();
  for (const char* speed : {"100%", "500 mm/s", "100 mm/s", "20 mm/s"}) {
    const CornerRun run(right_angle(30, speed), 6, cell_urdf());
    ASSERT_TRUE(run.good);
    EXPECT_LT(farthest(run, chain), 1e-6) << speed;
  }
  std::mt19937 random(5);
  for (int i = 0; i < 10; ++i) {
    const auto change = [&](Inputs& in, int step) {
      if (step % 40 == 0) {
        in.speed_override = static_cast<double>(5 + random() % 96);
      }
    };
    const CornerRun run(right_angle(30, "100%"), 6, cell_urdf(), change);
    ASSERT_TRUE(run.good);
    EXPECT_LT(farthest(run, chain), 1e-6) << i;
  }
}

}  // namespace
}  // namespace indurop::robot
