// SPDX-License-Identifier: Apache-2.0
// The speed over a workpiece that turns meanwhile: from one set point to the next, where the tool is on the workpiece
// is computed from the arm in the world and the axes of the table by hand. INDUROP_ROBOT_TURNS says how many lines and
// circles of each table, INDUROP_ROBOT_SEED from which one on.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

#include "control/robot/files/check_slow_axes.h"
#include "control/robot/files/read_files.h"
#include "group_cell.h"

namespace indurop::robot {
namespace {

class Turning_speed : public testing::TestWithParam<const char*> {
 protected:
  Turning_speed() : urdf_(urdf_of(GetParam())), arm_(arm_from_urdf("arm.urdf", urdf_).value().arm.in_world()) {}

  double in(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random); }
  [[nodiscard]] bool tilts() const { return GetParam() == std::string("tilt_table"); }
  std::string point(const char* name, double turned) {
    return fmt::format("POINT {} = POSE {:.3f} {:.3f} {:.3f} RPY 180 {:.3f} {:.3f}{} AXIS {} {:.3f}\n", name,
                       in(-120, 120), in(-120, 120), in(120, 200), in(-15, 15), in(-30, 30),
                       tilts() ? fmt::format(" AXIS 7 {:.3f}", in(-10, 10)) : "", tilts() ? 8 : 7, turned);
  }
  // The tables as their files describe them, seen from the workpiece while they are at zero.
  [[nodiscard]] Vec3 on_workpiece() const {
    Joints q = Joints::Zero();
    for (int i = 0; i < arm_.count() + 2; ++i) {
      q[i] = cell->out.command[static_cast<std::size_t>(i)] * kPi / 180;
    }
    const Vec3 tip = arm_.forward(q).position;
    const Vec3 tilt(0, 0, tilts() ? -0.1 : 0);
    const Vec3 upright = tilts() ? Vec3(Eigen::AngleAxisd(-q[6], Vec3::UnitY()) * (tip - tilt) + tilt) : tip;
    return Eigen::AngleAxisd(-q[tilts() ? 7 : 6], Vec3::UnitZ()) * upright;
  }
  // mm/s in each period of the last motion of the job.
  std::vector<double> speeds(const std::string& job, std::uint32_t line) {
    cell = std::make_unique<Cell>(job, kPeriod, 0, true, Settings{}, urdf_);
    EXPECT_TRUE(cell->serve(Service::GroupEnable));
    cell->in.service.job = 1;
    cell->ask(Service::JobStart);
    std::vector<double> found;
    Vec3 before = on_workpiece();
    const bool ended = cell->until(
        [&] {
          const Vec3 here = on_workpiece();
          if (cell->out.job.line == line && cell->out.job.state == JobState::Runs) {
            found.push_back(1e6 * (here - before).norm() / kPeriod);
          }
          before = here;
          return cell->out.job.state == JobState::Ended || cell->out.job.state == JobState::Failed;
        },
        40000);
    return ended && cell->out.job.state == JobState::Ended ? found : std::vector<double>{};
  }

  static constexpr double kPeriod = 4;  // ms
  std::mt19937 random;
  std::unique_ptr<Cell> cell;

