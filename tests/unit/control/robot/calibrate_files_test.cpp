// SPDX-License-Identifier: Apache-2.0
// Calibrations in the files of a robot: points are collected, dropped and accepted, and the earlier declaration is
// kept.
#include "control/robot/files/calibrate.h"

#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "control/robot/kinematics/inverse.h"
#include "robot_fixture.h"

namespace indurop::robot {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;
using testing::StartsWith;

class Calibrate_files : public testing::Test {
 protected:
  Calibrate_files() {
    std::filesystem::create_directories(folder);
    write("arm.urdf", cell_urdf());
    write("points.job",
          "# the cell\nTOOL pen = POSE 0 0 120 RPY 0 30 0 MASS 1.2 kg CENTRE 0 0 60   # a pen\n"
          "POINT HOME = JOINT 0 -20 10 0 100 0\n");
    names = {folder / "arm.urdf", {folder / "points.job"}, {}};
  }
  ~Calibrate_files() override { std::filesystem::remove_all(folder); }
  void write(const std::string& name, const std::string& text) const { std::ofstream(folder / name) << text; }
  [[nodiscard]] std::string text_of(const std::string& name) const {
    std::ifstream file(folder / name);
    return {std::istreambuf_iterator<char>(file), {}};
  }
  // Positions in which the tip of a tool is at one place.
  static std::vector<Stand> touching(const Pose& tool) {
    const Arm arm = cell_arm().with_tool(tool);
    const Inverse inverse(arm);
    Joints from = joints_of({0, 0, 0.3, 0, 1.2, 0});
    const Pose first = arm.forward(from);
    std::vector<Stand> stands;
    for (const Vec3& turn : {Vec3(0, 0, 0), Vec3(0.4, 0, 0), Vec3(0, 0.4, 0), Vec3(-0.3, -0.3, 0.5)}) {
      const auto found = inverse.nearest({first.position, first.orientation * rotation_by(turn)}, from);
      EXPECT_EQ(found.reach, Reach::Ok);
      Stand stand;
      for (int i = 0; i < arm.count(); ++i) {
        stand.joints.push_back(degrees(found.solution.q[i]));
      }
      stands.push_back(stand);
    }
    return stands;
  }
  std::filesystem::path folder =
      std::filesystem::path(testing::TempDir()) /
      (std::string("calibrate_") + testing::UnitTest::GetInstance()->current_test_info()->name());
  FileNames names;
  CalibrationOrder pen{CalibrationKind::Tool, "pen", {}, {}};
};

TEST_F(Calibrate_files, A_tool_is_found_and_what_was_before_is_kept) {
  Calibration now = show_calibration(names, pen);
  EXPECT_THAT(now.problem, IsEmpty());
  EXPECT_EQ(now.next_mark, "TIP");
  EXPECT_THAT(now.next, HasSubstr("point 1 of 4"));
  for (const Stand& stand : touching({{0.01, -0.02, 0.15}, Quat::Identity()})) {
    EXPECT_THAT(accept_calibration(names, pen).problem, HasSubstr("a tool needs 4 points"));
    now = take_point(names, pen, {}, stand);
    EXPECT_THAT(now.problem, IsEmpty());
  }
  EXPECT_THAT(now.wrong, IsEmpty());
  EXPECT_EQ(now.points.size(), 4U);
  EXPECT_LT(now.rms, 1e-4);
  EXPECT_EQ(now.declaration, "TOOL pen = POSE 10 -20 150 RPY 0 30 0 MASS 1.2 kg CENTRE 0 0 60");
  EXPECT_EQ(now.before, "TOOL pen = POSE 0 0 120 RPY 0 30 0 MASS 1.2 kg CENTRE 0 0 60");
  EXPECT_THAT(text_of("points.job"), HasSubstr("\nTOOL pen = POSE 0 0 120")) << "not before it is accepted";
  EXPECT_THAT(text_of("pen.tool.points"), StartsWith("TIP JOINT "));

  now = accept_calibration(names, pen);
  EXPECT_THAT(now.problem, IsEmpty());
  EXPECT_EQ(now.line, 3);
  const std::string text = text_of("points.job");
  EXPECT_THAT(text, StartsWith("# the cell\n# until 20"));
  EXPECT_THAT(text, HasSubstr(" UTC: TOOL pen = POSE 0 0 120 RPY 0 30 0 MASS 1.2 kg CENTRE 0 0 60\n"
                              "TOOL pen = POSE 10 -20 150 RPY 0 30 0 MASS 1.2 kg CENTRE 0 0 60   # a pen\nPOINT HOME"));
  EXPECT_TRUE(std::filesystem::exists(folder / "pen.tool.points.accepted"));
  EXPECT_THAT(show_calibration(names, pen).points, IsEmpty());
}

TEST_F(Calibrate_files, Points_are_dropped_and_wrong_ones_are_named) {
  const std::vector<Stand> stands = touching({{0, 0, 0.15}, Quat::Identity()});
  for (std::size_t i = 0; i < stands.size(); ++i) {
    Stand stand = stands[i];
    stand.joints[1] += i == 2 ? 4 : 0;
    ASSERT_THAT(take_point(names, pen, {"tip", {}, {}}, stand).problem, IsEmpty());
  }
  EXPECT_THAT(show_calibration(names, pen).wrong, HasSubstr("do not agree"));
  EXPECT_THAT(drop_point(names, pen, 7).problem, HasSubstr("there is no point 7, but 4"));
  EXPECT_EQ(drop_point(names, pen, 3).points.size(), 3U);
  EXPECT_THAT(take_point(names, pen, {}, stands[2]).wrong, IsEmpty());
  EXPECT_THAT(drop_point(names, pen, 0).points, IsEmpty());
}

TEST_F(Calibrate_files, Frames_and_cameras_are_touched_with_a_tool) {
  const CalibrationOrder frame{CalibrationKind::Frame, "bench", folder / "bench.txt", {}};
  write("bench.txt",
        "# touched\nORIGIN POSE 500 0 100 RPY 180 0 0\nX POSE 600 100 100 RPY 180 0 0  # far away\n"
        "XY POSE 400 100 100 RPY 180 0 0\n");
  Calibration now = accept_calibration(names, frame);
  EXPECT_THAT(now.problem, IsEmpty());
  EXPECT_EQ(now.declaration, "FRAME bench = POSE 500 0 100 RPY 0 0 45");
  EXPECT_EQ(now.spare, 0);
  EXPECT_THAT(text_of("points.job"), HasSubstr("100 0\nFRAME bench = POSE 500 0 100 RPY 0 0 45\n"));
  EXPECT_TRUE(std::filesystem::exists(folder / "bench.txt")) << "a file of the user";

  const CalibrationOrder camera{CalibrationKind::Camera, "eye", folder / "eye.txt", {}};
  write("eye.txt",
        "SEEN 0 0 AT POSE 500 0 100 RPY 0 0 0\nSEEN 100 0 AT POSE 500 100 100 RPY 0 0 0\n"
        "SEEN 0, 100, 0 AT POSE 400 0 100 RPY 0 0 0\nSEEN 100 100 AT POSE 400 100 100 RPY 0 0 0\n");
  now = show_calibration(names, camera);
  EXPECT_EQ(now.declaration, "FRAME eye = POSE 500 0 100 RPY 0 0 90");
  Stand stand;
  stand.joints = {0, 0, 0, 0, 90, 0};
  now = take_point(names, camera, {"", {50, 50}, "pen"}, stand);
  EXPECT_THAT(text_of("eye.txt"), HasSubstr("SEEN 50 50 0 AT JOINT 0 0 0 0 90 0 TOOL pen\n"));
  EXPECT_THAT(now.wrong, HasSubstr("point 5 is"));
  EXPECT_THAT(take_point(names, camera, {"", {50}, "pen"}, stand).problem, HasSubstr("x y or x y z"));
}

TEST_F(Calibrate_files, Mistakes_are_named_with_their_place_and_change_nothing) {
  write("pen.tool.points", "TIP JOINT 0 0 0 0 90\nTOP JOINT 0 0 0 0 90 0\n\nX POSE 0 0 0 RPY 0 0 0 TOOL pen\n");
  const Calibration now = accept_calibration(names, pen);
  ASSERT_EQ(now.errors.size(), 3U);
  EXPECT_THAT(now.errors[0].text, HasSubstr("expected 6 numbers"));
  EXPECT_THAT(now.errors[1].text, HasSubstr("expected TIP, X or XZ, found 'TOP'"));
  EXPECT_EQ(now.errors[1].place.line, 2);
  EXPECT_THAT(now.errors[2].text, HasSubstr("unexpected 'TOOL'"));
  EXPECT_THAT(show_calibration(names, {CalibrationKind::Tool, "../pen", {}, {}}).problem, HasSubstr("is no name"));
  EXPECT_THAT(show_calibration(names, {CalibrationKind::Tool, "pen", folder / "none", {}}).problem,
              HasSubstr("there is no such file"));
  EXPECT_THAT(text_of("points.job"), StartsWith("# the cell\nTOOL pen = POSE 0 0 120"));
}

}  // namespace
}  // namespace indurop::robot
