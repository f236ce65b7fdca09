// SPDX-License-Identifier: Apache-2.0
// Random jobs of arms with seven axes, with lines and circles on which the elbow moves, by AXIS or by choice, and of
// arms next to tables that turn the workpiece meanwhile: whatever happens, no set point breaks a limit; and a line
// takes the same path on the workpiece at any override and behind any stop. INDUROP_ROBOT_ELBOWS says how many jobs of
// each arm, INDUROP_ROBOT_SEED from which one on.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <map>
#include <random>

#include "drive_faults.h"
#include "limit_judge.h"
#include "random_job.h"
#include "robot_fixture.h"

namespace indurop::robot {
namespace {

constexpr std::uint32_t kFirstMotion = 5;  // line of job_of_lines()

class Random_elbows : public testing::TestWithParam<const char*> {
 protected:
  Random_elbows() : urdf(GetParam() == std::string("panda") ? panda_spec().urdf() : urdf_of(GetParam())) {}

  double in(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random); }
  int one_of(int many) { return std::uniform_int_distribution<int>(0, many - 1)(random); }
  [[nodiscard]] double inside(int axis, double value, double margin) const {
    const Axis& a = arm.axis(axis);
    return a.endless ? value : std::clamp(value, a.lower + margin, a.upper - margin);
  }
  std::string axis() {
    std::string text;
    for (const int free : free_axes) {
      const double at = inside(free, middle[free] + in(-0.8, 0.8), 1e-3);
      text += one_of(3) == 0 ? "" : fmt::format(" AXIS {} {:.3f}", free + 1, degrees(at));
    }
    return text;
  }
  std::string points(int many, double spread) {
    middle = anywhere(arm, random, 0.15);
    std::string text;
    for (int i = 0; i < many; ++i) {
      Joints q = middle;
      for (int k = 0; k < arm.count(); ++k) {
        q[k] = inside(k, q[k] + in(-spread, spread), 0.01);
      }
      std::string point = random_point(arm, q, i, i == 0);
      // What turns the workpiece is not found for a pose.
      if (i > 0 && (arm.world_joint() > 0 || one_of(3) == 0)) {
        for (const int free : free_axes) {
          point.insert(point.size() - 1, fmt::format(" AXIS {} {}", free + 1, degrees(q[free])));
        }
      }
      text += point;
    }
    return text;
  }
  std::string job_of_all() {
    constexpr int kFew = 5;
    std::string text = points(kFew, in(0.05, 0.6)) + "MOVJ Q0\n";
    const auto small = [&] { return fmt::format("{:.3f}, {:.3f}, {:.3f}", in(-60, 60), in(-60, 60), in(-60, 60)); };
    const auto point = [&] { return fmt::format("Q{}", one_of(kFew)); };
    for (int i = 0; i < 10; ++i) {
      switch (one_of(14)) {
        case 0:
          text += fmt::format("SPEED {}%\n", 1 + one_of(100));
          break;
        case 1:
          text += fmt::format("ZONE {} mm\n", one_of(3) * one_of(60));
          break;
        case 2:
          text += "MOVJ " + point() + "\n";
          break;
        case 3:
          text += "MOVC " + point() + " " + point() + axis() + "\n";
          break;
        case 4:
          text += "MOVL HERE" + axis() + "\n";
          break;
        case 5:
          text += "MOVJ HERE OFFSET " + small() + "\n";
          break;
        case 6:
          text += "MOVL HERE OFFSET TOOL " + small() + axis() + fmt::format(" ACC {:.0f}%\n", in(1, 100));
          break;
        case 7:
          text += fmt::format("WEAVE SINE WIDTH {:.1f} mm LENGTH {:.1f} mm\n", in(1, 8), in(5, 30));
          break;
        case 8:
          text += "WEAVE OFF\n";
          break;
        case 9:
          text += one_of(2) == 0 ? "CORRECT OFF\n" : "CORRECT 0, 20 * SIN(90 * TIME), 0 LIMIT 15 mm RATE 30 mm/s\n";
          break;
        default:
          text += "MOVL " + point() + axis() + "\n";
      }
    }
    return text;
  }
  std::string job_of_lines() {
    std::string text = points(4, in(0.1, 0.5)) + "MOVJ Q0\n";
    int point = 0;
    for (int i = 0; i < 5; ++i) {
      point = (point + 1 + one_of(3)) % 4;
      text += fmt::format("MOVL Q{}{}\n", point, axis());
    }
    return text;
  }
  void start(const std::string& job, double period_ms) {
    Settings settings;
    settings.zero.clear();
    for (int i = 0; i < arm.count(); ++i) {
      settings.zero.push_back(degrees((arm.axis(i).lower + arm.axis(i).upper) / 2));
    }
    cell = std::make_unique<Cell>(job, period_ms, 0, true, settings, urdf);
    ASSERT_TRUE(cell->serve(Service::GroupEnable));
    judge = std::make_unique<Judge>(period_ms / 1000, urdf);
    for (int i = 0; i < 4; ++i) {
      cell->step();
      static_cast<void>(judge->look(*cell, 1));  // it begins anywhere
    }
    cell->in.service.job = 1;
    cell->ask(Service::JobStart);
  }
  // Overrides, holds, and stops of the job, which goes on later.
  void disturb(double often) {
    const GroupState state = cell->out.state;
    if (state == GroupState::Standby && cell->out.job.can_resume && cell->out.done == cell->in.service.number) {
      cell->in.hold = false;
      cell->ask(one_of(4) == 0 ? Service::JobBack : Service::JobResume);
      return;
    }
    if (in(0, 1) > often) {
      return;
    }
    const int what = one_of(8);
    cell->in.hold = what < 2 && !cell->in.hold;
    if (what < 6) {
      cell->in.speed_override = in(0, 100);
    } else if (what == 6 && state == GroupState::Moving) {
      cell->ask(Service::JobStop);
    }
  }
  [[nodiscard]] Joints joints() const {
    Joints q = Joints::Zero();
    for (int i = 0; i < arm.count(); ++i) {
      q[i] = radians(cell->out.command[static_cast<std::size_t>(i)]);
    }
    return q;
  }

