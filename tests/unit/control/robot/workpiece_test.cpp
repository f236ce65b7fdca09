// SPDX-License-Identifier: Apache-2.0
// Tables that turn the workpiece: jobs that move them with the arm and without it, what stands still in the world, and
// what is rejected. Where the tool is, arm_kinds_test compares with orocos-kdl; random_elbows_test follows lines.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "control/robot/files/read_files.h"
#include "control/robot/files/solve_points.h"
#include "group_cell.h"

namespace indurop::robot {
namespace {

const std::string kTurntableJob =
    "POINT START = JOINT -60 -70 90 -110 -90 0 0\nPOINT A = POSE 100 0 150 RPY 180 0 0 AXIS 7 0\n"
    "POINT B = POSE -100 50 150 RPY 180 0 0\nMOVJ START\n";

std::string with_element(std::string urdf, const std::string& element) {
  const std::size_t at = urdf.find("  <workpiece");
  return urdf.replace(at, urdf.find('\n', at) - at, element);
}

class Workpiece : public testing::Test {
 protected:
  const Arm arm = arm_of("turntable");
  std::unique_ptr<Cell> cell;
  std::string text;                // of the URDF
  double least = 0, most = 0;      // deg, of the table while the job ran
  double fastest_turn = 0;         // deg/s, of the table
  std::vector<Joints> set_points;  // of each period

  Workpiece() : text(urdf_of("turntable")) {}

