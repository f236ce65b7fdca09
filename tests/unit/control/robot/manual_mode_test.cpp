// SPDX-License-Identifier: Apache-2.0
// Manual mode: neither the tool's tip nor the arm's end is ever faster than 250 mm/s (ISO 10218-1), in the world and
// over a workpiece that moves, whatever moves the robot, seen from the set points; nothing moves without the enabling
// switch; and paths are those of automatic mode.
#include <fmt/format.h>

#include <array>
#include <functional>
#include <random>
#include <vector>

#include "limit_judge.h"
#include "random_job.h"

namespace indurop::robot {
namespace {

constexpr const char* kTool = "TOOL long = POSE 0 100 300 RPY 20 0 0\nTOOL long\n";
constexpr double kCm = 0.01;

// The faster of the tip and the arm's end, from set point to set point.
class Speeds {
 public:
  explicit Speeds(const std::string& urdf) : arm_(arm_from_urdf("robot.urdf", urdf).value().arm) {}
  double look(const Cell& cell, double period) {
    Joints q = Joints::Zero();
    for (int i = 0; i < arm_.count(); ++i) {
      const auto k = static_cast<std::size_t>(i);
      q[i] = cell.out.command[k] * (arm_.axis(i).slides() ? 0.001 : kPi / 180);
    }
    const Vec3 end = arm_.forward(q).position;
    const Vec3 tip = Vec3(cell.out.position[0], cell.out.position[1], cell.out.position[2]) / 1000;
    const ChainFrame world = arm_.world(q);
    const auto in_world = [&](const Vec3& place) -> Vec3 { return world.turn.transpose() * (place - world.shift); };
    const std::array<Vec3, 4> now{end, in_world(end), tip, in_world(tip)};
    const bool same_tool = tool_ == cell.out.tool;
    double fastest = 0;
    for (std::size_t i = 0; i < (same_tool ? 4 : 2); ++i) {
      fastest = std::max(fastest, (now[i] - last_[i]).norm() / period);
    }
    const double seen = first_ ? 0 : fastest;
    first_ = false;
    tool_ = cell.out.tool;
    last_ = now;
    return 1000 * seen;
  }

 private:
  Arm arm_;
  bool first_ = true;
  std::uint32_t tool_ = 0;
  std::array<Vec3, 4> last_{};  // the end and the tip, each seen from the base and from the world
};

double in(std::mt19937& random, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random);
}

void choose(Cell& cell, OperatingMode mode, bool enabled = true) {
  cell.in.mode.mode = mode;
  cell.in.mode.enabled = enabled;
}

// Limits of a period: releasing the switch stops as in an emergency. What set points do then is seen as
// differences for three periods more.
class Hardness {
 public:
  double of(const Cell& cell) {
    const bool stops = !cell.in.mode.enabled || cell.out.state == GroupState::Stopping;
    since_ = stops ? 0 : since_ + 1;
    return since_ > 3 ? 1 : kEmergency;
  }

