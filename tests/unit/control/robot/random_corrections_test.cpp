// SPDX-License-Identifier: Apache-2.0
// Sensors that say anything, on random lines of two arms, with holds, overrides, stops, and controllers that continue
// for each other: no set point breaks a limit, and the tip is never farther from its line than the job allows.
// INDUROP_ROBOT_CORRECTIONS and INDUROP_ROBOT_PRESSES say how many runs, INDUROP_ROBOT_SEED from which one on.
#include <cmath>
#include <cstdlib>
#include <random>

#include "corrected_cell.h"
#include "robot_fixture.h"

namespace indurop::robot {
namespace {

class Random_corrections : public CorrectedCell {
 protected:
  int one_of(int many) { return std::uniform_int_distribution<int>(0, many - 1)(random); }
  double in(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random); }
  // Something that happens about every `ms`.
  bool every(double ms) { return one_of(static_cast<int>(ms / (1000 * period))) == 0; }

  // A line there and back, along x of a frame; the sensor shifts along y and z of it, or the tool presses along y.
  struct Line {
    bool gantry = false;
    bool presses = false;
    double limit = 0, rate = 0, angle = 0, half = 0;
    Vec3 middle = Vec3::Zero();
  };
  Line choose() {
    Line line;
    line.gantry = one_of(2) == 0;
    line.limit = in(1, 30);
    line.rate = in(5, 150);
    line.angle = in(-180, 180);
    line.half = line.gantry ? in(50, 350) : in(20, 120);
    line.middle = line.gantry ? Vec3(1400, 400, 1300) : Vec3(500, 0, 350);
    return line;
  }
  std::string job_of(const Line& line) {
    const std::string rpy = line.gantry ? "RPY 180 0 0" : fmt::format("RPY 180 0 {}", 180 - line.angle);
    return fmt::format("FRAME f = POSE {} {} {} RPY 0 0 {}\n", line.middle[0], line.middle[1], line.middle[2],
                       line.angle) +
           fmt::format("POINT A = POSE {} 0 0 {} IN f\nPOINT B = POSE {} 0 0 {} IN f\nMOVJ A\n", -line.half, rpy,
                       line.half, rpy) +
           fmt::format("SPEED {} mm/s\n{} IN f {} LIMIT {} mm RATE {} mm/s\n", in(20, 800),
                       line.presses ? "PRESS DY, DZ ALONG Y" : "CORRECT 0, DY, DZ",
                       line.presses ? fmt::format("MOST 1000 N STIFFNESS {} N/mm", in(0.5, 50)) : "", line.limit,
                       line.rate) +
           (line.presses ? fmt::format("WAIT {}s\n", in(0, 1)) : "") +
           fmt::format("ZONE {} mm\nMOVL B\nMOVL A\nMOVL B\nMOVL A\nSET OUT = 1\n", one_of(2) * one_of(20));
  }
  void say_anything(double limit) {
    const double noise = in(0, 5);
    sensor = [this, limit, noise, left = 0]() mutable {
      if (--left < 0) {
        left = one_of(static_cast<int>(0.6 / period));
        *values["DY"] = in(-2 * limit, 2 * limit);
        *values["DZ"] = in(-2 * limit, 2 * limit);
      }
      *values["DY"] += in(-noise, noise);
    };
  }
  void disturb(bool begun) {
    if (every(800)) {
      cell->in.hold = one_of(3) == 0;
      cell->in.speed_override = one_of(2) == 0 ? 100 : one_of(100);
    }
    if (begun && every(2000) && cell->out.moving_by_job) {
      cell->ask(Service::JobStop);
    }
  }
  void run(const Line& line, bool disturbed) {
    const Vec3 across(-std::sin(line.angle * kPi / 180), std::cos(line.angle * kPi / 180), 0);
    bool begun = false;
    ASSERT_TRUE(follow(
        [&] {
          const Vec3 off = Vec3(x(), y(), z()) - line.middle;
          begun = begun || (cell->out.job.line >= 6 && std::abs(off.dot(across)) < 1e-6 && off.norm() < line.half + 1);
          if (begun) {
            EXPECT_LE(std::abs(off.dot(across)), line.limit + 1e-3) << cell->periods;
            EXPECT_LE(std::abs(off[2]), line.limit + 1e-3) << cell->periods;
          }
          if (disturbed) {
            disturb(begun);
          }
          if (cell->out.state == GroupState::Standby && cell->out.job.can_resume) {
            cell->ask(Service::JobResume);
          }
          if (one_of(200) == 0) {
            static_cast<void>(cell->exchange());
          }
          return *values["OUT"] == 1 || cell->out.state == GroupState::ErrorStop;
        },
        500'000))
        << message();
    EXPECT_EQ(*values["OUT"], 1) << message();
  }
  void run_all(int runs, bool presses) {
    const int seed = number_of("INDUROP_ROBOT_SEED", 1);
    for (int each = seed; each < seed + runs && !HasFailure(); ++each) {
      SCOPED_TRACE(each);
      random.seed(static_cast<unsigned>(each));
      Line line = choose();
      line.presses = presses;
      constexpr std::array<double, 3> kPeriods{1, 4, 10};
      start(job_of(line), kPeriods[static_cast<std::size_t>(one_of(3))], line.gantry ? urdf_of("gantry") : cell_urdf());
      say_anything(line.limit);
      run(line, one_of(2) == 0);
    }
  }
  std::mt19937 random;
};

TEST_F(Random_corrections, Never_lead_beyond_a_limit) {
  run_all(number_of("INDUROP_ROBOT_CORRECTIONS", 25), false);
}

TEST_F(Random_corrections, Of_tools_that_press_never_lead_beyond_a_limit) {
  run_all(number_of("INDUROP_ROBOT_PRESSES", 25), true);
}

}  // namespace
}  // namespace indurop::robot