  const std::string urdf;
  std::mt19937 random;
  Arm arm = arm_from_urdf("arm.urdf", urdf).value().arm;
  // The elbow, or what turns the workpiece.
  const std::vector<int> free_axes = arm.count() == 8        ? std::vector{6, 7}
                                     : arm.world_joint() > 0 ? std::vector{6}
                                                             : std::vector{2};
  Joints middle = Joints::Zero();  // of the points
  std::unique_ptr<Cell> cell;
  std::unique_ptr<Judge> judge;
};

TEST_P(Random_elbows, Break_no_limit_whatever_happens) {
  const int first = number_of("INDUROP_ROBOT_SEED", 1);
  std::map<std::string, int> ends;
  for (int seed = first; seed < first + number_of("INDUROP_ROBOT_ELBOWS", 30); ++seed) {
    random.seed(static_cast<unsigned>(seed));
    const double period_ms = std::array{1.0, 4.0, 10.0}[static_cast<std::size_t>(seed) % 3];
    const std::string job = job_of_all();
    ASSERT_NO_FATAL_FAILURE(start(job, period_ms)) << job;
    const double often = in(0, 1) < 0.4 ? 0 : 5 * period_ms / 1000;
    bool emergency = false;
    for (int i = 0; i < 20000 / period_ms; ++i) {
      if (often > 0) {
        disturb(often);
        emergency = emergency || in(0, 1) < often / 60;
        cell->in.emergency = emergency;
      }
      cell->step();
      ASSERT_EQ(judge->look(*cell, emergency ? kEmergency : 1), "")
          << "seed " << seed << ", period " << i << " of " << period_ms << " ms, line " << cell->out.job.line << "\n"
          << job;
      if (i > 10 && (cell->out.job.state == JobState::Ended || cell->out.state == GroupState::ErrorStop)) {
        break;
      }
    }
    const ErrorCode code = cell->out.state == GroupState::ErrorStop ? cell->out.error : ErrorCode::Ok;
    const bool by_gate = code == ErrorCode::Speed || code == ErrorCode::Acceleration || code == ErrorCode::Jerk;
    const bool corrects = job.find("LIMIT") != std::string::npos;  // next to singular positions, the gate stops a shift
    EXPECT_FALSE(by_gate && often <= 0 && !corrects) << "seed " << seed << ", line " << cell->out.job.line << "\n"
                                                     << job;
    ends[code == ErrorCode::Ok ? "ended well" : to_string(code)] += 1;
  }
  for (const auto& [end, many] : ends) {
    fmt::print("{:6} {}\n", many, end);
  }
}

class Lines_with_elbows : public Random_elbows {
 protected:
  struct Line {
    Joints from = Joints::Zero(), to = Joints::Zero();
    bool seen = false;
    [[nodiscard]] bool moves(int axis) const { return std::abs(to[axis] - from[axis]) > 1e-6; }
  };
  std::map<std::uint32_t, Line> lines;  // of job_of_lines(), as they are followed if nothing happens
  double off = 0;                       // m and rad, of the tool
  double turned = 0;                    // rad, of the free axes

