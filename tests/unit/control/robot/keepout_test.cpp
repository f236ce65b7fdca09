// SPDX-License-Identifier: Apache-2.0
// Zones and bodies of tools in job files, and what becomes of a job, a service and a hand that would touch them.

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "control/robot/files/files.h"
#include "group_cell.h"
#include "solid_reference.h"

namespace indurop::robot {
namespace {

const char* const kPlaces =
    "POINT P1 = JOINT 0 -20 10 0 100 0\nPOINT P2 = POSE 500 -250 300 RPY 180 0 180\n"
    "POINT P3 = POSE 500 250 300 RPY 180 0 180\n";

std::string wrong_with(const std::string& job, const Settings& settings = {}) {
  try {
    controller_of(solid_cell_urdf(), job, settings);
  } catch (const std::exception& wrong) {
    std::string text = wrong.what();
    return text.substr(text.rfind('/') == std::string::npos ? 0 : text.rfind('/') + 1);
  }
  return "";
}

class Keepout : public testing::Test {
 protected:
  std::unique_ptr<Cell> cell;

  void begin(const std::string& job, const Settings& settings = {}) {
    cell = std::make_unique<Cell>(kPlaces + job, 4, 0, true, settings, solid_cell_urdf());
    ASSERT_TRUE(cell->serve(Service::GroupEnable));
    cell->in.service.target = {0, -20, 10, 0, 100, 0};
    ASSERT_TRUE(cell->serve(Service::DirectAbsolute)) << cell->out.job.message;
  }
  bool run_job() {
    cell->in.service.job = 1;
    return cell->serve(Service::JobStart);
  }
  [[nodiscard]] Vec3 tip() const {
    return Vec3(cell->out.position[0], cell->out.position[1], cell->out.position[2]) / 1000;
  }
};

TEST_F(Keepout, A_motion_into_a_zone_is_refused_before_it_begins_with_its_line) {
  begin("KEEPOUT post = CYLINDER 500 0 0 500 0 500 RADIUS 60\nSPEED 300 mm/s\nMOVJ P2\nMOVL P3\n");
  EXPECT_FALSE(run_job());
  EXPECT_EQ(cell->out.error, ErrorCode::Collision);
  const std::string message = cell->out.job.message;
  EXPECT_EQ(message.find("main.job:7: link 'wrist' and zone 'post' would touch, after "), 0U) << message;
  ASSERT_TRUE(cell->until([&] { return cell->out.state == GroupState::ErrorStop; }));
  EXPECT_LT(tip().y(), 0);  // it stands on the way to where the line would have begun
  ASSERT_TRUE(cell->serve(Service::GroupReset));
  EXPECT_EQ(cell->out.state, GroupState::Standby);
}

TEST_F(Keepout, A_job_may_try_another_way) {
  begin(
      "KEEPOUT post = CYLINDER 500 0 0 500 0 500 RADIUS 60\nPOINT OVER = POSE 500 0 750 RPY 180 0 180\nVAR code = 0\n"
      "MOVJ P2\nTRY\nMOVL P3\nRECOVER\ncode = ERROR\nMOVL P2 OFFSET 0, 0, 450\nMOVL P3 OFFSET 0, 0, 450\nMOVL P3\nEND\n"
      "SET seen = code\n");
  EXPECT_TRUE(run_job()) << cell->out.job.message;
  EXPECT_LT((tip() - Vec3(0.5, 0.25, 0.3)).norm(), 1e-6);
  EXPECT_EQ(cell->values[0], static_cast<double>(ErrorCode::Collision));
}

TEST_F(Keepout, The_body_of_the_tool_that_is_held_counts) {
  const std::string job =
      "TOOL pen = POSE 0 0 50 RPY 0 0 0\nBODY pen = BOX -150 -10 0 -20 10 40\nKEEPOUT post = CYLINDER 640 0 0 640 0 "
      "500 "
      "RADIUS 40\n";
  const std::string way = "SPEED 300 mm/s\nMOVL P2\nMOVL P3\n";
  begin(job + way);
  EXPECT_TRUE(run_job()) << cell->out.job.message;
  begin(job + "TOOL pen\n" + way);
  EXPECT_FALSE(run_job());
  EXPECT_NE(std::string(cell->out.job.message).find("tool 'pen' and zone 'post'"), std::string::npos)
      << cell->out.job.message;
}

TEST_F(Keepout, A_service_is_rejected_with_the_reason) {
  begin("KEEPOUT wall = BOX -900 300 0 900 400 1200\n");
  cell->in.service.target = {500, 350, 300, 180, 0, 180};
  EXPECT_FALSE(cell->serve(Service::LinearAbsolute));
  EXPECT_EQ(cell->out.error, ErrorCode::Collision);
  EXPECT_EQ(cell->out.state, GroupState::Standby);
  EXPECT_NE(std::string(cell->out.job.message).find(" and zone 'wall' would touch, after "), std::string::npos);
  cell->in.service.target = {80, -20, 10, 0, 100, 0};
  EXPECT_FALSE(cell->serve(Service::DirectAbsolute));
  EXPECT_EQ(cell->out.error, ErrorCode::Collision);
}

TEST_F(Keepout, The_arm_does_not_fold_into_itself) {
  begin("");
  std::mt19937 random(9);
  const ReferenceArm arm = ReferenceArm::usual();
  Joints folded = Joints::Zero();
  while (arm.clearance(folded) > 0) {
    folded = anywhere(cell_arm(), random);
  }
  AxisNumbers target;
  for (int i = 0; i < 6; ++i) {
    target[static_cast<std::size_t>(i)] = degrees(folded[i]);
  }
  cell->in.service.target = target;
  EXPECT_FALSE(cell->serve(Service::DirectAbsolute));
  EXPECT_EQ(cell->out.error, ErrorCode::Collision) << to_string(cell->out.error);
  Settings free;
  free.ignore_collisions =
      "shoulder forearm, shoulder wrist, shoulder flange, base forearm, base wrist, base flange, base elbow, shoulder "
      "elbow, upper_arm wrist, upper_arm flange, upper_arm forearm, elbow flange, elbow wrist, forearm flange, base "
      "upper_arm";
  begin("", free);
  cell->in.service.target = target;
  EXPECT_TRUE(cell->serve(Service::DirectAbsolute)) << cell->out.job.message;
}

// A hand comes up to a wall, rests there, and gets away again.
TEST_F(Keepout, A_hand_stops_before_it) {
  for (const JogFrame frame : {JogFrame::Base, JogFrame::Joint}) {
    begin("KEEPOUT wall = BOX -900 400 0 900 500 1200\n");
    const int index = frame == JogFrame::Base ? 1 : 0;
    cell->in.jog.enabled = true;
    cell->in.jog.frame = frame;
    cell->in.jog.speed = {};
    cell->in.jog.speed[static_cast<std::size_t>(index)] = 100;
    double most = 0;
    ASSERT_TRUE(cell->until([&] {
      most = std::max(most, tip().y());
      return cell->periods > 4000;
    }));
    EXPECT_EQ(cell->out.state, GroupState::Standby);
    EXPECT_GT(most, 0.2);
    EXPECT_LT(most, 0.395);
    cell->in.jog.speed[static_cast<std::size_t>(index)] = -100;
    EXPECT_TRUE(cell->until([&] { return tip().y() < 0; }));
  }
}

// Who stands in a zone, which was not there before, may leave it only.
TEST_F(Keepout, From_inside_it_is_left_but_not_entered_deeper) {
  cell =
      std::make_unique<Cell>("KEEPOUT low = BOX 300 -300 0 900 300 900\n", 4, 0, true, Settings(), solid_cell_urdf());
  ASSERT_TRUE(cell->serve(Service::GroupEnable));
  const auto& turn = cell->out.orientation;
  const double start = tip().z();  // at 920 mm; its hand reaches 45 mm below that
  cell->in.service.target = {1000 * tip().x() - 50, 0, 1000 * start - 20, turn[0], turn[1], turn[2]};
  EXPECT_FALSE(cell->serve(Service::LinearAbsolute));
  EXPECT_EQ(cell->out.error, ErrorCode::Collision);
  cell->in.service.target[2] = 1000 * start + 60;
  EXPECT_TRUE(cell->serve(Service::LinearAbsolute)) << cell->out.job.message << to_string(cell->out.error);
}

// Single axes that are moved, and new targets in mid-move, as a second opinion sees them in every period.
class Unplanned : public Keepout {
 protected:
  const ReferenceArm arm = ReferenceArm::usual();
  const ReferenceSolid wall{ReferenceSolid::Kind::Box, {1.8, 0.1, 1.2}, {}, {}};
  std::vector<ReferencePlace> zones{{&wall, Eigen::Isometry3d(Eigen::Translation3d(0, 0.45, 0.6))}};
  double least = HUGE_VAL;