 private:
  const std::string urdf_;
  const Arm arm_;
};

TEST_P(Turning_speed, Is_the_one_that_was_asked_for) {
  const int first = number_of("INDUROP_ROBOT_SEED", 1);
  int many = 0;
  double least = HUGE_VAL;
  double most = 0;
  double fastest = 0;
  for (int seed = first; seed < first + number_of("INDUROP_ROBOT_TURNS", 24); ++seed) {
    random.seed(static_cast<unsigned>(seed));
    const double asked = in(20, 150);
    const bool circle = seed % 3 == 0;
    const double turned = seed % 4 == 0 ? 0 : in(-25, 25);
    const std::string points = point("A", 0) + point("B", 0) + point("C", 0);
    const std::string job = points + "MOVJ A\n" + (circle ? "MOVC B C" : "MOVL C") +
                            fmt::format(" AXIS {} {:.3f} SPEED {:.3f} mm/s\n", tilts() ? 8 : 7, turned, asked);
    const std::vector<double> found = speeds(job, 5);
    constexpr std::size_t kLong = 200;  // periods, of which those in the middle have a constant speed
    if (found.size() < kLong) {
      continue;  // or it is out of reach
    }
    const auto [low, high] = std::minmax_element(found.begin() + static_cast<std::ptrdiff_t>(found.size() * 2 / 5),
                                                 found.begin() + static_cast<std::ptrdiff_t>(found.size() * 3 / 5));
    ++many;
    least = std::min(least, *low / asked);
    most = std::max(most, *high / asked);
    fastest = std::max(fastest, *std::max_element(found.begin(), found.end()) / asked);
  }
  fmt::print("{} motions, in the middle at {:.5f} to {:.5f} of the speed asked for, nowhere above {:.5f}\n", many,
             least, most, fastest);
  EXPECT_GT(many, 0);
  EXPECT_GT(least, 0.998);
  EXPECT_LT(fastest, 1.005);
}

// The table needs longer than the line at this speed: the figures of the warning are those of the set points.
TEST_P(Turning_speed, Is_known_before_if_the_table_is_too_slow_for_it) {
  const std::string axis = tilts() ? "AXIS 8 " : "AXIS 7 ";
  const std::string job = "POINT A = POSE 80 -60 150 RPY 180 0 0" + std::string(tilts() ? " AXIS 7 0 " : " ") + axis +
                          "0\nPOINT B = POSE -80 -60 150 RPY 180 0 0\nPOINT C = POSE 0 -30 150 RPY 180 0 0\nMOVJ A\n"
                          "SPEED 200 mm/s\nMOVL B " +
                          axis + "-160\nMOVC C A " + axis +
                          "0\nMOVL B\nSPEED 20 mm/s\n"
                          "MOVL A " +
                          axis + "10\nLOOP 2\nMOVL B " + axis + "170 SPEED 500 mm/s\nEND\n";
  ReadJobs read = parse_jobs({{"main.job", job}}, shape_of(arm_of(GetParam())));
  ASSERT_TRUE(read.diagnostics.empty()) << base::to_text(read.diagnostics);
  const std::vector<base::Diagnostic> said =
      check_slow_axes(read.book, arm_from_urdf("arm.urdf", urdf_of(GetParam())).value(), 1000);
  const std::string axis_8 =
      "axis 8 (turn): its 160 degrees take 1.396 s at full speed, 114.6 degrees/s, so the tool moves at ";
  const std::string axis_7 =
      "axis 7 (turn): its 160 degrees take 1.862 s at full speed, 85.94 degrees/s, so the tool moves at ";
  const std::string because = ":1: warning: SPEED 200 mm/s is too fast for " + (tilts() ? axis_8 : axis_7);
  EXPECT_EQ(base::to_text(said), "main.job:6" + because + (tilts() ? "114.6" : "85.94") + " mm/s at most\nmain.job:7" +
                                     because + (tilts() ? "125" : "93.79") + " mm/s at most\n");
  const std::vector<double> figures = tilts() ? std::vector{114.6, 125.0} : std::vector{85.94, 93.79};
  for (std::uint32_t i = 0; i < 2; ++i) {
    std::vector<double> found = speeds(job, 6 + i);
    ASSERT_FALSE(found.empty());
    std::sort(found.begin(), found.end());
    const double usual = found[found.size() * 3 / 4];
    EXPECT_LT(usual, 1.001 * figures[i]);
    EXPECT_GT(usual, 0.97 * figures[i]);  // axes keep a margin to their full speed
  }
}

INSTANTIATE_TEST_SUITE_P(Of_tables, Turning_speed, testing::Values("turntable", "tilt_table"));

}  // namespace
}  // namespace indurop::robot
