// SPDX-License-Identifier: Apache-2.0
// The box that the tool's point does not leave: points, paths and axes that are moved by hand.

#include "control/robot/kinematics/workspace.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "group_cell.h"

namespace indurop::robot {
namespace {

Settings with_box(std::vector<double> corners) {
  Settings settings;
  settings.workspace = std::move(corners);
  return settings;
}

const std::vector<double> kBox{300, -400, 100, 700, 400, 700};
const char* const kStart = "POINT START = POSE 500 0 400 RPY 180 0 180\n";

std::string wrong_with(const std::string& job, const Settings& settings) {
  try {
    controller_of(cell_urdf(), job, settings);
  } catch (const std::exception& wrong) {
    return wrong.what();
  }
  return "";
}

// At START, by the job that is number 1.
class In_a_box : public testing::Test {
 protected:
  std::unique_ptr<Cell> cell;
  Workspace box = Workspace::of(kBox);

  void begin(const std::string& job, double period_ms = 4) {
    cell = std::make_unique<Cell>(std::string(kStart) + job, period_ms, 0, true, with_box(kBox), cell_urdf());
    // Where the drives are when the program starts.
    const Arm arm = cell_arm();
    const auto found = Inverse(arm).nearest({Vec3(0.5, 0, 0.4), from_rpy({kPi, 0, kPi})}, Joints::Zero());
    for (std::size_t i = 0; i < kJoints; ++i) {
      cell->in.drives[i].position =
          static_cast<std::int32_t>(found.solution.q[static_cast<Eigen::Index>(i)] / (2 * kPi) * 1'320'000);
    }
    ASSERT_TRUE(cell->serve(Service::GroupEnable));
  }
  [[nodiscard]] double outside() const {
    return box.outside(Vec3(cell->out.position[0], cell->out.position[1], cell->out.position[2]) / 1000);
  }
  // The end of the job; how far outside it was at most.
  double run_job() {
    cell->in.service.job = 1;
    cell->ask(Service::JobStart);
    double most = -1;
    EXPECT_TRUE(cell->until([&] {
      most = std::max(most, outside());
      return cell->out.done == cell->in.service.number && cell->out.state != GroupState::Stopping;
    }));
    return most;
  }
};

TEST(Workspace, Says_how_far_outside_a_point_is) {
  const Workspace sut = Workspace::of({100, 200, 300, -100, -200, -300});
  EXPECT_DOUBLE_EQ(sut.outside({0, 0, 0}), -0.1);
  EXPECT_DOUBLE_EQ(sut.outside({0.15, 0, 0}), 0.05);
  EXPECT_TRUE(sut.left({0, 0, 0}, {0.101, 0, 0}));
  EXPECT_TRUE(sut.left({0.15, 0, 0}, {0.16, 0, 0}));
  EXPECT_FALSE(sut.left({0.15, 0, 0}, {0.14, 0, 0}));
  EXPECT_FALSE(Workspace().left({0, 0, 0}, {1e9, 0, 0}));
}

TEST(Workspace, That_is_no_box_is_an_error) {
  for (const std::vector<double>& corners :
       {std::vector<double>{1, 2, 3}, {0, 0, 0, 1, 1, 0}, {0, 0, 0, 1, 1, std::nan("")}}) {
    EXPECT_NE(wrong_with("", with_box(corners)).find("property workspace: error: it has to be two opposite corners"),
              std::string::npos)
        << wrong_with("", with_box(corners));
  }
}

TEST(Workspace, Points_outside_are_errors_of_their_file) {
  EXPECT_NE(
      wrong_with("POINT A = POSE 800 0 400 RPY 180 0 180\n", with_box(kBox))
          .find("main.job:1:7: error: point 'A': the tool is at 800   0 400 mm, outside of the workspace (x 300 to "
                "700, y -400 to 400, z 100 to 700 mm)"),
      std::string::npos)
      << wrong_with("POINT A = POSE 800 0 400 RPY 180 0 180\n", with_box(kBox));
  EXPECT_NE(wrong_with("POINT A = JOINT 90 0 0 0 0 0\n", with_box(kBox)).find("outside of the workspace"),
            std::string::npos);
}

// Where the frame is is not known while something else is wrong.
TEST(Workspace, Points_in_frames_are_not_blamed_for_another_mistake) {
  const std::string job = "FRAME f = POSE 500 0 300 RPY 0 0 0\nPOINT A = POSE 0 0 100 RPY 180 0 180 IN f\n";
  EXPECT_EQ(wrong_with(job, with_box(kBox)), "");
  const std::string wrong = wrong_with(job + "POINT B = JOINT 999 0 0 0 0 0\nSPEED 0%\n", with_box(kBox));
  EXPECT_NE(wrong.find("a speed is above 0"), std::string::npos) << wrong;
  EXPECT_EQ(wrong.find("'A'"), std::string::npos) << wrong;
}

// Its points are inside, but not what is between them.
TEST_F(In_a_box, A_way_that_leaves_it_is_refused_before_it_begins) {
  for (const char* way : {"POINT M = POSE 698 100 400 RPY 180 0 180\nPOINT E = POSE 500 300 400 RPY 180 0 180\nMOVJ "
                          "START\nMOVC M E\n",
                          "POINT A = POSE 380 -390 400 RPY 180 0 180\nPOINT B = POSE 699 -200 400 RPY 180 0 180\nPOINT "
                          "C = POSE 600 390 400 RPY 180 0 180\nMOVL START\nMOVL A\nMOVS B C\n",
                          "POINT A = POSE 585 -390 400 RPY 180 0 180\nPOINT B = POSE 585 390 400 RPY 180 0 180\nMOVL "
                          "A\nMOVJ B\n"}) {
    begin(way);
    EXPECT_LE(run_job(), 0) << way;
    EXPECT_EQ(cell->out.error, ErrorCode::Workspace) << way << to_string(cell->out.error);
  }
}

TEST_F(In_a_box, Ways_along_its_sides_are_possible) {
  begin(
      "POINT A = POSE 700 -400 100 RPY 180 0 180\nPOINT B = POSE 700 400 100 RPY 180 0 180\nPOINT C = POSE 300 400 100 "
      "RPY 180 0 180\nMOVL A\nMOVL B\nMOVL C\n");
  EXPECT_LE(run_job(), 1e-9);
  EXPECT_EQ(cell->out.error, ErrorCode::Ok) << to_string(cell->out.error) << cell->out.job.message;
}

TEST_F(In_a_box, Axes_that_are_moved_by_hand_stop_inside) {
  std::mt19937 random{3};
  for (int i = 0; i < 90; ++i) {
    begin("", i % 3 == 0 ? 1 : i % 3 == 1 ? 4 : 10);
    const auto in = [&](double low, double high) { return std::uniform_real_distribution<double>(low, high)(random); };
    for (std::size_t axis = 0; axis < 3; ++axis) {
      cell->ask_axis(axis, AxisService::MoveVelocity, 0, (in(0, 1) < 0.5 ? -1 : 1) * in(5, 200));
    }
    double most = -1;
    ASSERT_TRUE(cell->until(
        [&] {
          most = std::max(most, outside());
          return cell->out.state == GroupState::ErrorStop;
        },
        20000));
    EXPECT_EQ(cell->out.error, ErrorCode::Workspace) << to_string(cell->out.error);
    EXPECT_LE(most, 1e-6) << i;
    // And back: what leads inside is possible.
    ASSERT_TRUE(cell->serve(Service::GroupReset));
    cell->in.service.target = {500, 0, 400, 180, 0, 180};
    EXPECT_TRUE(cell->serve(Service::LinearAbsolute)) << to_string(cell->out.error);
  }
}

TEST_F(In_a_box, A_target_outside_is_refused_and_a_new_one_in_mid_move_changes_nothing) {
  begin("");
  cell->in.service.target = {900, 0, 400, 180, 0, 180};
  EXPECT_FALSE(cell->serve(Service::LinearAbsolute));
  EXPECT_EQ(cell->out.error, ErrorCode::Workspace);
  EXPECT_EQ(cell->out.state, GroupState::Standby);
  AxisNumbers target = cell->out.command;
  target[0] = 20;
  cell->in.service.target = target;
  cell->ask(Service::DirectAbsolute);
  ASSERT_TRUE(cell->until([&] { return cell->out.command[0] > 5; }));
  target[0] = 90;
  cell->in.service.target = target;
  EXPECT_FALSE(cell->serve(Service::DirectAborting));
  EXPECT_EQ(cell->out.error, ErrorCode::Workspace);
  ASSERT_TRUE(cell->until([&] { return cell->out.state == GroupState::Standby; }));
  EXPECT_NEAR(cell->out.command[0], 20, 1e-6);
}

}  // namespace
}  // namespace indurop::robot
