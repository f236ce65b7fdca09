// SPDX-License-Identifier: Apache-2.0
// The jobs of the robot cell (examples/robot_cell), as their files are: where their tools, their taught frame and their
// path outputs come to in the base, and emergency stops in the middle of their lines, behind which they go on.
#include <gmock/gmock.h>

#include <random>
#include <vector>

#include "limit_judge.h"

namespace indurop::robot {
namespace {

// In the order of module.xml.
constexpr std::uint32_t kPick = 2;
constexpr std::uint32_t kPlace = 3;

// The cell's arm with the cell's files and its gripper.
class RobotCell {
 public:
  RobotCell() {
    Settings settings;
    settings.plan_in_tick = true;
    settings.urdf = std::string(ROBOT_CELL) + "/robot.urdf";
    for (const char* job : {"points", "pick", "place", "home", "glue"}) {
      settings.jobs.push_back(std::string(ROBOT_CELL) + "/" + job + ".job");
    }
    std::vector<std::string> errors;
    cell.sut = Controller::load(settings, errors);
    if (cell.sut == nullptr) {
      throw std::runtime_error(errors.at(0));
    }
    cell.in.service = {};
    step();
  }

  void step() {
    cell.step();
    signal("I4") = signal("O8") != 0 ? 1 : signal("O9") != 0 ? 0 : signal("I4");
    signal("I5") = 1 - signal("I4");
    broken += judge_.look(cell, cell.in.emergency ? kEmergency : 1);
  }
  template <class Condition>
  [[nodiscard]] bool until(const Condition& condition) {
    for (int i = 0; i < 5000 && !condition(); ++i) {
      step();
    }
    return condition();
  }
  [[nodiscard]] bool serve(Service service) {
    cell.ask(service);
    return until([&] { return cell.out.done == cell.in.service.number; }) && cell.out.error == ErrorCode::Ok;
  }
  void begin(std::uint32_t job) {
    cell.in.service.job = job;
    cell.ask(Service::JobStart);
    step();
  }
  double& signal(const std::string& name) {
    const auto& names = cell.sut->signals();
    return cell.values[std::find(names.begin(), names.end(), name) - names.begin()];
  }
  [[nodiscard]] Vec3 tip() const { return {cell.out.position[0], cell.out.position[1], cell.out.position[2]}; }
  [[nodiscard]] bool ended() const { return cell.out.done == cell.in.service.number; }

  Cell cell;
  std::string broken;  // limits of set points