  void begin(const std::string& job) {
    cell = std::make_unique<Cell>(kTurntableJob + job, 4, 0, true, Settings{}, text);
    ASSERT_TRUE(cell->serve(Service::GroupEnable));
    cell->in.service.job = 1;
    cell->ask(Service::JobStart);
  }
  void run(const std::string& job, JobState end = JobState::Ended) {
    begin(job);
    least = most = fastest_turn = 0;
    set_points.clear();
    const auto ended = [&] {
      least = std::min(least, cell->out.command[6]);
      most = std::max(most, cell->out.command[6]);
      fastest_turn = std::max(fastest_turn, std::abs(cell->out.speed[6]));
      set_points.push_back(joints());
      return cell->out.job.state == JobState::Ended || cell->out.job.state == JobState::Failed;
    };
    ASSERT_TRUE(cell->until(ended, 20000));
    ASSERT_EQ(cell->out.job.state, end) << cell->out.job.message;
  }
  [[nodiscard]] std::string errors_of(const std::string& job, const std::string& element = "",
                                      const Settings& settings = {}) const {
    try {
      Cell sut(job, 4, 0, true, settings, element.empty() ? text : with_element(text, element));
    } catch (const std::runtime_error& error) {
      const std::string said = error.what();
      const std::size_t file = said.find("main.job:");
      return file == std::string::npos ? said : said.substr(file);
    }
    return "";
  }
  [[nodiscard]] Joints joints() const {
    Joints q = Joints::Zero();
    for (int i = 0; i < arm.count(); ++i) {
      q[i] = radians(cell->out.command[static_cast<std::size_t>(i)]);
    }
    return q;
  }
  // rad, by which the axes of the arm are away from straight lines between the set points of an earlier run.
  [[nodiscard]] double away_from(const std::vector<Joints>& path) const {
    using ArmAxes = Eigen::Matrix<double, 6, 1>;
    const ArmAxes here = joints().head<6>();
    double least_away = HUGE_VAL;
    for (std::size_t i = 1; i < path.size(); ++i) {
      const ArmAxes from = path[i - 1].head<6>();
      const ArmAxes along = path[i].head<6>() - from;
      const double part = along.squaredNorm() > 0 ? (here - from).dot(along) / along.squaredNorm() : 0;
      least_away = std::min(least_away, (here - from - std::clamp(part, 0.0, 1.0) * along).norm());
    }
    return least_away;
  }
  void expect_on_workpiece(const Vec3& place) const {
    EXPECT_LT((1000 * arm.forward(joints()).position - place).norm(), 1e-6) << arm.forward(joints()).position;
  }
};

TEST_F(Workpiece, Turns_while_the_tool_follows_a_line_on_it) {
  run("MOVJ A\nMOVL B AXIS 7 70\n");
  expect_on_workpiece({-100, 50, 150});
  EXPECT_NEAR(cell->out.command[6], 70, 1e-9);
}

TEST_F(Workpiece, Turns_under_a_tool_that_keeps_its_place_on_it) {
  run("MOVJ A\nMOVL HERE AXIS 7 -45\n");
  expect_on_workpiece({100, 0, 150});
  EXPECT_NEAR(cell->out.command[6], -45, 1e-9);
}

TEST_F(Workpiece, Stays_if_nothing_is_said_of_it) {
  run("MOVJ A\nMOVJ HERE AXIS 7 30\nMOVL B\n");
  expect_on_workpiece({-100, 50, 150});
  EXPECT_NEAR(cell->out.command[6], 30, 1e-9);
  run("MOVJ HERE AXIS 7 30\nMOVJ B\n");
  expect_on_workpiece({-100, 50, 150});
  EXPECT_NEAR(cell->out.command[6], 30, 1e-9) << "a joint motion to a pose";
}

TEST_F(Workpiece, Turns_alone_while_the_arm_stands) {
  run("MOVJ A\n");
  const Joints before = joints();
  run("MOVJ A\nMOVJ HERE AXIS 7 120\n");
  EXPECT_LT((joints() - before).head<6>().norm(), 1e-12);
  EXPECT_NEAR(cell->out.command[6], 120, 1e-9);
  run("MOVJ START AXIS 7 -80\n");
  EXPECT_NEAR(cell->out.command[1], -70, 1e-9);
  EXPECT_NEAR(cell->out.command[6], -80, 1e-9);
}

// However often it has turned before.
TEST_F(Workpiece, Stands_at_the_angle_of_a_point_not_a_turn_away) {
  run("POINT C = POSE 100 0 150 RPY 180 0 0 AXIS 7 400\nMOVJ HERE AXIS 7 -350\nMOVJ C\n");
  EXPECT_NEAR(cell->out.command[6], 400, 1e-9);
  expect_on_workpiece({100, 0, 150});
  run("MOVJ HERE AXIS 7 -225\nMOVJ A\nMOVL B AXIS 7 20\n");
  EXPECT_NEAR(cell->out.command[6], 20, 1e-9);
}

TEST_F(Workpiece, A_joint_motion_beyond_a_limit_of_it_is_rejected_before_it_begins) {
  text.replace(text.find("type=\"continuous\""), 17, "type=\"revolute\"");
  text.replace(text.find("<limit velocity=\"1.5\""), 21, "<limit lower=\"-1.6\" upper=\"1.6\" velocity=\"1.5\"");
  for (const std::string motion : {"MOVJ B AXIS 7 x", "MOVJ B STRAIGHT AXIS 7 x", "MOVJ HERE OFFSET 0, 0, 20 AXIS 7 x",
                                   "MOVJ HERE AXIS 7 x", "MOVL B AXIS 7 x"}) {
    run("VAR x = 100\nMOVJ A\nTRY\n" + motion + "\nRECOVER\nMOVJ HERE AXIS 7 -5\nEND\n");
    EXPECT_NEAR(cell->out.command[6], -5, 1e-9) << motion;
    EXPECT_NEAR(most, 0, 1e-6) << motion;
  }
  EXPECT_NE(errors_of("POINT C = POSE 100 0 150 RPY 180 0 0 AXIS 7 100\nMOVJ C\n")
                .find("main.job:1:38: error: point 'C': AXIS 7 is at 100 degrees, its limits are -91.6732 to 91.6732"),
            std::string::npos);
}

// With the default 1320000 counts per turn, a drive of 32 bits counts 1626 turns each way.
TEST_F(Workpiece, An_angle_that_its_drive_cannot_count_is_rejected) {
  const std::string said = errors_of(kTurntableJob + "MOVJ A\n  MOVL B SPEED 10% AXIS 7 1e12\nMOVL B AXIS 7 -585600\n");
  EXPECT_EQ(
      said,
      "main.job:6:20: error: AXIS 7 is at 1e+12 degrees; its drive counts from -585677 to 585677 (counts_per_turn)");
  EXPECT_NE(errors_of("POINT C = POSE 100 0 150 RPY 180 0 0 AXIS 7 -6e5\nMOVJ C\n")
                .find("main.job:1:38: error: point 'C': AXIS 7 is at -600000 degrees; its drive counts from"),
            std::string::npos);
  EXPECT_NE(errors_of("POINT D = JOINT -60 -70 90 -110 -90 0 6e5\nMOVJ D\n")
                .find("main.job:1:7: error: point 'D': joint 7 is at 600000 degrees; its drive counts from"),
            std::string::npos);
  Settings fine;
  fine.counts_per_turn = {1e5, 1e5, 1e5, 1e5, 1e5, 1e5, -1e9};
  fine.gear = {1, 1, 1, 1, 1, 1, 2};
  fine.zero = {0, 0, 0, 0, 0, 0, 6};
  EXPECT_EQ(
      errors_of(kTurntableJob + "MOVJ HERE AXIS 7 380\nMOVL A AXIS 7 381\n", "", fine),
      "main.job:6:8: error: AXIS 7 is at 381 degrees; its drive counts from -380.547 to 380.547 (counts_per_turn)");
  for (const std::string motion : {"MOVJ HERE AXIS 7 x", "MOVL B AXIS 7 -x", "MOVJ B AXIS 7 x"}) {
    run("VAR x = 1e12\nMOVJ A\nTRY\n" + motion + "\nRECOVER\nMOVJ HERE AXIS 7 -5\nEND\n");
    EXPECT_NEAR(cell->out.command[6], -5, 1e-9) << motion;
    EXPECT_NEAR(most, 0, 1e-6) << motion;
  }
}

TEST_F(Workpiece, An_angle_is_given_once) {
  const std::string said = "error: this line already says where axis 7 is; leave one of them out";
  EXPECT_EQ(errors_of(kTurntableJob + "MOVL B AXIS 7 10 SPEED 20% AXIS 7 20\n"), "main.job:5:33: " + said);
  EXPECT_EQ(errors_of("POINT C = POSE 100 0 150 RPY 180 0 0 AXIS 7 0 AXIS 7 0\nMOVJ C\n"), "main.job:1:52: " + said);
}

TEST_F(Workpiece, A_point_out_of_reach_is_reported_with_the_angle) {
  ReadJobs jobs = parse_jobs({{"main.job",
                               "POINT C = POSE 5000 0 150 RPY 180 0 0 AXIS 7 90\n"
                               "POINT D = POSE 5000 0 150 RPY 180 0 0\n"}},
                             shape_of(arm));
  EXPECT_EQ(base::to_text(solve_points(jobs.book, arm, true)),
            "main.job:1:7: warning: point 'C': the arm cannot hold its tool like that there with AXIS 7 at 90 degrees; "
            "give it a nearer position or another orientation\n"
            "main.job:2:7: warning: point 'D': the arm cannot hold its tool like that there with AXIS 7 anywhere; "
            "give it a nearer position or another orientation\n");
  run("POINT C = POSE -300 0 150 RPY 180 0 0\nC = POSE 5000, 0, 150 RPY 180, 0, 0\nMOVJ HERE AXIS 7 -30\nMOVL C\n",
      JobState::Failed);
  EXPECT_STREQ(cell->out.job.message, "main.job:8: the target is out of reach; axis 7 ends at -30 degrees");
  run("POINT C = POSE -300 0 150 RPY 180 0 0\nC = POSE 5000, 0, 150 RPY 180, 0, 0\nMOVJ C AXIS 7 12.5\n",
      JobState::Failed);
  EXPECT_STREQ(cell->out.job.message, "main.job:7: the target is out of reach; axis 7 ends at 12.5 degrees");
}

// The tool rests on the workpiece, 100 mm from the axis of the table, so it moves on a circle in the world.
TEST_F(Workpiece, A_speed_of_the_tool_limits_a_table_that_turns_alone) {
  const auto fastest = [this](const std::string& speed) {
    run("MOVJ A\nMOVL HERE AXIS 7 90" + speed + "\n");
    return fastest_turn;
  };
  EXPECT_NEAR(fastest(" SPEED 20 mm/s"), degrees(0.2), degrees(0.0004));
  EXPECT_NEAR(fastest(" SPEED 90 mm/s"), degrees(0.9), degrees(0.0018));
  EXPECT_NEAR(fastest(" SPEED 2%"), degrees(0.03), degrees(0.00006));
  EXPECT_GT(fastest(""), degrees(1));
}

// The arm comes to rest on its path, as if the table still turned. The path is known from a run without the fault.
TEST_F(Workpiece, A_fault_of_its_drive_stops_the_arm_on_its_path) {
  const std::string job = "MOVJ A\nMOVL B AXIS 7 70 SPEED 60 mm/s\n";
  run(job);
  const std::vector<Joints> path = set_points;
  begin(job);
  ASSERT_TRUE(cell->until([&] { return cell->out.command[6] > 35; }));
  const double turned = cell->out.axes[6].position;
  const Joints before = joints();
  cell->in.drives[6].status = Cell::kFault;
  int periods = 0;
  ASSERT_TRUE(cell->until([&] {
    EXPECT_LT(away_from(path), 1e-6) << ++periods;
    return cell->out.state == GroupState::ErrorStop;
  }));
  EXPECT_EQ(cell->out.error, ErrorCode::Drive);
  EXPECT_EQ(cell->out.error_axis, 7);
  EXPECT_EQ(cell->out.job.state, JobState::Failed);
  EXPECT_STREQ(cell->out.job.message, "main.job:6: axis 7 (turn): a drive reports a fault");
  EXPECT_GT((joints() - before).head<6>().norm(), 1e-4) << "the arm brakes";
  EXPECT_LT((joints() - before).head<6>().norm(), 0.1);
  EXPECT_NEAR(cell->out.command[6], turned, 1) << "the table is to stay where it is";
}

TEST_F(Workpiece, A_place_in_the_world_is_reached_however_it_is_turned) {
  for (const int turned : {0, 50, -110}) {
    run("POINT BIN = POSE -100 50 150 RPY 180 0 0\nMOVJ HERE AXIS 7 " + std::to_string(turned) +
        "\nBIN = WORLD : POSE -100, 50, 180 RPY 180, 0, 0\nMOVJ BIN\nMOVL BIN OFFSET 0, 0, 20\n");
    const Vec3 there = 1000 * arm.in_world().forward(joints()).position;
    EXPECT_LT((there - Vec3(-100, 50, 200)).norm(), 1e-6) << there;
    EXPECT_NEAR(cell->out.command[6], turned, 1e-9);
  }
}

TEST_F(Workpiece, A_frame_may_be_named_WORLD) {
  run("FRAME WORLD = POSE 0 0 50 RPY 0 0 0\nPOINT P = POSE 0 0 150 RPY 180 0 0\nMOVJ HERE AXIS 7 90\n"
      "P = WORLD : POSE 100, 0, 100 RPY 180, 0, 0\nMOVJ P\n");
  expect_on_workpiece({100, 0, 150});
}

// A beam of 1.2 m on the table.
class Beam : public Workpiece {
 protected:
  Beam() { put_box("work", "0 0 -0.3", "1.2 0.05 0.05"); }
  void put_box(const std::string& link, const std::string& place, const std::string& size) {
    const std::string plain = "<link name=\"" + link + "\"/>";
    const std::string box =
        "<collision><origin xyz=\"" + place + "\"/><geometry><box size=\"" + size + "\"/></geometry></collision>";
    text.replace(text.find(plain), plain.size(), "<link name=\"" + link + "\">" + box + "</link>");
  }
  void expect_collision(const std::string& with) const {
    EXPECT_EQ(cell->out.error, ErrorCode::Collision);
    EXPECT_NE(std::string(cell->out.job.message).find(with), std::string::npos) << cell->out.job.message;
    EXPECT_NEAR(cell->out.command[6], 0, 1e-9);
  }
};

TEST_F(Beam, Is_kept_out_of_zones_which_stand_still) {
  const std::string post = "KEEPOUT post = BOX -50 450 -400 50 550 -200\n";
  run(post + "MOVJ HERE AXIS 7 60\nMOVJ HERE AXIS 7 -60\n");
  run(post + "MOVJ HERE AXIS 7 90\n", JobState::Failed);
  expect_collision("zone 'post'");
}

// The same place as that of the zone; frame `work` is turned by 0.5 rad.
TEST_F(Beam, Is_kept_away_from_what_stands_on_the_floor) {
  put_box("table", "-0.24 0.44 -0.25", "0.1 0.1 0.2");
  run("MOVJ HERE AXIS 7 60\nMOVJ HERE AXIS 7 -60\n");
  run("MOVJ HERE AXIS 7 90\n", JobState::Failed);
  expect_collision("link 'table'");
}

TEST_F(Beam, A_free_motion_turns_it_no_farther_than_it_says) {
  run("POINT C = POSE -100 50 150 RPY 180 0 0 AXIS 7 40\nKEEPOUT wall = BOX -40 -600 100 40 600 400\nMOVE FREE TO C\n");
  EXPECT_NEAR(cell->out.command[6], 40, 1e-9);
  EXPECT_GT(least, -1e-6);
  EXPECT_LT(most, 40 + 1e-6);
  expect_on_workpiece({-100, 50, 150});
}

TEST_F(Workpiece, What_cannot_be_combined_is_said) {
  const std::string track = errors_of(
      "FRAME f = POSE 0 0 0 RPY 0 0 0\nFRAME g = POSE 0 0 0 RPY 0 0 0\nTRACK f ON BELT 1 ALONG g\nTRACK OFF\n");
  EXPECT_NE(track.find("main.job:3:1: error: TRACK cannot be used with axes that move the workpiece"),
            std::string::npos)
      << track;
  Settings settings;
  settings.workspace = {-900, -900, -900, 900, 900, 900};
  const std::string box = errors_of("", "", settings);
  EXPECT_NE(box.find("property workspace: error: it cannot be used with axes that move the workpiece"),
            std::string::npos)
      << box;
}

TEST_F(Workpiece, What_is_wrong_in_the_URDF_is_said_with_its_line) {
  const auto expect = [&](const std::string& element, const std::string& wanted) {
    const std::string found = errors_of("", element);
    EXPECT_NE(found.find(wanted), std::string::npos) << element << ": " << found;
  };
  expect("<workpiece link=\"plat\"/>", "error: <workpiece> names the link 'plat', which is not there");
  expect("<workpiece link=\"work\"/><workpiece link=\"work\"/>", "error: there is one <workpiece> already");
  expect("<workpiece/>", "error: <workpiece> names the link '', which is not there");
  expect("<workpiece link=\"table\"/>", "error: <workpiece>: no joint moves the link 'table'");
  expect("<workpiece link=\"link2\"/>", "error: <workpiece>: joint 'joint1' moves both the link 'link2' and the arm");
}

}  // namespace
}  // namespace indurop::robot