  // Calls each() in each period from the first motion to the end.
  template <class Each>
  void follow(const std::string& job, double period_ms, const Each& each) {
    constexpr int kMost = 60000;
    ASSERT_NO_FATAL_FAILURE(start(job, period_ms)) << job;
    std::string broken;
    const auto step_ends = [&] {
      broken += judge->look(*cell, 1);
      return !broken.empty() || cell->out.job.state == JobState::Ended || cell->out.state == GroupState::ErrorStop;
    };
    // Before, the line is where the job reads ahead.
    ASSERT_TRUE(cell->until([&] { return step_ends() || cell->out.job.line == kFirstMotion; })) << job;
    for (int i = 0; i < kMost && (cell->step(), !step_ends()); ++i) {
      each();
    }
    ASSERT_EQ(broken, "") << job;
    ASSERT_TRUE(step_ends()) << job;
  }
  void note() {
    Line& line = lines[cell->out.job.line];
    line.from = line.seen ? line.from : joints();
    line.to = joints();
    line.seen = true;
  }
  // The free axes' place as a linear function of the way of the tool comes from what the documentation says, not from
  // the planned path.
  void compare() {
    const Line& line = lines[cell->out.job.line];
    const Pose from = arm.forward(line.from);
    const Pose to = arm.forward(line.to);
    const Vec3 way = to.position - from.position;
    if (cell->out.job.state != JobState::Runs || cell->out.job.line == kFirstMotion || way.norm() < 0.01) {
      return;  // not a line
    }
    const Joints q = joints();
    const Pose here = arm.forward(q);
    const double part = (here.position - from.position).dot(way) / way.squaredNorm();
    off = std::max(off, distance(here, {from.position + part * way, from.orientation.slerp(part, to.orientation)}));
    for (const int free : free_axes) {
      turned = std::max(turned, std::abs(q[free] - line.from[free] - part * (line.to[free] - line.from[free])));
    }
  }
  void disturb_line() {
    const int what = one_of(60);
    if (what == 0) {
      cell->in.speed_override = in(1, 100);
    } else if (what < 3) {
      cell->in.hold = !cell->in.hold;
    } else if (what == 3 && cell->out.state == GroupState::Moving && cell->out.job.line > kFirstMotion) {
      cell->ask(Service::JobStop);
    } else if (cell->out.state == GroupState::Standby && cell->out.job.can_resume) {
      cell->ask(Service::JobResume);
    }
  }
};

TEST_P(Lines_with_elbows, Are_the_same_at_any_override_and_behind_stops) {
  const int first = number_of("INDUROP_ROBOT_SEED", 1);
  int many = 0;
  int moved = 0;
  for (int seed = first; seed < first + number_of("INDUROP_ROBOT_ELBOWS", 20); ++seed) {
    SCOPED_TRACE(seed);
    random.seed(static_cast<unsigned>(seed));
    const std::string job = job_of_lines();
    lines.clear();
    ASSERT_NO_FATAL_FAILURE(follow(job, 4, [&] { note(); }));
    const auto [end, end_line] = std::pair{cell->out.error, cell->out.job.line};
    ASSERT_NO_FATAL_FAILURE(follow(job, 10, [&] {
      compare();
      disturb_line();
    }));
    ASSERT_LT(std::max(off, turned), 1e-6) << job;
    ASSERT_EQ(std::pair(cell->out.error, cell->out.job.line), std::pair(end, end_line)) << job;
    for (const auto& [number, line] : lines) {
      many += number > kFirstMotion ? 1 : 0;
      moved += number > kFirstMotion && line.moves(free_axes[0]) ? 1 : 0;
    }
  }
  fmt::print("{} lines, the elbow or table moves on {}; the tool is {:.1e} off, that {:.1e} rad\n", many, moved, off,
             turned);
  EXPECT_GT(moved, 0);
}

INSTANTIATE_TEST_SUITE_P(Of_seven_axes, Lines_with_elbows, testing::Values("panda", "iiwa14"));
INSTANTIATE_TEST_SUITE_P(Of_seven_axes, Random_elbows, testing::Values("panda", "iiwa14"));
INSTANTIATE_TEST_SUITE_P(Of_tables, Lines_with_elbows, testing::Values("turntable", "tilt_table"));
INSTANTIATE_TEST_SUITE_P(Of_tables, Random_elbows, testing::Values("turntable", "tilt_table"));

}  // namespace
}  // namespace indurop::robot
