// SPDX-License-Identifier: Apache-2.0
// Jobs of arms that are not made of six turning axes.
#include <gtest/gtest.h>

#include <stdexcept>
#include <tuple>

#include "group_cell.h"

namespace indurop::robot {
namespace {

std::unique_ptr<Cell> run(const std::string& arm, const std::string& job) {
  auto cell = std::make_unique<Cell>(job, 4, 0, true, Settings{}, urdf_of(arm));
  EXPECT_TRUE(cell->serve(Service::GroupEnable));
  cell->in.service.job = 1;
  cell->ask(Service::JobStart);
  const auto ended = [&] { return cell->out.job.state == JobState::Ended || cell->out.job.state == JobState::Failed; };
  EXPECT_TRUE(cell->until(ended, 20000));
  EXPECT_EQ(cell->out.job.state, JobState::Ended) << cell->out.job.message;
  return cell;
}

std::string error_of(const std::string& arm, const std::string& job) {
  try {
    Cell cell(job, 4, 0, true, Settings{}, urdf_of(arm));
  } catch (const std::runtime_error& error) {
    const std::string text = error.what();
    return text.substr(text.find("main.job"));
  }
  return "";
}

void expect_at(const Cell& cell, const Vec3& place) {
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(cell.out.position[i], place[static_cast<Eigen::Index>(i)], 1e-3);
  }
}

TEST(ArmJobs, A_SCARA_moves_its_quill_in_mm) {
  const auto cell =
      run("scara", "POINT A = JOINT 30 40 100 0\nPOINT B = POSE 400 200 250 RPY 180 0 30\nMOVJ A\nMOVL B\n");
  expect_at(*cell, {400, 200, 250});
  EXPECT_NEAR(cell->out.command[2], 87, 1e-6);
  EXPECT_NEAR(cell->in.drives[2].position, 87000, 1);
}

TEST(ArmJobs, A_gantry_a_palletiser_and_a_delta) {
  expect_at(*run("gantry", "POINT A = POSE 1500 300 900 RPY 180 0 45\nMOVJ A\n"), {1500, 300, 900});
  const std::string lines =
      "POINT A = POSE 1600 200 400 RPY 180 0 20\nPOINT B = POSE 1600 -300 700 RPY 180 0 -10\nMOVJ A\nMOVL B\n";
  expect_at(*run("palletiser", lines), {1600, -300, 700});
  expect_at(*run("delta",
                 "POINT A = POSE 100 100 -850 RPY 180 0 0\nPOINT B = POSE -150 50 -800 RPY 180 0 40\nMOVJ A\nMOVL B\n"),
            {-150, 50, -800});
}

TEST(ArmJobs, Seven_axes_stand_where_a_point_says) {
  const std::string at = " = POSE 500 100 600 RPY 180 0 180 AXIS 3 ";
  const auto cell = run("iiwa14", "POINT A" + at + "20\nPOINT B = POSE 500 -100 600 RPY 180 0 180\nMOVJ A\nMOVL B\n");
  expect_at(*cell, {500, -100, 600});
  EXPECT_NEAR(cell->out.command[2], 20, 1e-6) << "a line holds it";
}

TEST(ArmJobs, Seven_axes_end_a_line_where_it_says) {
  const std::string at = " = POSE 500 100 600 RPY 180 0 180 AXIS 3 ";
  const std::string points = "POINT A" + at + "20\nPOINT B = POSE 500 -100 600 RPY 180 0 180\nMOVJ A\n";
  auto cell = run("iiwa14", points + "MOVL B AXIS 3 35\n");
  expect_at(*cell, {500, -100, 600});
  EXPECT_NEAR(cell->out.command[2], 35, 1e-6);
  cell = run("iiwa14", points + "VAR n = 5\nMOVL B ZONE 20 mm AXIS 3 2 * n SPEED 50%\nMOVL A\n");
  expect_at(*cell, {500, 100, 600});
  EXPECT_NEAR(cell->out.command[2], 20, 1e-6) << "the point says it";
  cell = run("iiwa14", points + "MOVL HERE AXIS 3 -10\n");
  expect_at(*cell, {500, 100, 600});
  EXPECT_NEAR(cell->out.command[2], -10, 1e-6) << "only the elbow moves";
  cell =
      run("rail", "POINT A = POSE 2500 400 500 RPY 180 0 0 AXIS 1 1800\nMOVJ A\nMOVL HERE OFFSET 50, 0, 0 AXIS 1 2000");
  expect_at(*cell, {2550, 400, 500});
  EXPECT_NEAR(cell->out.command[0], 2000, 1e-6);
}

// Arms without a closed form have to search how they are held there.
TEST(ArmJobs, Joint_motions_go_to_a_place_relative_to_a_point) {
  for (const auto& [arm, point, place] : {std::tuple{"scara", "400 200 250 RPY 180 0 30", Vec3(400, 200, 250)},
                                          {"offset_wrist", "350 100 300 RPY 180 0 0", Vec3(350, 100, 300)},
                                          {"iiwa14", "500 100 600 RPY 180 0 180", Vec3(500, 100, 600)},
                                          {"palletiser", "1600 200 400 RPY 180 0 20", Vec3(1600, 200, 400)},
                                          {"gantry", "1500 300 900 RPY 180 0 45", Vec3(1500, 300, 900)}}) {
    const auto cell = run(arm, std::string("POINT A = POSE ") + point + "\nMOVJ A OFFSET -30, 20, 40\n");
    expect_at(*cell, place + Vec3(-30, 20, 40));
  }
}

TEST(ArmJobs, A_joint_motion_relative_to_a_point_may_be_out_of_reach) {
  Cell cell("POINT A = POSE 400 200 250 RPY 180 0 30\nMOVJ A\nMOVJ A OFFSET 900, 0, 0\n", 4, 0, true, Settings{},
            urdf_of("scara"));
  ASSERT_TRUE(cell.serve(Service::GroupEnable));
  cell.in.service.job = 1;
  cell.ask(Service::JobStart);
  ASSERT_TRUE(cell.until([&] { return cell.out.job.state == JobState::Failed; }, 20000));
  EXPECT_EQ(cell.out.error, ErrorCode::Unreachable);
  EXPECT_EQ(cell.out.job.line, 3U);
}

TEST(ArmJobs, A_rail_is_the_axis_that_a_pose_leaves_open) {
  const auto cell = run("rail", "POINT A = POSE 2500 400 500 RPY 180 0 0 AXIS 1 1800\nMOVJ A\n");
  expect_at(*cell, {2500, 400, 500});
  EXPECT_NEAR(cell->out.command[0], 1800, 1e-6);
}

TEST(ArmJobs, What_an_arm_cannot_do_is_said_with_the_line) {
  EXPECT_NE(error_of("scara", "POINT A = JOINT 30 40 100 0 0 0\n").find("main.job:1:29: error: unexpected '0'"),
            std::string::npos);
  EXPECT_NE(
      error_of("scara", "\nPOINT A = POSE 400 200 250 RPY 170 0 30\n")
          .find("main.job:2:7: error: point 'A': an arm of 4 axes cannot hold its tool like that there; the nearest is "
                "RPY "),
      std::string::npos);
  EXPECT_EQ(error_of("scara", "POINT A = POSE 400 200 250 RPY 180 0 30 POSTURE 2\n"),
            "main.job:1:7: error: point 'A': this arm has no postures; leave POSTURE out, or use JOINT");
  EXPECT_EQ(error_of("iiwa14", "POINT A = POSE 500 100 600 RPY 180 0 180 AXIS 2 20\n"),
            "main.job:1:42: error: point 'A': AXIS 2 follows from the pose; leave it out, or use JOINT");
  const std::string b = "POINT B = POSE 500 -100 600 RPY 180 0 180\n";
  EXPECT_EQ(error_of("iiwa14", b + "MOVL B AXIS 2 20\n"),
            "main.job:2:8: error: AXIS 2 follows from the pose; leave it out, or use JOINT");
  EXPECT_EQ(error_of("iiwa14", b + "MOVL B AXIS 3 200\n"),
            "main.job:2:8: error: AXIS 3 is at 200 degrees, its limits are -170 to 170");
  EXPECT_EQ(error_of("iiwa14", b + "MOVL B AXIS 8 20\n"), "main.job:2:13: error: axes have the numbers 1 to 7");
  EXPECT_EQ(
      error_of("iiwa14", b + "MOVE FREE TO B AXIS 3 20\n"),
      "main.job:2:16: error: AXIS comes after the points of a MOVJ, MOVL, MOVC or SEARCH; for others, it is part of a "
      "POINT");
}

}  // namespace
}  // namespace indurop::robot
