// SPDX-License-Identifier: Apache-2.0
// Tools that press in one to three random directions at periods from 0.5 to 10 ms. Against random springs, the forces
// are those that were asked for, and the tool is where a linear system says. With sensors that say anything, holds,
// overrides, stops and resumes, no set point is beyond a limit; and always, the distance from the path and its rate,
// as differences of set points, are within what the job declares. INDUROP_ROBOT_PRESSES says how many runs,
// INDUROP_ROBOT_SEED from which one on.
#include <cmath>
#include <random>
#include <tuple>

#include "corrected_cell.h"
#include "press_springs.h"
#include "robot_fixture.h"

namespace indurop::robot {
namespace {

class Random_presses : public CorrectedCell {
 protected:
  int one_of(int many) { return std::uniform_int_distribution<int>(0, many - 1)(random); }
  double in(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random); }
  bool every(double ms) { return one_of(static_cast<int>(ms / (1000 * period))) == 0; }

  struct Way {
    bool gantry = false;
    int directions = 1;
    double limit = 0, rate = 0, angle = 0, half = 0, stiffness = 0, wait = 0;
    Vec3 middle = Vec3::Zero();
    Vec3 wanted = Vec3::Zero();
    Springs springs;
  };
  // As many springs as directions, not too oblique to each other; a force that presses on all of them.
  void choose_springs(Way& way) {
    double softest = 0;
    Vec3 inside = Vec3::Zero();
    do {
      way.springs = Springs();
      way.wanted.setZero();
      for (int i = 0; i < way.directions; ++i) {
        Vec3 into = Vec3::Zero();
        for (int k = 0; k < way.directions; ++k) {
          into[k] = in(-1, 1);
        }
        const double stiffness = in(1, 40);
        way.springs.add(stiffness, into, in(0, 0.2 * way.limit / std::sqrt(way.directions)));
        way.wanted += stiffness * in(0.05, 0.3) * way.limit / 3 * into.normalized();
      }
      std::tie(way.stiffness, softest) = way.springs.range(way.directions);
      inside = way.springs.equilibrium(way.wanted);
    } while (softest < 0.35 * way.stiffness ||
             (way.springs.force(inside) - way.wanted).norm() > 1e-6 * way.wanted.norm() ||
             inside.cwiseAbs().maxCoeff() > 0.8 * way.limit / std::sqrt(way.directions));
  }
  Way choose() {
    Way way;
    way.gantry = one_of(2) == 0;
    way.directions = 1 + one_of(3);
    way.limit = in(2, 15);
    way.rate = in(2, 60);
    way.angle = in(-180, 180);
    way.half = way.gantry ? in(50, 350) : in(20, 120);
    way.middle = way.gantry ? Vec3(1400, 400, 1300) : Vec3(500, 0, 350);
    choose_springs(way);
    return way;
  }
  std::string job_of(const Way& way, double period_ms) {
    const std::string rpy = way.gantry ? "RPY 180 0 0" : fmt::format("RPY 180 0 {}", 180 - way.angle);
    std::string press = "PRESS ";
    for (int k = 0; k < way.directions; ++k) {
      press += fmt::format("{}{}, F{} ALONG {}", k > 0 ? ", " : "", way.wanted[k], "XYZ"[k], "XYZ"[k]);
    }
    return fmt::format("FRAME f = POSE {} {} {} RPY 0 0 {}\n", way.middle[0], way.middle[1], way.middle[2], way.angle) +
           fmt::format("POINT A = POSE {} 0 0 {} IN f\nPOINT B = POSE {} 0 0 {} IN f\nMOVJ A\n", -way.half, rpy,
                       way.half, rpy) +
           fmt::format("SPEED {} mm/s\n{} IN f MOST 10000 N STIFFNESS {} N/mm LIMIT {} mm RATE {} mm/s\n", in(20, 800),
                       press, way.stiffness, way.limit, way.rate) +
           // From limit to limit at the slowest, and 20 times the time in which the softest force comes.
           fmt::format(
               "SET OUT = 0.5\nWAIT {}s\nSET OUT = 1\nZONE {} mm\nMOVL B\nMOVL A\nMOVL B\nPRESS OFF\nSET OUT = 2\n",
               way.wait > 0 ? way.wait
                            : 4 * way.limit / std::min(way.rate, 2.0) + 60 * std::max(0.06, 0.015 * period_ms),
               one_of(2) * one_of(20));
  }
  // In mm, along the axes of the frame.
  [[nodiscard]] Vec3 off(const Way& way) const {
    const Eigen::AngleAxisd turn(-way.angle * kPi / 180, Vec3::UnitZ());
    return turn * (Vec3(x(), y(), z()) - way.middle);
  }
  void write(const Vec3& force) {
    for (int k = 0; k < 3; ++k) {
      if (const auto found = values.find(std::string("F") + "XYZ"[k]); found != values.end()) {
        *found->second = force[k];
      }
    }
  }
  // At A the path stands still.
  void look(const Way& way, Vec3& before) {
    const Vec3 now = off(way) + Vec3(way.half, 0, 0);
    if (*values["OUT"] == 0.5 && before.norm() < HUGE_VAL) {
      EXPECT_LE(now.norm(), way.limit + 1e-3) << cell->periods;
      EXPECT_LE((now - before).norm() / period, way.rate * 1.001 + 0.01) << cell->periods;
      rates_ = std::max(rates_, (now - before).norm() / period / way.rate);
    } else if (*values["OUT"] == 1) {
      EXPECT_LE(std::hypot(now[1], now[2]), way.limit + 1e-3) << cell->periods;
    }
    before = *values["OUT"] == 0.5 ? now : Vec3::Constant(HUGE_VAL);
  }
  void against_springs(const Way& way) {
    Vec3 force = Vec3::Zero();
    Vec3 before = Vec3::Constant(HUGE_VAL);
    sensor = [&] {
      force = way.springs.force(off(way) + Vec3(way.half, 0, 0));
      write(force);
    };
    ASSERT_TRUE(follow(
        [&] {
          look(way, before);
          return *values["OUT"] == 1 || cell->out.state == GroupState::ErrorStop;
        },
        500'000))
        << message();
    ASSERT_EQ(*values["OUT"], 1) << message();
    const double tolerance = 0.02 * way.wanted.norm() + 0.05;
    EXPECT_LT((force - way.wanted).norm(), tolerance) << force.transpose() << ", not " << way.wanted.transpose();
    const Vec3 where = off(way) + Vec3(way.half, 0, 0) - way.springs.equilibrium(way.wanted);
    EXPECT_LT(where.norm(), tolerance / way.springs.range(way.directions).second + 1e-3) << where.transpose();
  }
  void against_anything(const Way& way) {
    Vec3 before = Vec3::Constant(HUGE_VAL);
    Vec3 said = Vec3::Zero();
    const double most = 3 * way.wanted.norm() + 5;
    sensor = [&, left = 0]() mutable {
      if (--left < 0) {
        left = one_of(static_cast<int>(0.6 / period));
        said = Vec3(in(-most, most), in(-most, most), in(-most, most));
      }
      write(said + Vec3(in(-1, 1), in(-1, 1), in(-1, 1)));
    };
    ASSERT_TRUE(follow(
        [&] {
          look(way, before);
          if (every(800)) {
            cell->in.hold = one_of(3) == 0;
            cell->in.speed_override = one_of(2) == 0 ? 100 : one_of(100);
          }
          if (*values["OUT"] == 1 && every(2000) && cell->out.moving_by_job) {
            cell->ask(Service::JobStop);
          }
          if (cell->out.state == GroupState::Standby && cell->out.job.can_resume) {
            cell->ask(Service::JobResume);
          }
          return *values["OUT"] == 2 || cell->out.state == GroupState::ErrorStop;
        },
        500'000))
        << message();
    EXPECT_EQ(*values["OUT"], 2) << message();
  }
  std::mt19937 random;
  double rates_ = 0;
};

TEST_F(Random_presses, Have_their_forces_and_never_lead_beyond_a_limit) {
  const int seed = number_of("INDUROP_ROBOT_SEED", 1);
  const int runs = number_of("INDUROP_ROBOT_PRESSES", 20);
  for (int each = seed; each < seed + runs && !HasFailure(); ++each) {
    SCOPED_TRACE(each);
    random.seed(static_cast<unsigned>(each));
    Way way = choose();
    const bool springs = each % 2 == 0;
    way.wait = springs ? 0 : in(0, 1.5);
    constexpr std::array<double, 6> kPeriods{0.5, 1, 2, 4, 8, 10};
    const double period_ms = kPeriods[static_cast<std::size_t>(one_of(6))];
    start(job_of(way, period_ms), period_ms, way.gantry ? urdf_of("gantry") : cell_urdf());
    if (springs) {
      against_springs(way);
    } else {
      against_anything(way);
    }
  }
  EXPECT_GT(rates_, 0.5) << "no press was fast";
}

}  // namespace
}  // namespace indurop::robot