  void start(double period_ms) {
    cell = std::make_unique<Cell>(std::string(kPlaces) + "KEEPOUT wall = BOX -900 400 0 900 500 1200\n", period_ms, 0,
                                  true, Settings(), arm.urdf());
    ASSERT_TRUE(cell->serve(Service::GroupEnable));
    cell->in.service.target = {0, -20, 10, 0, 100, 0};
    ASSERT_TRUE(cell->serve(Service::DirectAbsolute)) << cell->out.job.message;
    least = HUGE_VAL;
  }
  void look() {
    Joints q = Joints::Zero();
    for (int i = 0; i < 6; ++i) {
      q[i] = radians(cell->out.command[static_cast<std::size_t>(i)]);
    }
    least = std::min(least, arm.clearance(q, zones));
  }
};

TEST_F(Unplanned, Single_axes_stop_before_anything_touches) {
  std::mt19937 random{3};
  const auto in = [&](double low, double high) { return std::uniform_real_distribution<double>(low, high)(random); };
  int stopped = 0;
  for (int i = 0; i < poses(24); ++i) {
    start(i % 3 == 0 ? 1 : i % 3 == 1 ? 4 : 10);
    for (std::size_t axis = 0; axis < 5; ++axis) {
      cell->ask_axis(axis, AxisService::MoveVelocity, 0, in(-200, 200));
    }
    const int begun = cell->periods;
    ASSERT_TRUE(cell->until(
        [&] {
          look();
          return cell->out.state == GroupState::ErrorStop || cell->periods - begun > 1500;
        },
        20000));
    EXPECT_GT(least, 0.001) << i;
    if (cell->out.state == GroupState::ErrorStop && cell->out.error == ErrorCode::Collision) {
      ++stopped;
      EXPECT_NE(std::string(cell->out.job.message).find("would touch"), std::string::npos) << cell->out.job.message;
      ASSERT_TRUE(cell->serve(Service::GroupReset));
      cell->in.service.target = {0, -20, 10, 0, 100, 0};
      if (!cell->serve(Service::DirectAbsolute)) {  // the straight way back may lead nearer first
        EXPECT_NE(std::string(cell->out.job.message).find("would touch"), std::string::npos) << cell->out.job.message;
      }
    }
  }
  EXPECT_GT(stopped, poses(24) / 3);
}

TEST_F(Unplanned, A_hold_keeps_to_the_path_that_was_checked) {
  std::mt19937 random{5};
  const auto in = [&](double low, double high) { return std::uniform_real_distribution<double>(low, high)(random); };
  int held = 0;
  for (int i = 0; i < poses(24); ++i) {
    start(4);
    cell->in.service.target = {in(-60, 60), in(-40, 30), in(-30, 20), in(-90, 90), in(0, 100), 0};
    cell->ask(Service::DirectAbsolute);
    const int begun = cell->periods;
    const int hold_at = begun + std::uniform_int_distribution<int>(1, 60)(random);
    ASSERT_TRUE(cell->until([&] {
      look();
      return cell->periods == hold_at;
    }));
    cell->in.hold = true;
    const int longest = 250;  // periods: 1 s, where motions take up to 2
    for (int k = 0; k < longest; ++k) {
      look();
      cell->step();
    }
    const auto rest = cell->out.command;
    cell->step();
    EXPECT_EQ(rest, cell->out.command) << i;
    held += cell->out.state == GroupState::Moving ? 1 : 0;
    cell->in.hold = false;
    ASSERT_TRUE(cell->until([&] {
      look();
      return cell->out.state == GroupState::Standby;
    }));
    EXPECT_GT(least, 0.004) << i;
  }
  EXPECT_GT(held, poses(24) / 2);
}

TEST_F(Unplanned, New_targets_in_mid_move_are_clear_or_change_nothing) {
  std::mt19937 random{4};
  const auto in = [&](double low, double high) { return std::uniform_real_distribution<double>(low, high)(random); };
  int taken = 0;
  int refused = 0;
  for (int i = 0; i < poses(24); ++i) {
    start(4);
    cell->in.service.target = {in(-60, 10), in(-40, 30), in(-30, 20), in(-90, 90), in(0, 100), 0};
    cell->ask(Service::DirectAbsolute);
    const int begun = cell->periods;
    ASSERT_TRUE(cell->until([&] {
      look();
      return cell->periods - begun > 40;
    }));
    cell->in.service.target = {in(-60, 120), in(-40, 50), in(-60, 40), in(-90, 90), in(-100, 100), 0};
    cell->ask(Service::DirectAborting);
    ASSERT_TRUE(cell->until([&] {
      look();
      cell->in.speed_override = cell->periods % 70 < 20 ? 60 : 100;
      cell->in.hold = cell->periods % 90 < 10;
      return cell->periods - begun > 60 && cell->out.state == GroupState::Standby;
    }));
    EXPECT_GT(least, 0.004) << i;
    (cell->out.error == ErrorCode::Collision ? refused : taken)++;
  }
  EXPECT_GT(taken, poses(24) / 4);
  EXPECT_GT(refused, poses(24) / 12);
}

TEST_F(Keepout, Zones_may_be_in_a_frame) {
  begin(
      "FRAME pallet = POSE 500 0 0 RPY 0 0 90\nKEEPOUT post = CYLINDER 0 0 0 0 0 500 RADIUS 60 IN pallet\nSPEED 300 "
      "mm/s\nMOVJ P2\nMOVL P3\n");
  EXPECT_FALSE(run_job());
  EXPECT_EQ(cell->out.error, ErrorCode::Collision);
}

TEST(KeepoutText, Errors_are_reported_with_their_place) {
  const std::pair<const char*, const char*> all[] = {
      {"KEEPOUT a\n", "main.job:1:10: error: expected a name and '='; KEEPOUT table = BOX x y z x y z"},
      {"KEEPOUT a = PLATE 1 2 3\n", "main.job:1:13: error: expected BOX x y z x y z (two opposite corners), CYLINDER"},
      {"KEEPOUT a = BOX 0 0 0 100 100\n", "main.job:1:30: error: expected 6 numbers: two opposite corners"},
      {"KEEPOUT a = BOX 0 0 0 100 100 0\n",
       "main.job:1:13: error: a body has to have a size above 0 in all directions"},
      {"KEEPOUT a = CYLINDER 0 0 0 0 0 0 RADIUS 5\n", "main.job:1:13: error: a body has to have a size above 0"},
      {"KEEPOUT a = CYLINDER 0 0 0 0 0 9\n", "main.job:1:33: error: expected RADIUS and a number in mm"},
      {"KEEPOUT a = BALL 0 0 0 RADIUS -1\n", "main.job:1:13: error: a body has to have a size above 0"},
      {"KEEPOUT a = BALL 0 0 9 RADIUS 1 IN f\n", "main.job:1:36: error: there is no frame 'f'"},
      {"KEEPOUT a = BALL 0 0 9 RADIUS 1\nKEEPOUT a = BALL 0 0 9 RADIUS 1\n",
       "main.job:2:9: error: there is already a zone 'a' to keep out of"},
      {"BODY pen = BALL 0 0 9 RADIUS 1\n", "main.job:1:6: error: there is no tool 'pen'"},
  };
  for (const auto& [job, text] : all) {
    EXPECT_EQ(wrong_with(job).find(text), 0U) << job << wrong_with(job);
  }
  Settings settings;
  settings.ignore_collisions = "wrist";
  EXPECT_EQ(wrong_with("", settings).find("property ignore_collisions: error: write two names of links"), 0U);
  settings.ignore_collisions = "wrist hand";
  EXPECT_EQ(wrong_with("", settings), "property ignore_collisions: error: there is no link, tool or zone 'hand'");
}

}  // namespace
}  // namespace indurop::robot
