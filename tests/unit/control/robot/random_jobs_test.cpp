// SPDX-License-Identifier: Apache-2.0
// Random jobs with holds, overrides, stops, emergencies and failing drives at random instants: no set point of any axis
// breaks a limit of position, speed, acceleration or jerk, nor the tool its workspace; and what is disturbed by nothing
// is never stopped by the last gate. INDUROP_ROBOT_JOBS says how many jobs, INDUROP_ROBOT_SEED from which one on.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <random>
#include <utility>

#include "limit_judge.h"
#include "random_job.h"
#include "robot_fixture.h"

namespace indurop::robot {
namespace {

// How far the tool is outside of its workspace, m.
double outside(const Workspace& box, const Outputs& out) {
  return box.outside(Vec3(out.position[0], out.position[1], out.position[2]) / 1000);
}

class Random_jobs : public testing::Test {
 protected:
  // What happened, by name.
  std::map<std::string, int> ends;
  int boxes = 0;
  // m, where axes brake on their own: of a path that ran along a side of the box.
  double most_outside = 0;

  void run(unsigned seed) { run(seed, seed % 3 == 0 ? 1 : seed % 3 == 1 ? 4 : 10, cell_urdf()); }
  void run_computing(unsigned seed) {
    constexpr std::array kArms{"", "gantry", "scara", "ur5", "iiwa14"};
    const std::string arm = kArms[seed % kArms.size()];
    run(seed, seed % 3 == 0 ? 1 : seed % 3 == 1 ? 4 : 10, arm.empty() ? cell_urdf() : urdf_of(arm), true);
  }
  void run(unsigned seed, double period_ms, const std::string& urdf, bool computes = false) {
    std::mt19937 random(seed);
    const Arm arm = arm_from_urdf("arm.urdf", urdf).value().arm;
    RandomJob made = random_job(arm, random);
    made = computes ? computing(std::move(made), arm, random) : std::move(made);
    const std::string& job = made.text;
    Settings settings;
    if (seed % 4 == 1 && arm.world_joint() == 0) {
      ++boxes;
      for (const Vec3& corner : {Vec3(made.low.array() - 0.002), Vec3(made.high.array() + 0.002)}) {
        settings.workspace.insert(settings.workspace.end(), {1000 * corner[0], 1000 * corner[1], 1000 * corner[2]});
      }
    }
    const Workspace box = Workspace::of(settings.workspace);
    std::unique_ptr<Cell> cell;
    ASSERT_NO_THROW(cell = std::make_unique<Cell>(job, period_ms, 0, true, settings, urdf)) << job;
    ASSERT_TRUE(cell->serve(Service::GroupEnable));
    Judge judge(period_ms / 1000, urdf);
    cell->in.service.job = 1;
    cell->ask(Service::JobStart);
    std::uniform_real_distribution<double> part(0, 1);
    const double often = part(random) < 0.4 ? 0 : 5 * period_ms / 1000;  // events per period
    bool emergency = false;
    bool failed = false;  // a drive: its axes brake on their own, whatever error was the first
    for (int i = 0; i < 20000 / period_ms; ++i) {
      if (part(random) < often) {
        disturb(*cell, arm.count(), random);
      }
      emergency = emergency || cell->in.emergency;
      failed = failed || std::any_of(cell->in.drives.begin(), cell->in.drives.end(),
                                     [](const auto& drive) { return drive.status == Cell::kFault; });
      cell->step();
      const std::string broken = judge.look(*cell, emergency ? kEmergency : 1);
      ASSERT_EQ(broken, "") << "seed " << seed << ", period " << i << " of " << period_ms << " ms, state "
                            << static_cast<int>(cell->out.state) << ", " << to_string(cell->out.error) << "\n"
                            << job;
      const double beyond = outside(box, cell->out);
      if (!failed && stays_on_its_path(cell->out.error)) {
        ASSERT_LE(beyond, 1e-6) << "seed " << seed << ", period " << i << " of " << period_ms << " ms, "
                                << to_string(cell->out.error) << "\n"
                                << job;
      } else {
        most_outside = std::max(most_outside, beyond);
      }
      if (i > 10 && cell->out.state != GroupState::Moving && cell->out.state != GroupState::Stopping) {
        break;
      }
    }
    if (often <= 0) {
      EXPECT_FALSE(stopped_by_gate(cell->out.error)) << "seed " << seed << ", line " << cell->out.job.line << " at "
                                                     << period_ms << " ms: " << to_string(cell->out.error) << "\n"
                                                     << job;
    }
    ends[cell->out.state == GroupState::ErrorStop ? to_string(cell->out.error) : "ended well"] += 1;
  }