 private:
  Judge judge_{0.01};
};

// Places of the tip, in the base, at which something was set.
struct Seen {
  std::vector<Vec3> path, dots, placed;
};

void note(RobotCell& sut, Seen& seen, double& valve, double& open) {
  seen.path.push_back(sut.tip());
  if (sut.signal("O10") > valve) {
    seen.dots.push_back(sut.tip());
  }
  if (sut.signal("O9") > open) {
    seen.placed.push_back(sut.tip());
  }
  valve = sut.signal("O10");
  open = sut.signal("O9");
}

// CELL::GLUE_*, CELL::PLACE_* of cell.glb; what the simulated surroundings read.
TEST(CellJobs, The_part_and_its_glue_are_where_the_surroundings_expect_them) {
  RobotCell sut;
  ASSERT_TRUE(sut.serve(Service::GroupEnable));
  sut.begin(kPick);
  ASSERT_TRUE(sut.until([&] { return sut.ended(); }));
  ASSERT_EQ(sut.cell.out.error, ErrorCode::Ok) << sut.cell.out.job.message;
  EXPECT_EQ(sut.signal("I4"), 1);
  Seen seen;
  double valve = 0;
  double open = 0;
  sut.begin(kPlace);
  ASSERT_TRUE(sut.until([&] {
    note(sut, seen, valve, open);
    return sut.ended();
  }));
  ASSERT_EQ(sut.cell.out.error, ErrorCode::Ok) << sut.cell.out.job.message;
  ASSERT_EQ(seen.dots.size(), 3U);
  constexpr double kTwoPeriods = 150 * 0.02;  // mm at 150 mm/s
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3 off = seen.dots[i] - Vec3(420 + 30 * static_cast<double>(i), 300, 155);
    EXPECT_GE(off.x(), -0.01);
    EXPECT_LT(off.x(), kTwoPeriods);
    EXPECT_LT(std::hypot(off.y(), off.z()), 0.01);  // the angles of the taught points have three decimals
  }
  ASSERT_EQ(seen.placed.size(), 1U);
  EXPECT_LT((seen.placed[0] - Vec3(450, 300, 150)).norm(), 0.01);
  EXPECT_EQ(sut.broken, "");
}

double away(const std::vector<Vec3>& path, const Vec3& place) {
  double least = HUGE_VAL;
  for (std::size_t i = 1; i < path.size(); ++i) {
    const Vec3 way = path[i] - path[i - 1];
    const double part = std::clamp((place - path[i - 1]).dot(way) / std::max(way.squaredNorm(), 1e-12), 0.0, 1.0);
    least = std::min(least, (place - path[i - 1] - part * way).norm());
  }
  return least;
}

// As rungs of main.xml ask for it, with a hand that pushes the arm while it has no power.
void stop_and_go_on(RobotCell& sut, std::mt19937& random) {
  sut.cell.in.emergency = true;
  ASSERT_TRUE(sut.until([&] { return sut.cell.out.state == GroupState::ErrorStop; }));
  ASSERT_TRUE(sut.cell.out.job.can_resume);
  for (int i = 0; i < 50; ++i) {
    sut.step();
  }
  for (DriveIn& drive : sut.cell.in.drives) {
    drive.position += std::uniform_int_distribution<std::int32_t>(-4000, 4000)(random);  // 1.1 degrees
  }
  sut.step();
  sut.cell.in.emergency = false;
  sut.step();
  ASSERT_TRUE(sut.serve(Service::GroupReset));
  ASSERT_TRUE(sut.serve(Service::GroupEnable));
  sut.cell.ask(Service::JobResume);
  ASSERT_TRUE(sut.until([&] {
    EXPECT_LE(sut.cell.out.tool_speed, 110);
    return sut.cell.out.job.state == JobState::Runs || sut.ended();
  }));
  ASSERT_EQ(sut.cell.out.error, ErrorCode::Ok) << sut.cell.out.job.message;
}

TEST(CellJobs, An_emergency_stop_in_any_line_is_gone_on_from_on_the_path) {
  RobotCell calm;
  ASSERT_TRUE(calm.serve(Service::GroupEnable));
  calm.begin(kPlace);
  Seen undisturbed;
  double valve = 0;
  double open = 0;
  ASSERT_TRUE(calm.until([&] {
    note(calm, undisturbed, valve, open);
    return calm.ended();
  }));
  std::mt19937 random(17);
  for (int stop = 0; stop < 6; ++stop) {
    RobotCell sut;
    ASSERT_TRUE(sut.serve(Service::GroupEnable));
    sut.begin(kPlace);
    int lines_to_go = stop;
    std::uint32_t line = 0;
    ASSERT_TRUE(sut.until([&] {
      const bool straight = sut.cell.out.tool_speed > 60 && sut.cell.out.job.line != line && sut.cell.out.to_go < 0.3;
      line = straight ? sut.cell.out.job.line : line;
      lines_to_go -= straight ? 1 : 0;
      return lines_to_go < 0 || sut.ended();
    }));
    ASSERT_FALSE(sut.ended());
    const std::uint32_t stopped_in = sut.cell.out.job.line;
    stop_and_go_on(sut, random);
    if (testing::Test::HasFatalFailure()) {
      return;
    }
    EXPECT_EQ(sut.cell.out.job.line, stopped_in);
    double farthest = 0;
    ASSERT_TRUE(sut.until([&] {
      farthest = std::max(farthest, away(undisturbed.path, sut.tip()));
      return sut.ended();
    }));
    EXPECT_EQ(sut.cell.out.error, ErrorCode::Ok) << sut.cell.out.job.message;
    EXPECT_EQ(sut.cell.out.job.state, JobState::Ended);
    EXPECT_LT(farthest, 0.5) << "stopped in line " << stopped_in;
    EXPECT_LT((sut.tip() - calm.tip()).norm(), 1e-6);
    EXPECT_EQ(sut.broken, "") << "stopped in line " << stopped_in;
  }
}

}  // namespace
}  // namespace indurop::robot