 private:
  int since_ = 0;
};

struct DriveBy {
  double often = 0;  // releases of the switch, holds and overrides per second
  double fastest = 0;
  double longest = 0;  // s from the release of the switch until it stands
  int stopped_by_gate = 0, ended = 0;
};

// Random jobs in manual mode; what the switch stops goes on when it is asked for.
void run_job(unsigned seed, double period_ms, const std::string& urdf, DriveBy& by) {
  std::mt19937 random(seed);
  const Arm arm = arm_from_urdf("arm.urdf", urdf).value().arm;
  const std::string job = (seed % 2 == 0 ? kTool : "") + random_job(arm, random).text;
  Cell cell(job, period_ms, 0, true, {}, urdf);
  choose(cell, OperatingMode::Manual);
  ASSERT_TRUE(cell.serve(Service::GroupEnable));
  Judge judge(period_ms / 1000, urdf);
  Hardness hardness;
  Speeds speeds(urdf);
  cell.in.service.job = 1;
  cell.ask(Service::JobStart);
  double released = 0;
  for (int i = 0; i < 60'000 / period_ms; ++i) {
    if (in(random, 0, 1) < by.often * period_ms / 1000) {
      cell.in.mode.enabled = in(random, 0, 1) < 0.5;
      cell.in.hold = in(random, 0, 1) < 0.2;
      cell.in.speed_override = in(random, 0, 1) < 0.5 ? 100 : in(random, 5, 100);
    }
    if (cell.out.state == GroupState::Standby && cell.out.job.can_resume && cell.in.mode.enabled) {
      cell.ask(Service::JobResume);
    }
    cell.step();
    ASSERT_EQ(judge.look(cell, hardness.of(cell)), "") << "seed " << seed << ", period " << i << "\n" << job;
    const double speed = speeds.look(cell, period_ms / 1000);
    by.fastest = std::max(by.fastest, speed);
    ASSERT_LE(speed, 250) << "seed " << seed << ", period " << i << ", line " << cell.out.job.line << "\n" << job;
    released = cell.in.mode.enabled ? 0 : released + period_ms / 1000;
    by.longest = speed > 0 ? std::max(by.longest, released) : by.longest;
    if (i > 10 && (cell.out.state == GroupState::ErrorStop ||
                   (cell.out.state == GroupState::Standby && !cell.out.job.can_resume))) {
      break;
    }
  }
  by.stopped_by_gate += cell.out.state == GroupState::ErrorStop && cell.out.error == ErrorCode::Speed ? 1 : 0;
  by.ended += cell.out.state == GroupState::Standby ? 1 : 0;
}

class Manual_mode_of : public testing::TestWithParam<const char*> {};

TEST_P(Manual_mode_of, Jobs_are_never_faster_than_250_mm_per_second) {
  DriveBy undisturbed;
  DriveBy disturbed{3};
  for (unsigned seed = 1; seed <= 8; ++seed) {
    constexpr std::array kPeriods{2.0, 4.0, 10.0};
    ASSERT_NO_FATAL_FAILURE(run_job(seed, kPeriods[seed % 3], urdf_of(GetParam()), undisturbed));
    ASSERT_NO_FATAL_FAILURE(run_job(seed, kPeriods[seed % 3], urdf_of(GetParam()), disturbed));
  }
  fmt::print("at most {:.1f} mm/s, disturbed {:.1f}; {} and {} went on to their end; stood {:.3f} s after a release\n",
             undisturbed.fastest, disturbed.fastest, undisturbed.ended, disturbed.ended, disturbed.longest);
  EXPECT_EQ(undisturbed.stopped_by_gate + disturbed.stopped_by_gate, 0);
  EXPECT_GT(undisturbed.fastest, 200);
  EXPECT_GT(undisturbed.ended, 0);
  EXPECT_GT(disturbed.ended, 0);
}

INSTANTIATE_TEST_SUITE_P(Kinds, Manual_mode_of,
                         testing::Values("delta", "five_axis", "gantry", "iiwa14", "offset_wrist", "palletiser", "rail",
                                         "scara", "turntable", "ur10"),
                         [](const auto& arm) { return std::string(arm.param); });

// Everything that can be asked for, at random, to the group and to single axes.
void ask_anything(Cell& cell, std::mt19937& random) {
  const auto one_of = [&](int many) { return std::uniform_int_distribution<int>(0, many - 1)(random); };
  constexpr std::array kServices{Service::MoveJoints,     Service::MoveLine, Service::DirectAbsolute,
                                 Service::DirectAborting, Service::Stop,     Service::JobStart,
                                 Service::JobResume,      Service::JobBack};
  constexpr std::array kOfAxes{AxisService::MoveAbsolute, AxisService::MoveVelocity, AxisService::MoveRelative,
                               AxisService::Stop};
  switch (one_of(4)) {
    case 0:
    case 1:
      cell.in.service.point = static_cast<std::uint32_t>(1 + one_of(2));
      cell.in.service.job = 1;
      cell.in.service.target = {in(random, -60, 60), in(random, -40, 30), in(random, -40, 40),
                                in(random, -90, 90), in(random, 20, 90),  in(random, -90, 90)};
      cell.ask(kServices[static_cast<std::size_t>(one_of(kServices.size()))]);
      break;
    case 2:
      cell.ask_axis(static_cast<std::size_t>(one_of(6)), kOfAxes[static_cast<std::size_t>(one_of(kOfAxes.size()))],
                    in(random, -60, 60), in(random, 10, 300));
      break;
    default:
      cell.in.jog = {};
      cell.in.jog.enabled = one_of(3) > 0;
      cell.in.jog.frame = static_cast<JogFrame>(one_of(3));
      cell.in.jog.speed[static_cast<std::size_t>(one_of(6))] = one_of(2) == 0 ? 100 : -100;
  }
}

TEST(Manual_mode, Nothing_is_faster_than_250_mm_per_second_nor_moves_without_the_switch) {
  double fastest = 0;
  int by_gate = 0;
  int moved = 0;
  for (unsigned seed = 1; seed <= 12; ++seed) {
    std::mt19937 random(seed);
    const double period_ms = seed % 2 == 0 ? 4 : 10;
    Cell cell(std::string(kTool) + "MOVJ P1\nMOVL P2\nMOVJ P1 STRAIGHT\n", period_ms);
    choose(cell, OperatingMode::Manual);
    ASSERT_TRUE(cell.serve(Service::GroupEnable));
    Judge judge(period_ms / 1000);
    Hardness hardness;
    Speeds speeds(cell_urdf());
    double released = 0;  // s
    for (int i = 0; i < 12'000 / period_ms; ++i) {
      if (in(random, 0, 1) < 2 * period_ms / 1000) {
        ask_anything(cell, random);
      }
      if (in(random, 0, 1) < 0.5 * period_ms / 1000) {
        cell.in.mode.enabled = !cell.in.mode.enabled;
      }
      if (cell.out.state == GroupState::ErrorStop) {
        by_gate += cell.out.error == ErrorCode::Speed ? 1 : 0;
        cell.ask(Service::GroupReset);
      }
      cell.step();
      ASSERT_EQ(judge.look(cell, hardness.of(cell)), "") << "seed " << seed << ", period " << i;
      const double speed = speeds.look(cell, period_ms / 1000);
      released = cell.in.mode.enabled ? 0 : released + period_ms / 1000;
      fastest = std::max(fastest, speed);
      ASSERT_LE(speed, 250) << "seed " << seed << ", period " << i << ", " << to_string(cell.out.error);
      if (released > 1) {
        ASSERT_LE(speed, 0) << "seed " << seed << ", period " << i << ", released for " << released << " s";
      }
      moved += speed > 10 ? 1 : 0;
    }
  }
  fmt::print("at most {:.1f} mm/s; the last gate stopped {} times\n", fastest, by_gate);
  EXPECT_GT(fastest, 200);
  EXPECT_GT(moved, 3000);
  EXPECT_EQ(by_gate, 0);
}

// The way that is tried out by hand is the way that the robot goes in automatic mode.
TEST(Manual_mode, Goes_the_ways_of_automatic_mode) {
  const std::string job = "MOVJ P1\nZONE 20 mm\nMOVL P2\nMOVJ P1\nZONE 0\nMOVJ P2\n";
  const auto path = [&](OperatingMode mode, double override_percent) {
    std::vector<Vec3> way;
    Cell cell(job, 2);
    choose(cell, mode);
    cell.in.speed_override = override_percent;
    EXPECT_TRUE(cell.serve(Service::GroupEnable));
    cell.in.service.job = 1;
    cell.ask(Service::JobStart);
    EXPECT_TRUE(cell.until(
        [&] {
          way.emplace_back(Vec3(cell.out.position[0], cell.out.position[1], cell.out.position[2]) / 1000);
          return cell.out.done == cell.in.service.number;
        },
        60'000));
    EXPECT_EQ(cell.out.error, ErrorCode::Ok);
    return way;
  };
  const std::vector<Vec3> reference = path(OperatingMode::Automatic, 80);
  const std::vector<Vec3> tried = path(OperatingMode::Manual, 100);
  for (std::size_t k = 0; k < tried.size(); k += 20) {
    const Vec3& place = tried[k];
    double least = HUGE_VAL;
    for (std::size_t i = 1; i < reference.size(); ++i) {
      const Vec3 way = reference[i] - reference[i - 1];
      const double part =
          std::clamp((place - reference[i - 1]).dot(way) / std::max(way.squaredNorm(), 1e-18), 0.0, 1.0);
      least = std::min(least, (place - reference[i - 1] - part * way).norm());
    }
    ASSERT_LT(least, 0.1 * kCm);
  }
}

TEST(Manual_mode, A_released_switch_stops_and_what_was_stopped_goes_on_only_when_asked) {
  Cell cell("MOVJ P1\nMOVL P2\n");
  choose(cell, OperatingMode::Manual);
  ASSERT_TRUE(cell.serve(Service::GroupEnable));
  cell.in.service.job = 1;
  cell.ask(Service::JobStart);
  ASSERT_TRUE(cell.until([&] { return cell.out.tool_speed > 100; }));
  cell.in.mode.enabled = false;
  ASSERT_TRUE(cell.until([&] { return cell.out.state == GroupState::Standby; }, 60));
  EXPECT_EQ(cell.out.error, ErrorCode::Enabling);
  EXPECT_STREQ(cell.out.job.message, to_string(ErrorCode::Enabling));
  EXPECT_FALSE(cell.out.may_move);
  EXPECT_FALSE(cell.serve(Service::JobResume));
  EXPECT_EQ(cell.out.error, ErrorCode::Enabling);
  cell.in.mode.enabled = true;
  for (int i = 0; i < 100; ++i) {
    cell.step();
    ASSERT_LE(cell.out.tool_speed, 0) << "no motion was requested";
  }
  EXPECT_TRUE(cell.serve(Service::JobResume)) << to_string(cell.out.error);
  EXPECT_EQ(cell.out.job.state, JobState::Ended);
  EXPECT_LT((Vec3(cell.out.position[0], cell.out.position[1], cell.out.position[2]) - Vec3(500, 100, 400)).norm(),
            1e-3);
}

TEST(Manual_mode, Changes_once_the_robot_stands) {
  Cell cell("LOOP\nMOVJ P1\nMOVL P2\nEND\n");
  choose(cell, OperatingMode::Automatic);
  ASSERT_TRUE(cell.serve(Service::GroupEnable));
  cell.in.service.job = 1;
  cell.ask(Service::JobStart);
  ASSERT_TRUE(cell.until([&] { return cell.out.tool_speed > 400; }));
  choose(cell, OperatingMode::Manual);
  cell.step();
  EXPECT_EQ(cell.out.mode, OperatingMode::Automatic) << "it still moves";
  EXPECT_FALSE(cell.out.may_move);
  ASSERT_TRUE(cell.until([&] { return cell.out.state == GroupState::Standby; }, 100))
      << static_cast<int>(cell.out.state) << ' ' << to_string(cell.out.error) << ' ' << cell.out.tool_speed << ' '
      << cell.out.job.message;
  EXPECT_EQ(cell.out.error, ErrorCode::Mode);
  cell.step();
  EXPECT_EQ(cell.out.mode, OperatingMode::Manual);
  EXPECT_TRUE(cell.out.may_move);
  Speeds speeds(cell_urdf());
  cell.ask(Service::JobResume);
  double fastest = 0;
  for (int i = 0; i < 1000; ++i) {
    cell.step();
    fastest = std::max(fastest, speeds.look(cell, 0.01));
  }
  EXPECT_LE(fastest, 250);
  EXPECT_GT(fastest, 200);
}

TEST(Manual_mode, In_automatic_mode_it_cannot_be_jogged) {
  Cell cell;
  choose(cell, OperatingMode::Automatic, false);
  ASSERT_TRUE(cell.serve(Service::GroupEnable));
  cell.in.jog.enabled = true;
  cell.in.jog.speed[0] = 50;
  for (int i = 0; i < 100; ++i) {
    cell.step();
    ASSERT_LE(cell.out.tool_speed, 0);
  }
  cell.in.jog = {};
  cell.in.service.point = 1;
  EXPECT_TRUE(cell.serve(Service::MoveJoints)) << "it needs no switch";
}

TEST(Manual_mode, A_number_that_is_no_mode_lets_nothing_move) {
  for (const int number : {-1, 3, 32767}) {
    Cell cell;
    choose(cell, static_cast<OperatingMode>(number));
    ASSERT_TRUE(cell.serve(Service::GroupEnable));
    cell.in.service.point = 1;
    EXPECT_FALSE(cell.serve(Service::MoveJoints));
    EXPECT_EQ(cell.out.error, ErrorCode::Enabling);
    EXPECT_FALSE(cell.serve_axis(0, AxisService::MoveRelative, 5));
    EXPECT_EQ(cell.out.axes[0].error, ErrorCode::Enabling);
  }
}

}  // namespace
}  // namespace indurop::robot
