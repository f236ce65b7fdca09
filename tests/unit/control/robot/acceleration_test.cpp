// SPDX-License-Identifier: Apache-2.0
// ACC: set points of random jobs of all kinds of arms keep that part of the joints' accelerations and jerks; what it
// changes on the way breaks no limit; and a joint motion takes as long as its slowest axis with those limits.
#include <fmt/format.h>

#include <random>
#include <sstream>

#include "limit_judge.h"
#include "random_job.h"

namespace indurop::robot {
namespace {

struct Ran {
  double seconds = 0;
  ErrorCode error = ErrorCode::Ok;
};

Ran run(const std::string& job, double period_ms, const std::string& urdf, double part) {
  Cell cell(job, period_ms, 0, true, {}, urdf);
  EXPECT_TRUE(cell.serve(Service::GroupEnable));
  Judge judge(period_ms / 1000, urdf);
  cell.in.service.job = 1;
  cell.ask(Service::JobStart);
  Ran ran;
  double moving = 0;
  for (int i = 0; i < 120'000 / period_ms; ++i) {
    cell.step();
    const bool stops = cell.out.state == GroupState::Stopping || cell.out.state == GroupState::ErrorStop;
    const std::string broken = judge.look(cell, stops ? 1 : part, stops ? 1 : part);
    EXPECT_EQ(broken, "") << "period " << i << ", line " << cell.out.job.line << ", " << part << "\n" << job;
    if (!broken.empty()) {
      break;
    }
    moving += cell.out.state == GroupState::Moving ? period_ms / 1000 : 0;
    if (i > 10 && cell.out.state != GroupState::Moving && cell.out.state != GroupState::Stopping) {
      break;
    }
  }
  ran.seconds = moving;
  ran.error = cell.out.error;
  return ran;
}

bool by_gate(ErrorCode code) {
  return code == ErrorCode::Speed || code == ErrorCode::Acceleration || code == ErrorCode::Jerk;
}

class Acceleration_of : public testing::TestWithParam<const char*> {};

TEST_P(Acceleration_of, Set_points_take_that_part_of_the_limits) {
  const std::string urdf = urdf_of(GetParam());
  const Arm arm = arm_from_urdf("arm.urdf", urdf).value().arm;
  int ended = 0;
  for (unsigned seed = 1; seed <= 8; ++seed) {
    std::mt19937 random(seed);
    const std::string job = random_job(arm, random).text;
    const double part = std::uniform_int_distribution<int>(5, 60)(random) / 100.0;
    const double period_ms = seed % 2 == 0 ? 4 : 10;
    const Ran gentle = run(fmt::format("ACC {}%\n", 100 * part) + job, period_ms, urdf, part);
    ASSERT_FALSE(by_gate(gentle.error)) << to_string(gentle.error);
    const Ran full = run(job, period_ms, urdf, 1);
    if (gentle.error == ErrorCode::Ok && full.error == ErrorCode::Ok) {
      ++ended;
      EXPECT_GT(gentle.seconds, full.seconds) << "seed " << seed;
    }
  }
  EXPECT_GT(ended, 0);
}

// Another part in front of each line, at random.
TEST_P(Acceleration_of, Changes_on_the_way_break_no_limit) {
  const std::string urdf = urdf_of(GetParam());
  const Arm arm = arm_from_urdf("arm.urdf", urdf).value().arm;
  for (unsigned seed = 101; seed <= 108; ++seed) {
    std::mt19937 random(seed);
    std::istringstream lines(random_job(arm, random).text);
    std::string job;
    for (std::string line; std::getline(lines, line);) {
      if (line.starts_with("MOV") && random() % 3 == 0) {
        job += fmt::format("ACC {}%\n", 1 + random() % 100);
      }
      job += line + "\n";
    }
    const Ran ran = run(job, seed % 2 == 0 ? 4 : 10, urdf, 1);
    ASSERT_FALSE(by_gate(ran.error)) << to_string(ran.error) << "\n" << job;
  }
}

INSTANTIATE_TEST_SUITE_P(Kinds, Acceleration_of,
                         testing::Values("delta", "five_axis", "iiwa14", "offset_wrist", "palletiser", "rail", "scara",
                                         "turntable", "ur10"),
                         [](const auto& arm) { return std::string(arm.param); });

TEST(Acceleration, A_joint_motion_takes_as_long_as_its_slowest_axis_with_that_part) {
  const ArmModel model = arm_from_urdf("robot.urdf", cell_urdf()).value();
  std::mt19937 random(3);
  for (const int percent : {100, 50, 20, 5}) {
    const auto angle = [&](double most) { return std::uniform_real_distribution<double>(-most, most)(random); };
    const std::array<double, 6> to{angle(90), angle(30), angle(30), angle(90), angle(90), angle(90)};
    const std::string job = fmt::format("POINT T = JOINT {}\nACC {}%\nMOVJ T\n", fmt::join(to, " "), percent);
    const Ran ran = run(job, 1, cell_urdf(), percent / 100.0);
    ASSERT_EQ(ran.error, ErrorCode::Ok) << job;
    double slowest = 0;
    for (int i = 0; i < 6; ++i) {
      const double most = model.velocity[i];
      const Settings settings;
      const double acceleration = most / settings.time_to_speed;
      const LineLimits limits{most, acceleration * percent / 100,
                              acceleration / settings.time_to_acceleration * percent / 100};
      const double way = std::abs(to[static_cast<std::size_t>(i)]) * kPi / 180;
      slowest = std::max(slowest, Profile::to_position({}, way, 0, limits).duration());
    }
    EXPECT_NEAR(ran.seconds, slowest + Settings{}.plan_time, 0.02) << percent << " %";
  }
}

}  // namespace
}  // namespace indurop::robot
