// SPDX-License-Identifier: Apache-2.0
// Random waves across random lines of several arms, with holds, overrides, stops, emergency stops and resumes: no set
// point breaks a limit, and the tip, where orocos-kdl says it is, is on the wave whenever the robot follows its path.
// INDUROP_ROBOT_WEAVES says how many runs, INDUROP_ROBOT_SEED from which one on.
#include <fmt/format.h>

#include <cmath>
#include <map>
#include <random>

#include "drive_faults.h"
#include "limit_judge.h"
#include "robot_fixture.h"
#include "weave_reference.h"

namespace indurop::robot {
namespace {

class Random_weaves : public testing::Test {
 protected:
  int one_of(int many) { return std::uniform_int_distribution<int>(0, many - 1)(random); }
  double in(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random); }
  bool every(double ms) { return one_of(static_cast<int>(ms / (1000 * period)) + 1) == 0; }

  ArmSpec choose_arm() {
    switch (one_of(6)) {
      case 0:
        return irb4600_spec();
      case 1:
        return scara_spec();
      case 2:
        return xarm6_spec();
      case 3:
        return panda_spec();
      case 4:
        return random_spec(random);
      default:
        return cell_spec();
    }
  }

  struct Line {
    WaveShape shape = WaveShape::Sine;
    double width = 0, length = 0, turned = 0, speed = 0;
    KDL::Vector offset;  // mm
  };

  // A line from a random place, not along the tool.
  std::string choose(const ArmSpec& spec) {
    std::vector<double> q = spec.start;
    for (std::size_t i = 0; i < q.size(); ++i) {
      const ArmSpec::Part& p = spec.parts[i];
      const bool elbow = static_cast<int>(i) == spec.elbow;
      const double off = p.slides ? in(-0.05, 0.05) : elbow ? -in(0.3, 1.2) : in(-0.5, 0.5);
      q[i] = std::clamp(q[i] + off, p.lower + 0.05, p.upper - 0.05);
    }
    start = {};
    for (std::size_t i = 0; i < q.size(); ++i) {
      start[i] = q[i] * (spec.parts[i].slides ? 1000 : 180 / kPi);
    }
    line.shape = static_cast<WaveShape>(one_of(3));
    line.width = std::exp(in(std::log(0.5), std::log(30)));
    line.length = std::exp(in(std::log(1.5), std::log(80)));
    line.width = std::min(line.width, 3 * line.length);
    line.turned = one_of(3) == 0 ? in(-180, 180) : 0;
    line.speed = std::exp(in(std::log(15), std::log(800)));
    const KdlPlaces::Place at = places->at(start);
    axis = at.tip - at.end;
    axis.Normalize();
    line.offset = KDL::Vector(in(-1, 1), in(-1, 1), in(-1, 1));
    line.offset = line.offset - axis * (in(0.6, 1) * KDL::dot(axis, line.offset));
    if (spec.name == "scara") {
      line.offset.z(0.1 * line.offset.z());
      line.turned = 0;
    }
    line.offset.Normalize();
    line.offset = line.offset * in(30, 150);
    const KDL::Vector& o = line.offset;
    const auto leg = [&](const char* what, int number) { return fmt::format("SET OUT = {}\n{}\n", number, what); };
    const std::string there = fmt::format("MOVL HERE OFFSET {}, {}, {}", o.x(), o.y(), o.z());
    return fmt::format("TOOL t = POSE 0 0 100 RPY 0 0 0\nPOINT S = {}\nTOOL t\nMOVJ S\n", joints_text(spec, q)) +
           fmt::format("SPEED {} mm/s\nWEAVE {} WIDTH {} mm LENGTH {} mm TURNED {}\n", line.speed, word_of(line.shape),
                       line.width, line.length, line.turned) +
           leg(there.c_str(), 1) + leg("MOVL S", 2) + leg("WEAVE OFF", 3);
  }

  // mm that the tip is off the wave, on the present leg.
  double off() {
    const KDL::Vector tip = places->at(cell->out.command).tip * 1000;
    const KDL::Vector first = places->at(start).tip * 1000;
    const bool back = out() == 2;
    const KDL::Vector from = back ? first + line.offset : first;
    KDL::Vector forward = back ? line.offset * -1 : line.offset;
    const double whole = forward.Normalize();
    KDL::Vector across = forward * axis;
    across.Normalize();
    const KDL::Vector side = KDL::Rotation::Rot(forward, line.turned * kPi / 180) * across;
    const double gone = KDL::dot(tip - from, forward);
    const double far = wave_reference(line.shape, line.width, line.length, gone, whole);
    return (tip - from - forward * gone - side * far).Norm();
  }

  [[nodiscard]] double steep() const { return 1 + 1.4 * kPi * line.width / line.length; }
  [[nodiscard]] double out() const { return cell->values[0]; }
  [[nodiscard]] bool pending() const { return cell->out.done != cell->in.service.number; }

