// SPDX-License-Identifier: Apache-2.0
// Robots that share their space: who waits for whom, what is said of it, and what stops them. Two arms face each other
// and cannot both point to the middle.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <optional>

#include "two_robots.h"

namespace indurop::robot {
namespace {

using testing::HasSubstr;

const std::string kPoints =
    "POINT OUT = JOINT 90 0 0 0 0 0\nPOINT IN = JOINT 0 0 0 0 0 0\nPOINT LEFT = JOINT 30 0 0 0 0 0\n"
    "POINT FAR = JOINT 60 0 0 0 0 0\n"
    "POINT RIGHT = JOINT -30 0 0 0 0 0\n";

class Shared_space : public testing::Test {
 protected:
  static constexpr std::size_t kA = 0, kB = 1;
  std::optional<SharingRobots> sut;

  void begin(const std::string& job_a, const std::string& job_b, double turned_b = 90) {
    const std::vector<double> opposite{1400, 0, 0, 0, 0, 180};
    sut.emplace(std::vector<SharingRobot>{{"A", kPoints + job_a}, {"B", kPoints + job_b, opposite, turned_b}}, 4);
    ASSERT_TRUE(sut->enable());
  }
  void start(std::size_t robot) { sut->start(robot); }
  [[nodiscard]] double turned(std::size_t robot) { return (*sut)[robot].out.command[0]; }
  [[nodiscard]] bool ended(std::size_t robot) { return (*sut)[robot].out.job.state == JobState::Ended; }
  [[nodiscard]] std::string waits_for(std::size_t robot) { return std::string(sut->report(robot).waits_for); }
  void run(double seconds) {
    static_cast<void>(sut->until([] { return false; }, static_cast<int>(seconds / 0.004)));
  }
  [[nodiscard]] std::string message(std::size_t robot) { return (*sut)[robot].out.job.message; }
};

TEST_F(Shared_space, A_robot_waits_for_one_that_stands_in_its_way_and_goes_when_it_has_left) {
  begin("MOVJ IN\n", "MOVJ IN\nWAIT 1 s\nMOVJ OUT\n");
  start(kB);
  ASSERT_TRUE(sut->until([&] { return turned(kB) < 1; }));
  start(kA);
  ASSERT_TRUE(sut->until([&] { return waits_for(kA) == "B"; }, 50));
  EXPECT_EQ((*sut)[kA].out.state, GroupState::Moving);
  run(0.5);
  EXPECT_EQ(turned(kA), 90) << "it has not begun";
  EXPECT_TRUE(sut->report(kA).stands);
  ASSERT_TRUE(sut->until([&] { return ended(kA); }));
  EXPECT_NEAR(turned(kA), 0, 1e-6);
  EXPECT_GT(turned(kB), 89);
  EXPECT_EQ(waits_for(kA), "");
}

TEST_F(Shared_space, A_motion_that_was_granted_keeps_the_other_out_although_it_is_held) {
  begin("MOVJ IN\nMOVJ OUT\n", "MOVJ IN\n");
  start(kA);
  ASSERT_TRUE(sut->until([&] { return turned(kA) < 80; }));
  (*sut)[kA].in.hold = true;
  start(kB);
  run(3);
  EXPECT_EQ(turned(kB), 90);
  EXPECT_EQ(waits_for(kB), "A");
  (*sut)[kA].in.hold = false;
  ASSERT_TRUE(sut->until([&] { return ended(kB); }));
}

// One that goes in and out for ever cannot keep the other one waiting.
TEST_F(Shared_space, Robots_are_served_in_the_order_in_which_they_began_to_wait) {
  const std::string in_and_out = "LOOP\nMOVJ IN\nMOVJ OUT\nMOVJ FAR\nMOVJ OUT\nEND\n";
  begin(in_and_out, in_and_out);
  start(kA);
  start(kB);
  std::array<int, 2> times{};
  std::array<bool, 2> in{};
  static_cast<void>(sut->until(
      [&] {
        for (const std::size_t robot : {kA, kB}) {
          times[robot] += turned(robot) < 1 && !in[robot] ? 1 : 0;
          in[robot] = turned(robot) < 1;
        }
        EXPECT_FALSE(in[kA] && in[kB]);
        return false;
      },
      20000));
  EXPECT_GT(times[kA], 10);
  EXPECT_LE(std::abs(times[kA] - times[kB]), 1) << times[kA] << " and " << times[kB];
}

// Each of two robots stands where the other one wants to go.
TEST_F(Shared_space, A_deadlock_is_named_and_ends_the_job_that_began_to_wait_last) {
  begin("MOVJ LEFT\nWAIT 1 s\nMOVJ RIGHT\n", "MOVJ LEFT\nWAIT 1.5 s\nMOVJ RIGHT\n");
  start(kA);
  start(kB);
  ASSERT_TRUE(sut->until([&] { return (*sut)[kB].out.state == GroupState::ErrorStop; }));
  EXPECT_EQ((*sut)[kB].out.error, ErrorCode::OtherRobot);
  EXPECT_EQ(message(kB),
            "main.job:8: this robot and A wait for each other; move one of them away, then resume its job");
  EXPECT_NEAR(turned(kB), 30, 1e-6);
  run(1);
  EXPECT_EQ((*sut)[kA].out.state, GroupState::Moving);
  EXPECT_EQ(waits_for(kA), "B");
  (*sut)[kB].ask(Service::GroupReset);
  ASSERT_TRUE(sut->until([&] { return (*sut)[kB].out.state == GroupState::Standby; }));
  (*sut)[kB].in.service.target = {90, 0, 0, 0, 0, 0};
  (*sut)[kB].ask(Service::DirectAbsolute);
  ASSERT_TRUE(sut->until([&] { return ended(kA); }));
  EXPECT_NEAR(turned(kA), -30, 1e-6);
}

TEST_F(Shared_space, A_job_can_recover_from_a_deadlock) {
  begin("MOVJ LEFT\nMOVJ RIGHT\n", "MOVJ LEFT\nWAIT 1 s\nTRY\nMOVJ RIGHT\nRECOVER\nMOVJ OUT\nMOVJ RIGHT\nEND\n");
  start(kA);
  start(kB);
  EXPECT_TRUE(sut->until([&] { return ended(kA) && turned(kB) > 89; }));
  EXPECT_TRUE(sut->until([&] { return waits_for(kB) == "A"; }));
}

TEST_F(Shared_space, Jogging_ends_where_the_other_robot_is_and_says_so) {
  begin("", "", 0);
  Cell& a = (*sut)[kA];
  a.in.jog = {true, JogFrame::Joint, {-100}, 0, {}};
  ASSERT_TRUE(sut->until([&] { return a.out.state == GroupState::ErrorStop; }));
  EXPECT_EQ(a.out.error, ErrorCode::Collision);
  EXPECT_STREQ(a.out.job.message, "the arm would come into the way of B");
  EXPECT_GT(turned(kA), 5);
  EXPECT_GT(sut->apart(kA, kB), 0.02);
  // It can be jogged back.
  a.in.jog = {};
  ASSERT_TRUE(a.serve(Service::GroupReset));
  a.in.jog = {true, JogFrame::Joint, {100}, 0, {}};
  EXPECT_TRUE(sut->until([&] { return turned(kA) > 80; }));
  EXPECT_EQ(sut->report(kA).intrusions, 0U);
}

// An arm without power is pushed by hand.
TEST_F(Shared_space, A_robot_stops_on_its_path_if_another_one_comes_into_its_way) {
  begin("MOVJ IN\n", "");
  Cell& b = (*sut)[kB];
  b.ask(Service::GroupDisable);
  ASSERT_TRUE(sut->until([&] { return b.out.state == GroupState::Disabled; }));
  start(kA);
  ASSERT_TRUE(sut->until([&] { return turned(kA) < 80; }));
  b.in.drives[0].position = 0;
  ASSERT_TRUE(sut->until([&] { return (*sut)[kA].out.state == GroupState::ErrorStop; }));
  EXPECT_EQ((*sut)[kA].out.error, ErrorCode::OtherRobot);
  EXPECT_THAT(message(kA), HasSubstr("B has come into the way of this robot"));
  EXPECT_EQ(sut->report(kB).intruded, "A");
  // It continues where it stopped, once the other one is out of the way.
  ASSERT_TRUE((*sut)[kA].serve(Service::GroupReset));
  ASSERT_TRUE((*sut)[kA].out.job.can_resume);
  (*sut)[kA].ask(Service::JobResume);
  run(2);
  EXPECT_GT(turned(kA), 20);
  EXPECT_EQ(waits_for(kA), "B");
  b.in.drives[0].position = 1'320'000 / 4;
  EXPECT_TRUE(sut->until([&] { return ended(kA); }));
  EXPECT_NEAR(turned(kA), 0, 1e-6);
}

// It names only one of them.
TEST_F(Shared_space, A_robot_that_comes_into_the_way_of_several_stops_all_of_them) {
  begin("MOVJ IN\n", "");
  start(kA);
  ASSERT_TRUE(sut->until([&] { return turned(kA) < 80; }));
  SpaceReport other = sut->report(kB);
  other.intruded = "C";
  other.intrusions += 2;
  const auto step = [&] {
    (*sut)[kA].in.others[0] = &other;
    (*sut)[kA].step();
  };
  step();
  EXPECT_EQ((*sut)[kA].out.state, GroupState::Moving) << "B is not in cells of A";
  other.held.fill(~std::uint64_t{0});
  other.intrusions += 2;
  step();
  EXPECT_EQ((*sut)[kA].out.error, ErrorCode::OtherRobot);
}

// They go to their places one after the other, and move together from there.
TEST_F(Shared_space, Motions_with_the_same_SYNC_begin_in_the_same_period) {
  const std::string lift = "LOOP 5\nMOVJ FAR SYNC lift SPEED 50%\nWAIT 0.2 s\nMOVJ OUT SYNC lower\nEND\n";
  begin("MOVJ FAR\nWAIT 1 s\nMOVJ OUT\n" + lift, lift);
  start(kA);
  start(kB);
  int begun = 0;
  std::array<double, 2> before{90, 90};
  std::array<bool, 2> moved{};
  bool first = true;
  ASSERT_TRUE(sut->until([&] {
    std::array<bool, 2> moves{};
    for (const std::size_t robot : {kA, kB}) {
      moves[robot] = std::abs(turned(robot) - before[robot]) > 0;
      before[robot] = turned(robot);
    }
    first = first && !moves[kB];
    if (!first) {
      EXPECT_EQ(moves[kA] && !moved[kA], moves[kB] && !moved[kB]) << "they begin in different periods";
      begun += moves[kA] && !moved[kA] ? 1 : 0;
    }
    moved = moves;
    return ended(kA) && ended(kB);
  }));
  EXPECT_EQ(begun, 10);
}

TEST_F(Shared_space, A_robot_that_is_held_is_not_ready_to_begin_with_others) {
  begin("MOVJ FAR SYNC go\n", "WAIT 1 s\nMOVJ FAR SYNC go\n");
  start(kA);
  start(kB);
  ASSERT_TRUE(sut->until([&] { return waits_for(kA) == "B"; }));
  (*sut)[kA].in.hold = true;
  run(3);
  EXPECT_EQ(waits_for(kB), "A");
  EXPECT_EQ(turned(kB), 90);
  EXPECT_EQ((*sut)[kB].out.state, GroupState::Moving) << "it is no deadlock";
  (*sut)[kA].in.hold = false;
  ASSERT_TRUE(sut->until([&] { return turned(kB) < 90; }));
  EXPECT_EQ(turned(kA), turned(kB));
  EXPECT_TRUE(sut->until([&] { return ended(kA) && ended(kB); }));
}

TEST_F(Shared_space, Three_robots_begin_together_when_the_last_one_is_ready) {
  const std::string job = kPoints + "LOOP 3\nMOVJ FAR SYNC go\nMOVJ OUT SYNC return\nEND\n";
  sut.emplace(std::vector<SharingRobot>{{"A", job},
                                        {"B", "WAIT 0.5 s\n" + job, {1400, 0, 0, 0, 0, 180}},
                                        {"C", "WAIT 1 s\n" + job, {700, 2500, 0, 0, 0, -90}}},
              4);
  ASSERT_TRUE(sut->enable());
  for (std::size_t robot = 0; robot < sut->size(); ++robot) {
    start(robot);
  }
  ASSERT_TRUE(sut->until([&] { return turned(2) < 90; }));
  for (int i = 0; i < 20000 && !(ended(0) && ended(1) && ended(2)); ++i) {
    EXPECT_EQ(turned(0), turned(1));
    EXPECT_EQ(turned(0), turned(2));
    sut->step();
  }
  EXPECT_TRUE(ended(2));
}

TEST_F(Shared_space, A_robot_waits_with_SYNC_and_keeps_the_space_of_its_motion) {
  begin("MOVJ IN SYNC go\n", "WAIT 2 s\nMOVJ IN\nMOVJ FAR SYNC go\n");
  start(kA);
  start(kB);
  ASSERT_TRUE(sut->until([&] { return waits_for(kB) == "A"; }));
  EXPECT_EQ(turned(kA), 90);
  // B needs the space of A's motion to get to its own.
  ASSERT_TRUE(sut->until([&] { return (*sut)[kB].out.state == GroupState::ErrorStop; }));
  EXPECT_THAT(message(kB), HasSubstr("this robot and A wait for each other"));
}

TEST_F(Shared_space, Robots_that_wait_at_different_SYNCs_are_named) {
  begin("MOVJ FAR SYNC one\n", "MOVJ FAR SYNC other\n");
  start(kA);
  start(kB);
  ASSERT_TRUE(sut->until(
      [&] { return (*sut)[kA].out.state == GroupState::ErrorStop || (*sut)[kB].out.state == GroupState::ErrorStop; }));
  EXPECT_EQ(turned(kA), 90);
  EXPECT_EQ(turned(kB), 90);
  const std::size_t stopped = (*sut)[kA].out.state == GroupState::ErrorStop ? kA : kB;
  EXPECT_THAT(message(stopped),
              HasSubstr(stopped == kA ? "B waits at another SYNC: other" : "A waits at another SYNC: one"));
}

TEST(Sync, Is_for_robots_that_share_their_space) {
  const auto errors = [](const std::string& job) {
    try {
      static_cast<void>(controller_of(cell_urdf(), job));
    } catch (const std::exception& wrong) {
      return std::string(wrong.what());
    }
    return std::string();
  };
  const std::string point = "POINT P = JOINT 10 0 0 0 0 0\n";
  EXPECT_THAT(errors(point + "MOVJ P SYNC lift\n"), HasSubstr("main.job:2:13: error: SYNC begins a motion together"));
  EXPECT_THAT(errors(point + "MOVJ P SYNC\n"), HasSubstr("main.job:2:12: error: expected a name"));
  EXPECT_THAT(errors(point + "MOVJ P SYNC a SYNC b\n"), HasSubstr("main.job:2:15: error: SYNC comes once"));
}

TEST_F(Shared_space, Nothing_moves_before_the_other_robot_has_reported) {
  begin("MOVJ FAR\n", "");
  SpaceReport unknown;
  Cell& a = (*sut)[kA];
  a.in.service.job = 1;
  a.ask(Service::JobStart);
  for (int i = 0; i < 200; ++i) {
    a.in.others[0] = i % 2 == 0 ? &unknown : nullptr;
    a.step();
  }
  EXPECT_EQ(turned(kA), 90);
  EXPECT_EQ(a.out.space->waits_for, "B");
  EXPECT_TRUE(sut->until([&] { return ended(kA); }));
}

// A robot that is not homed holds everything, also the cells of the tool that another one selects.
TEST_F(Shared_space, A_tool_that_is_selected_at_rest_in_cells_of_another_robot_does_not_stop_the_job) {
  begin("TOOL grip = POSE 0 0 150 RPY 0 0 0\nBODY grip = BOX -50 -50 0 50 50 150\nTOOL grip\nMOVJ FAR\n", "");
  SpaceReport everything = sut->report(kB);
  everything.held.fill(~std::uint64_t{0});
  Cell& a = (*sut)[kA];
  a.in.service.job = 1;
  a.ask(Service::JobStart);
  for (int i = 0; i < 200; ++i) {
    a.in.others[0] = &everything;
    a.step();
  }
  EXPECT_EQ(a.out.state, GroupState::Moving);
  EXPECT_EQ(a.out.tool, 1U);
  EXPECT_EQ(a.out.space->waits_for, "B");
  EXPECT_EQ(turned(kA), 90);
  EXPECT_TRUE(sut->until([&] { return ended(kA); }));
}

TEST(Robots_that_share_their_space, Need_bodies_of_links) {
  Settings settings;
  settings.name = "A";
  settings.other_robots = {"B"};
  settings.cell_box = {0, 0, 0, 1, 1, 1};
  const std::string tool =
      "TOOL grip = POSE 0 0 150 RPY 0 0 0\nBODY grip = BALL 0 0 0 RADIUS 50\n"
      "KEEPOUT table = BOX -900 -900 -90 900 900 -10\n";
  try {
    static_cast<void>(controller_of(cell_urdf(), tool, settings));
    FAIL() << "it was accepted";
  } catch (const std::exception& wrong) {
    EXPECT_THAT(wrong.what(), HasSubstr("robots that share their space need bodies; give links <collision>"));
  }
}

TEST_F(Shared_space, Robots_with_different_boxes_do_not_move) {
  begin("MOVJ FAR\n", "");
  SpaceReport other = sut->report(kB);
  other.box[0] -= 1;
  Cell& a = (*sut)[kA];
  a.in.service.job = 1;
  a.ask(Service::JobStart);
  for (int i = 0; i < 200; ++i) {
    a.in.others[0] = &other;
    a.step();
  }
  EXPECT_EQ(a.out.state, GroupState::ErrorStop);
  EXPECT_THAT(message(kA), HasSubstr("B has another cell_box"));
}

}  // namespace
}  // namespace indurop::robot
