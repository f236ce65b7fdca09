// SPDX-License-Identifier: Apache-2.0
// The way back after an interrupt that turned the table, or after the robot was moved away: a straight line on the
// workpiece, as slow as it has to be, and the same path from there on. Where the tool is on the workpiece is computed
// from the arm in the world and the axes of the table by hand. INDUROP_ROBOT_RETURNS says how many.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <random>
#include <vector>

#include "limit_judge.h"

namespace indurop::robot {
namespace {

class Workpiece_return : public testing::TestWithParam<const char*> {
 protected:
  Workpiece_return() : urdf(urdf_of(GetParam())), arm(arm_of(GetParam()).in_world()) {}

  double in(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random); }
  [[nodiscard]] bool tilts() const { return GetParam() == std::string("tilt_table"); }
  [[nodiscard]] int turn() const { return tilts() ? 7 : 6; }
  [[nodiscard]] Joints joints() const {
    Joints q = Joints::Zero();
    for (int i = 0; i < kAxes; ++i) {
      q[i] = cell->out.command[static_cast<std::size_t>(i)] * kPi / 180;
    }
    return q;
  }
  // As their files describe the tables, seen from the workpiece while they are at zero.
  [[nodiscard]] Vec3 on_workpiece(const Joints& q) const {
    const Vec3 tip = arm.forward(q).position;
    const Vec3 tilt(0, 0, -0.1);
    const Vec3 upright = tilts() ? Vec3(Eigen::AngleAxisd(-q[6], Vec3::UnitY()) * (tip - tilt) + tilt) : tip;
    return Eigen::AngleAxisd(-q[turn()], Vec3::UnitZ()) * upright;
  }
  void begin(const std::string& job, const std::string& serve) {
    cell = std::make_unique<Cell>(job, 4, 0, true, Settings{}, urdf, JobTexts{{"serve", serve}});
    judge = std::make_unique<Judge>(0.004, urdf);
    ASSERT_TRUE(cell->serve(Service::GroupEnable));
    for (int i = 0; i < 4; ++i) {
      cell->step();
      static_cast<void>(judge->look(*cell, 1));
    }
    cell->in.service.job = 1;
    cell->ask(Service::JobStart);
  }
  double& signal(const std::string& name) {
    const auto& names = cell->sut->signals();
    return cell->values[std::find(names.begin(), names.end(), name) - names.begin()];
  }
  void step() {
    cell->step();
    broken += judge->look(*cell, 1);
  }
  template <class Condition>
  [[nodiscard]] bool until(const Condition& condition, int most = 20000) {
    for (int i = 0; i < most && !condition() && broken.empty(); ++i) {
      step();
    }
    return condition();
  }
  [[nodiscard]] bool over() const {
    return cell->out.job.state == JobState::Ended || cell->out.job.state == JobState::Failed;
  }
  std::string point(const char* name) {
    return fmt::format("POINT {} = POSE {:.3f} {:.3f} {:.3f} RPY 180 {:.3f} {:.3f}{} AXIS {} 0\n", name, in(-120, 120),
                       in(-120, 120), in(120, 200), in(-15, 15), in(-30, 30),
                       tilts() ? fmt::format(" AXIS 7 {:.3f}", in(-8, 8)) : "", turn() + 1);
  }
  // The set points of the way back after an interrupt in the middle of a line, which lifts the tool and turns the
  // table; empty: there is none.
  std::vector<Joints> way_back() {
    constexpr std::uint32_t kLine = 5;
    const std::string axis = fmt::format("AXIS {} ", turn() + 1);
    const std::string serve =
        fmt::format("MOVL BACK OFFSET {:.2f}, {:.2f}, {:.2f}\n", in(-40, 40), in(-40, 40), in(20, 60)) + "MOVL HERE " +
        axis + fmt::format("{:.3f}\nSET served = 1\n", in(-30, 30));
    begin(point("A") + point("B") + "ON I1 CALL serve\nMOVJ A\nMOVL B " + axis +
              fmt::format("{:.3f} SPEED 60 mm/s\n", in(-20, 20)),
          serve);
    const double wanted = in(0.01, 0.06);
    Vec3 from = Vec3::Zero();
    const bool on_line = until([&] {
      from = cell->out.job.line == kLine ? from : on_workpiece(joints());
      return over() || (on_workpiece(joints()) - from).norm() > wanted;
    });
    if (!on_line || over()) {
      return {};
    }
    signal("I1") = 1;
    EXPECT_TRUE(until([&] { return over() || signal("served") > 0; }));
    std::vector<Joints> way;
    EXPECT_TRUE(until([&] {
      way.push_back(joints());
      return over() || cell->out.job.line == kLine;
    }));
    return cell->out.job.state == JobState::Failed ? std::vector<Joints>{} : way;
  }
  // m by which places are away from the line between the first and the last.
  static double bend(const std::vector<Vec3>& places) {
    const Vec3 from = places.front();
    const Vec3 way = places.back() - from;
    double most = 0;
    for (const Vec3& place : places) {
      const double part = std::clamp((place - from).dot(way) / way.squaredNorm(), 0.0, 1.0);
      most = std::max(most, (place - from - part * way).norm());
    }
    return most;
  }

  std::mt19937 random;
  const std::string urdf;
  const Arm arm;
  std::unique_ptr<Cell> cell;
  std::unique_ptr<Judge> judge;
  std::string broken;
};

TEST_P(Workpiece_return, Is_a_line_on_the_workpiece) {
  int returns = 0;
  double most = 0;
  double fastest = 0;
  double in_joint_space = 0;
  const int first = number_of("INDUROP_ROBOT_SEED", 1);
  for (int seed = first; seed < first + number_of("INDUROP_ROBOT_RETURNS", 12); ++seed) {
    SCOPED_TRACE(seed);
    random.seed(static_cast<unsigned>(seed));
    broken.clear();
    const std::vector<Joints> way = way_back();
    ASSERT_FALSE(HasFatalFailure());
    if (way.empty()) {
      continue;  // out of reach, too short, or too far away in the end
    }
    ASSERT_TRUE(until([&] { return over(); }));
    ASSERT_EQ(broken, "");
    ASSERT_EQ(cell->out.job.state, JobState::Ended) << cell->out.job.message;
    std::vector<Vec3> places;
    std::vector<Vec3> other;
    for (std::size_t i = 0; i < way.size(); ++i) {
      places.push_back(on_workpiece(way[i]));
      const double part = static_cast<double>(i) / static_cast<double>(way.size() - 1);
      other.push_back(on_workpiece(way.front() + part * (way.back() - way.front())));
      fastest = std::max(fastest, i == 0 ? 0 : (places[i] - places[i - 1]).norm() / 0.004);
    }
    ++returns;
    most = std::max(most, bend(places));
    in_joint_space = std::max(in_joint_space, bend(other));
  }
  fmt::print("{} ways back, at most {:.1e} mm off a line on the workpiece ({:.1f} mm in joint space), {:.1f} mm/s\n",
             returns, 1000 * most, 1000 * in_joint_space, 1000 * fastest);
  EXPECT_GT(returns, 0);
  EXPECT_LT(most, 1e-7);
  EXPECT_LT(fastest, 0.101);
}

INSTANTIATE_TEST_SUITE_P(Of_tables, Workpiece_return, testing::Values("turntable", "tilt_table"));

}  // namespace
}  // namespace indurop::robot
