// SPDX-License-Identifier: Apache-2.0
// Tables that turn the workpiece: jobs that move them with the arm and without it, what stands still in the world, and
// what is rejected. Where the tool is, arm_kinds_test compares with orocos-kdl; random_elbows_test follows lines.
#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>

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
  std::string text;            // of the URDF
  double least = 0, most = 0;  // deg, of the table while the job ran

  Workpiece() : text(urdf_of("turntable")) {}

  void run(const std::string& job, JobState end = JobState::Ended) {
    cell = std::make_unique<Cell>(kTurntableJob + job, 4, 0, true, Settings{}, text);
    ASSERT_TRUE(cell->serve(Service::GroupEnable));
    cell->in.service.job = 1;
    cell->ask(Service::JobStart);
    least = most = 0;
    const auto ended = [&] {
      least = std::min(least, cell->out.command[6]);
      most = std::max(most, cell->out.command[6]);
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
      return error.what();
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
                .find("main.job:1:7: error: point 'C': AXIS 7 is at 100 degrees, its limits are -91.6732 to 91.6732"),
            std::string::npos);
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