  void disturb() {
    if (every(700)) {
      cell->in.hold = one_of(3) == 0;
      cell->in.speed_override = one_of(2) == 0 ? 100 : one_of(100);
    }
    if (every(2500)) {
      if (one_of(3) == 0) {
        cell->in.emergency = true;
      } else if (cell->out.moving_by_job) {
        cell->ask(Service::JobStop);
      }
    }
  }
  // What an operator does to let the job continue.
  void recover() {
    if (cell->out.state == GroupState::ErrorStop && cell->out.job.can_resume) {
      cell->in.emergency = false;
      if (!pending()) {
        cell->ask(Service::GroupReset);
      }
    } else if (cell->out.state == GroupState::Disabled && !pending()) {
      cell->ask(Service::GroupEnable);
    } else if (cell->out.state == GroupState::Standby && cell->out.job.can_resume && !pending()) {
      cell->ask(Service::JobResume);
    }
  }

  // Whether the tip has to be on its wave: from the first leg on, except after a gate has rejected a set point, until
  // the robot has returned.
  bool on_path() {
    const GroupState state = cell->out.state;
    const ErrorCode error = cell->out.error;
    const bool gate = error == ErrorCode::JointLimit || error == ErrorCode::Speed || error == ErrorCode::Acceleration ||
                      error == ErrorCode::Jerk || error == ErrorCode::Singular;
    if (gate && !left && began && (state == GroupState::Stopping || state == GroupState::ErrorStop)) {
      ++gates;
      left = true;
    }
    const bool moves = state == GroupState::Moving && cell->out.moving_by_job;
    began = began || (moves && cell->out.tool_speed > 0);
    left = left && !(moves && off() < 0.02 * steep());
    return began && !left;
  }

  void run(bool disturbed) {
    began = left = false;
    for (int i = 0; i < 400'000; ++i) {
      cell->step();
      const GroupState state = cell->out.state;
      const bool woven = out() == 1 || out() == 2;
      ASSERT_EQ(judge->look(*cell, disturbed ? kEmergency : 1), "") << "period " << cell->periods;
      // A drive without power tells whole counts, from which the arm returns; where the wave is steep, the place along
      // the line counts more.
      if (woven && on_path() && (state == GroupState::Moving || state == GroupState::Stopping)) {
        const double away = off();
        worst = std::max(worst, away);
        ASSERT_LT(away, (disturbed ? 0.02 : 1e-5) * steep())
            << "period " << cell->periods << " state " << static_cast<int>(state);
      }
      if (out() == 3 || (state == GroupState::ErrorStop && !cell->out.job.can_resume)) {
        return;
      }
      if (disturbed && woven && state == GroupState::Moving) {
        disturb();
      } else if (state != GroupState::Moving && state != GroupState::Stopping) {
        cell->in.hold = false;
        recover();
      }
    }
    FAIL() << "does not end: " << cell->out.job.message;
  }

  std::mt19937 random;
  double period = 0.004;
  std::unique_ptr<Judge> judge;
  std::unique_ptr<Cell> cell;
  std::unique_ptr<KdlPlaces> places;
  AxisNumbers start{};
  KDL::Vector axis;
  Line line;
  bool began = false, left = false;
  int gates = 0;
  double worst = 0;
};

TEST_F(Random_weaves, The_tip_is_on_its_wave_and_no_limit_is_broken) {
  const int runs = number_of("INDUROP_ROBOT_WEAVES", 30);
  const int seed = number_of("INDUROP_ROBOT_SEED", 1);
  int good = 0;
  std::map<std::string, int> refused;
  for (int each = seed; each < seed + runs && !HasFailure(); ++each) {
    random.seed(static_cast<unsigned>(each));
    const ArmSpec spec = choose_arm();
    places = std::make_unique<KdlPlaces>(spec, KDL::Frame(KDL::Vector(0, 0, 0.1)));
    const std::string job = choose(spec);
    SCOPED_TRACE(fmt::format("{} of {}:\n{}", each, spec.name, job));
    constexpr std::array<double, 3> kPeriods{1, 4, 10};
    period = kPeriods[static_cast<std::size_t>(one_of(3))] / 1000;
    cell = std::make_unique<Cell>(job, 1000 * period, 0, true, Settings{}, spec.urdf());
    for (std::size_t i = 0; i < spec.parts.size(); ++i) {
      const double counts = spec.parts[i].slides ? 1000 : 1'320'000 / 360.0;
      cell->in.drives[i].position = static_cast<std::int32_t>(std::lround(counts * start[i]));
    }
    cell->step();
    judge = std::make_unique<Judge>(period, spec.urdf());
    ASSERT_EQ(judge->look(*cell, 1), "");
    ASSERT_TRUE(cell->serve(Service::GroupEnable));
    cell->in.service.job = 1;
    cell->ask(Service::JobStart);
    run(one_of(2) == 0);
    if (out() == 3) {
      ++good;
    } else {
      ++refused[cell->out.job.message];
    }
  }
  fmt::print("{} of {} woven, worst {:.1e} mm off, {} stopped by a gate\n", good, runs, worst, gates);
  for (const auto& [why, count] : refused) {
    fmt::print("{:4} {}\n", count, why);
  }
  EXPECT_GT(good, 0.7 * runs);
  EXPECT_LE(gates, runs / 50);
}

}  // namespace
}  // namespace indurop::robot
