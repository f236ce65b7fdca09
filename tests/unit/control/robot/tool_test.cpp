// SPDX-License-Identifier: Apache-2.0
// Tools: where their tips are, how they are taught, and that motions and limits are those of the tip. The yardstick are
// homogeneous transformations of the arm's end, whose kinematics other tests compare with orocos-kdl.
#include "control/robot/kinematics/tool_set.h"

#include <gmock/gmock.h>

#include <iomanip>
#include <random>
#include <sstream>

#include "control/robot/job/job.h"
#include "control/robot/kinematics/tip_fit.h"
#include "group_cell.h"

namespace indurop::robot {
namespace {

using testing::HasSubstr;
using Transform = Eigen::Isometry3d;

Transform transform(const Pose& pose) {
  Transform t = Transform::Identity();
  t.translate(pose.position);
  t.rotate(pose.orientation);
  return t;
}

Transform transform(double x, double y, double z, double roll, double pitch, double yaw) {
  Transform t = Transform::Identity();
  t.translate(Vec3(x, y, z) / 1000);
  t.rotate(Eigen::AngleAxisd(radians(yaw), Vec3::UnitZ()) * Eigen::AngleAxisd(radians(pitch), Vec3::UnitY()) *
           Eigen::AngleAxisd(radians(roll), Vec3::UnitX()));
  return t;
}

Pose pose(const Transform& t) {
  return {t.translation(), Quat(t.linear())};
}

double apart(const Transform& a, const Transform& b) {
  return (a.matrix() - b.matrix()).norm();
}

// Of the arm's end, from the commands to the drives.
Transform end_of(const Cell& cell) {
  Joints q = Joints::Zero();
  for (int i = 0; i < 6; ++i) {
    q[i] = radians(cell.out.command[static_cast<std::size_t>(i)]);
  }
  return transform(cell_arm().forward(q));
}

TEST(Tool, The_tip_is_where_the_transformations_say_on_every_arm) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> some(-0.2, 0.2);
  for (const char* name : {"scara", "palletiser", "delta"}) {
    const Arm arm = arm_of(name);
    for (int i = 0; i < 200; ++i) {
      const Pose tip{{some(random), some(random), some(random)}, rotation_by({some(random), some(random), 1})};
      const Arm sut = arm.with_tool(tip);
      const Joints q = anywhere(arm, random);
      if (!arm.forward(q).position.allFinite()) {
        continue;
      }
      EXPECT_LT(apart(transform(sut.forward(q)), transform(arm.forward(q)) * transform(tip)), 1e-12) << name;
      const Jacobian j = sut.jacobian(q);
      for (int k = 0; k < arm.count(); ++k) {
        constexpr double kStep = 1e-6;
        Joints a = q;
        Joints b = q;
        a[k] -= kStep;
        b[k] += kStep;
        const Twist wanted = difference(sut.forward(a), sut.forward(b)) / (2 * kStep);
        EXPECT_LT((j.col(k) - wanted).norm(), 1e-6) << name << " axis " << k + 1;
      }
    }
  }
}

TEST(Tool, Joint_values_of_a_pose_bring_the_tip_there) {
  std::mt19937 random(2);
  const Pose tip = pose(transform(30, -20, 150, 10, -25, 40));
  const ToolSet sut(cell_arm(), {{}, tip});
  for (int i = 0; i < 500; ++i) {
    const Joints q = anywhere(cell_arm(), random);
    const Transform wanted = transform(cell_arm().forward(q)) * transform(tip);
    const auto found = sut.inverse(1).nearest(pose(wanted), q);
    ASSERT_EQ(found.reach, Reach::Ok);
    EXPECT_LT(apart(transform(cell_arm().forward(found.solution.q)) * transform(tip), wanted), 1e-9);
  }
}

constexpr const char* kTools =
    "TOOL pen = POSE 0 0 120 RPY 0 30 0\nTOOL long = POSE 0 0 260 RPY 0 0 0\n"
    "POINT A = POSE 450 -100 300 RPY 180 0 180\nPOINT B = POSE 450 150 350 RPY 180 0 180\n";

TEST(Tool, Lines_are_those_of_the_tip_and_each_tool_comes_to_the_same_points) {
  Cell cell(std::string(kTools) + "TOOL pen\nMOVJ A\nMOVL B\nTOOL long\nMOVJ A\nMOVL B\nTOOL FLANGE\nMOVL A\n");
  ASSERT_TRUE(cell.serve(Service::GroupEnable));
  const Transform tips[] = {Transform::Identity(), transform(0, 0, 120, 0, 30, 0), transform(0, 0, 260, 0, 0, 0)};
  const Transform a = transform(450, -100, 300, 180, 0, 180);
  const Transform b = transform(450, 150, 350, 180, 0, 180);
  cell.in.service.job = 1;
  cell.ask(Service::JobStart);
  int arrived = 0;
  double off = 0;
  const Vec3 way = (b.translation() - a.translation()).normalized();
  const bool ended = cell.until([&] {
    const Transform tip = end_of(cell) * tips[cell.out.tool];
    arrived += cell.out.tool > 0 && apart(tip, b) < 1e-6 ? 1 : 0;
    if (cell.out.path_speed > 0 && cell.out.job.line % 3 == 1) {  // lines 10 and 13 are the MOVLs
      off = std::max(off, (tip.translation() - a.translation()).cross(way).norm());
    }
    EXPECT_LT(
        (1000 * tip.translation() - Vec3(cell.out.position[0], cell.out.position[1], cell.out.position[2])).norm(),
        1e-6);
    return cell.out.done == cell.in.service.number;
  });
  ASSERT_TRUE(ended && cell.out.error == ErrorCode::Ok) << cell.out.job.message;
  EXPECT_LT(apart(end_of(cell), a), 1e-6);
  EXPECT_GE(arrived, 2);
  EXPECT_LT(off, 1e-6);
  EXPECT_STREQ(cell.out.tool_name, "FLANGE");
}

TEST(Tool, The_tool_of_a_service_is_that_which_was_selected_and_none_is_taken_in_motion) {
  Cell cell(kTools);
  ASSERT_TRUE(cell.serve(Service::GroupEnable));
  cell.in.service.tool = 1;
  ASSERT_TRUE(cell.serve(Service::SelectTool));
  EXPECT_STREQ(cell.out.tool_name, "pen");
  cell.in.service.point = 2;
  ASSERT_TRUE(cell.serve(Service::MoveJoints));
  EXPECT_LT(apart(end_of(cell) * transform(0, 0, 120, 0, 30, 0), transform(500, 100, 400, 180, 0, 180)), 1e-6);
  cell.in.service.tool = 9;
  EXPECT_FALSE(cell.serve(Service::SelectTool));
  EXPECT_EQ(cell.out.error, ErrorCode::Tool);
  cell.in.service.point = 1;
  cell.ask(Service::MoveJoints);
  ASSERT_TRUE(cell.until([&] { return cell.out.path_speed > 10; }));
  cell.in.service.tool = 2;
  EXPECT_FALSE(cell.serve(Service::SelectTool));
  EXPECT_EQ(cell.out.error, ErrorCode::State);
  EXPECT_STREQ(cell.out.tool_name, "pen");
  EXPECT_TRUE(cell.until([&] { return cell.out.state == GroupState::Standby; }));
}

TEST(Tool, A_job_begins_without_a_tool_whatever_was_held) {
  Cell cell(std::string(kTools) + "MOVJ A\n");
  ASSERT_TRUE(cell.serve(Service::GroupEnable));
  cell.in.service.tool = 2;
  ASSERT_TRUE(cell.serve(Service::SelectTool));
  cell.in.service.job = 1;
  ASSERT_TRUE(cell.serve(Service::JobStart)) << cell.out.job.message;
  EXPECT_LT(apart(end_of(cell), transform(450, -100, 300, 180, 0, 180)), 1e-6);
}

TEST(Tool, The_workspace_is_kept_by_the_tip) {
  Settings settings;
  settings.workspace = {0, -900, 200, 900, 900, 1400};
  Cell cell(
      "POINT DOWN = POSE 450 0 210 RPY 180 0 180\nTOOL long = POSE 0 0 200 RPY 0 0 0\nTOOL long\nMOVJ DOWN\n"
      "MOVL DOWN OFFSET 0, 0, -20\n",
      10, 0, true, settings, cell_urdf());
  ASSERT_TRUE(cell.serve(Service::GroupEnable));
  cell.in.service.job = 1;
  EXPECT_FALSE(cell.serve(Service::JobStart));
  EXPECT_EQ(cell.out.error, ErrorCode::Workspace);
  EXPECT_THAT(cell.out.job.message, HasSubstr("main.job:5"));
}

// Joint values in which the tip touches a place, turned otherwise each time.
std::string touching(const std::vector<Vec3>& turns, const Vec3& tip, std::mt19937& random, double noise) {
  const Arm arm = cell_arm();
  const Inverse inverse(arm);
  const Vec3 place(0.45, 0.1, 0.35);
  std::normal_distribution<double> off(0, noise);
  std::ostringstream text;
  text << std::setprecision(12);
  for (std::size_t i = 0; i < turns.size(); ++i) {
    const Quat turn = from_rpy({kPi, 0, kPi}) * rotation_by(turns[i]);
    const Vec3 touched = place + Vec3(off(random), off(random), off(random));
    const auto found = inverse.nearest({touched - turn * tip, turn}, joints_of({0, -0.3, 0.2, 0, 1.7, 0}));
    EXPECT_EQ(found.reach, Reach::Ok);
    text << "POINT T" << i << " = JOINT";
    for (int k = 0; k < 6; ++k) {
      text << ' ' << degrees(found.solution.q[k]);
    }
    text << '\n';
  }
  return text.str();
}

std::vector<base::Diagnostic> taught(const std::string& text, Pose& tip) {
  auto [book, errors] = parse_jobs({{"a.job", text}});
  EXPECT_TRUE(errors.empty()) << base::to_text(errors);
  auto found = place_tools(book, cell_arm());
  tip = book.tools.at(1).tip;
  return found;
}

const std::vector<Vec3> kTurns = {{0, 0, 0}, {0.6, 0, 0.2}, {-0.3, 0.5, 0}, {0, -0.5, 0.8}};

TEST(Tool, A_tip_is_taught_by_three_or_four_points_that_touch_one_place) {
  std::mt19937 random(3);
  const Vec3 tip(0.012, -0.034, 0.187);
  for (const std::size_t count : {3U, 4U}) {
    const std::vector<Vec3> turns(kTurns.begin(), kTurns.begin() + static_cast<std::ptrdiff_t>(count));
    const std::string points = count == 3 ? "T0 T1 T2" : "T0, T1, T2, T3";
    Pose found;
    const auto notes = taught("TOOL pen = POINTS " + points + " RPY 0 0 90\n" + touching(turns, tip, random, 0), found);
    EXPECT_LT((found.position - tip).norm(), 1e-9);
    EXPECT_LT((found.orientation * Vec3::UnitX() - Vec3::UnitY()).norm(), 1e-9);
    EXPECT_THAT(base::to_text(notes), HasSubstr("a.job:1:6: note: tool 'pen': its tip is at 12.00 -34.00 187.00 mm; "
                                                "its points agree within 0.00 mm"));
  }
}

TEST(Tool, What_is_taught_inexactly_is_off_by_a_few_times_as_much_and_says_so) {
  std::mt19937 random(4);
  const Vec3 tip(0, 0.02, 0.15);
  for (int i = 0; i < 20; ++i) {
    Pose found;
    const auto notes = taught("TOOL pen = POINTS T0 T1 T2 T3\n" + touching(kTurns, tip, random, 0.0004), found);
    EXPECT_LT((found.position - tip).norm(), 0.005);
    ASSERT_EQ(notes.size(), 1U);
    EXPECT_EQ(notes[0].severity, base::Diagnostic::Severity::Note);
  }
}

TEST(Tool, Bad_points_are_refused_with_the_reason) {
  std::mt19937 random(5);
  const Vec3 tip(0, 0.02, 0.15);
  Pose found;
  const std::string one_axis = touching({{0, 0, 0}, {0, 0, 0.5}, {0, 0, -0.7}, {0, 0, 1.2}}, tip, random, 0);
  EXPECT_THAT(base::to_text(taught("TOOL pen = POINTS T0 T1 T2 T3\n" + one_axis, found)),
              HasSubstr("a.job:1:6: error: tool 'pen': its points are turned too little, or all about one axis"));
  std::string off = touching(kTurns, tip, random, 0);
  // Its first joint is a degree and a half further on.
  const std::size_t at = off.find("T2 = JOINT ") + std::string("T2 = JOINT ").size();
  const std::size_t end = off.find(' ', at);
  off.replace(at, end - at, std::to_string(std::stod(off.substr(at, end - at)) + 1.5));
  EXPECT_THAT(base::to_text(taught("TOOL pen = POINTS T0 T1 T2 T3\n" + off, found)),
              HasSubstr("its points do not touch one place: one is "));
}

TEST(Tool, Mistakes_are_named_where_they_are) {
  const std::pair<const char*, const char*> cases[] = {
      {"TOOL pen\n", "a.job:1:6: error: there is no tool 'pen'"},
      {"TOOL pan\nTOOL pen = POSE 0 0 1 RPY 0 0 0\n", "did you mean 'pen'?"},
      {"TOOL pen = POINTS A B\n", "a.job:1:19: error: a tool is taught by 3 points or more"},
      {"TOOL pen = POINTS A B C\nPOINT A = POSE 0 0 0 RPY 0 0 0\n", "a.job:1:19: error: point 'A' is given as POSE"},
      {"TOOL pen = POINTS A B C\n", "a.job:1:23: error: there is no point 'C'"},
      {"TOOL pen = POINTS A B C MASS 0 kg\nPOINT A = JOINT 0 0 0 0 0 0\nPOINT B = JOINT 0 0 0 0 9 0\n"
       "POINT C = JOINT 0 0 0 9 0 0\n",
       "a.job:1:30: error: a mass is above 0 kg"},
      {"TOOL pen = 3\n", "a.job:1:12: error: expected POSE or POINTS"},
      {"TOOL pen = POSE 0 0 0\n", "a.job:1:22: error: expected RPY"},
      {"TOOL FLANGE = POSE 0 0 0 RPY 0 0 0\n", "a.job:1:6: error: there is already a tool 'FLANGE'"},
      {"FRAME f = POINTS A B C TOOL pen\n", "a.job:1:29: error: there is no tool 'pen'"},
  };
  for (const auto& [text, wanted] : cases) {
    EXPECT_THAT(base::to_text(parse_jobs({{"a.job", text}}).diagnostics), HasSubstr(wanted)) << text;
  }
}

TEST(Tool, A_frame_of_joint_angles_is_taught_by_the_tip_that_touched_its_points) {
  auto [book, errors] = parse_jobs(
      {{"a.job",
        "TOOL pen = POSE 0 10 100 RPY 0 0 0\nFRAME f = POINTS A B C TOOL pen\nPOINT A = JOINT 0 -20 10 0 100 0\n"
        "POINT B = JOINT 10 -20 10 0 100 0\nPOINT C = JOINT 0 -30 10 0 100 0\n"}});
  ASSERT_TRUE(errors.empty()) << base::to_text(errors);
  ASSERT_TRUE(place_tools(book, cell_arm()).empty());
  ASSERT_TRUE(place_frames(book, cell_arm()).empty());
  const Joints q = joints_of({0, radians(-20), radians(10), 0, radians(100), 0});
  const Transform tip = transform(cell_arm().forward(q)) * transform(0, 10, 100, 0, 0, 0);
  EXPECT_LT((book.frames[0].pose.position - tip.translation()).norm(), 1e-12);
}

TEST(Tool, An_arm_without_a_closed_form_finds_its_points_with_every_tool) {
  Cell cell("POINT P = POSE 350 200 150 RPY 180 0 20\nTOOL t = POSE 20 0 40 RPY 0 0 0\nMOVJ P\nTOOL t\nMOVJ P\n", 10, 0,
            true, {}, urdf_of("scara"));
  ASSERT_TRUE(cell.serve(Service::GroupEnable));
  cell.in.service.job = 1;
  ASSERT_TRUE(cell.serve(Service::JobStart)) << cell.out.job.message;
  EXPECT_LT((Vec3(cell.out.position[0], cell.out.position[1], cell.out.position[2]) - Vec3(350, 200, 150)).norm(),
            1e-6);
}

}  // namespace
}  // namespace indurop::robot