 private:
  static bool stays_on_its_path(ErrorCode code) { return code != ErrorCode::Drive && !stopped_by_gate(code); }
  static bool stopped_by_gate(ErrorCode code) {
    constexpr std::array kLimits{ErrorCode::Speed, ErrorCode::Acceleration, ErrorCode::Jerk};
    return std::find(kLimits.begin(), kLimits.end(), code) != kLimits.end();
  }
  static void disturb(Cell& cell, int axes, std::mt19937& random) {
    switch (std::uniform_int_distribution<int>(0, 15)(random)) {
      case 0:
      case 1:
        cell.in.hold = !cell.in.hold;
        break;
      case 2:
      case 3:
      case 4:
        cell.in.speed_override = std::uniform_real_distribution<double>(0, 100)(random);
        break;
      case 5:
        cell.ask(Service::Stop);
        break;
      case 6:
        cell.in.emergency = true;
        break;
      case 7:
        cell.in.drives[std::uniform_int_distribution<std::size_t>(0, static_cast<std::size_t>(axes) - 1)(random)]
            .status = Cell::kFault;
        break;
      case 8:
        cell.ask(Service::GroupDisable);
        break;
      default:
        cell.in.hold = false;
    }
  }
};

TEST_F(Random_jobs, Break_no_limit_whatever_happens) {
  const int first = number_of("INDUROP_ROBOT_SEED", 1);
  const int jobs = number_of("INDUROP_ROBOT_JOBS", 300);
  for (int i = 0; i < jobs; ++i) {
    run(static_cast<unsigned>(first + i));
    if (HasFatalFailure()) {
      return;
    }
  }
  for (const auto& [end, many] : ends) {
    fmt::print("{:6} {}\n", many, end);
  }
  fmt::print("{} in a box; axes that braked on their own came {:.1f} mm out of it at most\n", boxes,
             1000 * most_outside);
}

// The same of jobs that compute places and end motions by conditions.
TEST_F(Random_jobs, That_compute_and_search_break_no_limit_either) {
  const int first = number_of("INDUROP_ROBOT_SEED", 1);
  const int jobs = number_of("INDUROP_ROBOT_JOBS", 1500) / 50;
  for (int i = 0; i < jobs; ++i) {
    run_computing(static_cast<unsigned>(first + i));
    if (HasFatalFailure()) {
      return;
    }
  }
  for (const auto& [end, many] : ends) {
    fmt::print("{:6} {}\n", many, end);
  }
}

// Jobs that began where an arm is stretched, so that joints step however slow it is: they were planned for minutes, and
// then the gate stopped them. And one that ended while a joint motion used all of a joint's jerk.
TEST_F(Random_jobs, That_were_planned_too_long_or_stopped_by_the_gate_are_not_any_more) {
  for (const unsigned seed : {84U, 97U, 132U, 144U}) {
    run_computing(seed);
  }
}

// Arms of every kind, in periods that motions do not end with.
class Random_jobs_of_arms : public Random_jobs, public testing::WithParamInterface<const char*> {};

TEST_P(Random_jobs_of_arms, Break_no_limit_either) {
  const int first = number_of("INDUROP_ROBOT_SEED", 1);
  const int jobs = number_of("INDUROP_ROBOT_JOBS", 1500) / 50;
  for (int i = 0; i < jobs; ++i) {
    constexpr std::array kPeriods{1.0, 2.0, 3.0, 4.0, 5.0, 8.0, 10.0};
    const auto seed = static_cast<unsigned>(first + i);
    run(seed, kPeriods[seed % kPeriods.size()], urdf_of(GetParam()));
    if (HasFatalFailure()) {
      return;
    }
  }
  for (const auto& [end, many] : ends) {
    fmt::print("{:6} {}\n", many, end);
  }
}

INSTANTIATE_TEST_SUITE_P(Kinds, Random_jobs_of_arms,
                         testing::Values("delta", "five_axis", "gantry", "iiwa14", "offset_wrist", "palletiser", "rail",
                                         "scara", "tilt_table", "turntable", "ur10", "ur3e", "ur5"),
                         [](const auto& arm) { return std::string(arm.param); });

// The same for single axes that are asked for one motion after the other.
TEST_F(Random_jobs, Single_axes_break_no_limit_either) {
  const auto many = static_cast<unsigned>(number_of("INDUROP_ROBOT_JOBS", 1500) / 25);
  for (unsigned seed = 1; seed <= many; ++seed) {
    std::mt19937 random(seed);
    const double period_ms = seed % 3 == 0 ? 1 : seed % 3 == 1 ? 4 : 10;
    Cell cell("", period_ms);
    ASSERT_TRUE(cell.serve(Service::GroupEnable));
    Judge judge(period_ms / 1000);
    const auto in = [&](double low, double high) { return std::uniform_real_distribution<double>(low, high)(random); };
    bool emergency = false;
    for (int i = 0; i < 8000 / period_ms; ++i) {
      if (in(0, 1) < 3 * period_ms / 1000) {
        const auto axis = std::uniform_int_distribution<std::size_t>(0, 5)(random);
        const AxisService services[] = {AxisService::MoveAbsolute, AxisService::MoveRelative, AxisService::MoveVelocity,
                                        AxisService::MoveAbsolute, AxisService::Stop};
        const AxisService service = services[std::uniform_int_distribution<std::size_t>(0, 4)(random)];
        const bool turns = service == AxisService::MoveVelocity;
        cell.ask_axis(axis, service, in(-100, 100), turns ? in(-500, 500) : in(1, 500));
        // Often less than what it is doing.
        const auto some = [&](double most) { return in(0, 1) < 0.3 ? 0 : most * std::pow(10, in(-2, 0)); };
        cell.in.axes[axis].acceleration = some(1000);
        cell.in.axes[axis].jerk = some(10000);
      }
      if (in(0, 1) < 2 * period_ms / 1000) {
        cell.in.speed_override = in(0, 100);
        cell.in.hold = in(0, 1) < 0.2;
      }
      emergency = emergency || in(0, 1) < 0.02 * period_ms / 1000;
      cell.in.emergency = emergency;
      cell.step();
      ASSERT_EQ(judge.look(cell, emergency ? kEmergency : 1), "")
          << "seed " << seed << ", period " << i << " of " << period_ms << " ms";
      if (!emergency) {
        ASSERT_NE(cell.out.state, GroupState::ErrorStop)
            << "seed " << seed << ", period " << i << " of " << period_ms << " ms: " << to_string(cell.out.error);
      }
    }
  }
}

// An accepted line whose joint speeds peak where the check did not look: axes ran away from there.
TEST_F(Random_jobs, A_trip_on_a_path_brakes_within_the_limits) {
  for (const double period_ms : {1.0, 4.0, 10.0}) {
    Cell cell(
        "POINT A = JOINT -46.613047 -76.185167 40.922607 -68.094120 -1.170863 36.025398\n"
        "POINT B = POSE -221.4792 -147.4714 1312.3754 RPY -17.01162 49.08639 -79.68231\nMOVJ A\nMOVL B\n",
        period_ms);
    ASSERT_TRUE(cell.serve(Service::GroupEnable));
    Judge judge(period_ms / 1000);
    cell.in.service.job = 1;
    cell.ask(Service::JobStart);
    for (int i = 0; i < 20000 / period_ms; ++i) {
      cell.step();
      ASSERT_EQ(judge.look(cell, 1), "") << "period " << i << " of " << period_ms << " ms";
    }
    EXPECT_NE(cell.out.state, GroupState::Moving);
  }
}

}  // namespace
}  // namespace indurop::robot
