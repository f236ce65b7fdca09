// SPDX-License-Identifier: Apache-2.0
// The robot task in a node: jobs, single axes, blocks, two robots, and what is wrong with their files.
#include <sys/syscall.h>
#include <unistd.h>

#include <csignal>

#include "robot_node.h"

namespace indurop::test {
namespace {

TEST_F(RobotNode, Drives_take_power_and_a_job_moves_them) {
  begin("POINT A = JOINT 30 10 -10 0 40 -20\nMOVJ A\nSET O8 ON\nWAIT I4 ON\nSET O8 OFF\n");
  ASSERT_EQ(serve("eOpCode: 1"), 0);
  EXPECT_EQ(state(), 1);
  const int wanted = next_request();
  set("PLC_ROBOT::ROBOT_MODULE_SERVICE", "{eOpCode: 11, nJob: 1, nRequest: " + std::to_string(wanted) + "}");
  ASSERT_TRUE(wait_until([&] { return number("PLC_ROBOT::O8") == 1; }));
  EXPECT_EQ(state(), 2);
  EXPECT_TRUE(wait_until([&] { return std::abs(joint(1) - 30) < 0.01 && std::abs(joint(6) + 20) < 0.01; }));
  set("PLC_ROBOT::I4", "1");
  EXPECT_TRUE(wait_until([&] { return state() == 1 && number("PLC_ROBOT::O8") == 0; }));
  EXPECT_EQ(number("PLC_ROBOT::ROBOT_MODULE_STATE.MotionDone"), 1);
}

// A fault in a thread of the task: the arm comes to rest and loses its power, then the module ends with the reason, and
// the others go on.
TEST_F(RobotNode, A_crash_of_its_planning_thread_stops_the_arm_and_not_the_node) {
  SKIP_CRASHES_UNDER_TSAN();
  begin("POINT A = JOINT 60 10 -10 0 40 -20\nPOINT B = JOINT -60 10 -10 0 40 -20\nLOOP\nMOVJ A\nMOVJ B\nEND\n");
  ASSERT_EQ(serve("eOpCode: 1"), 0);
  const int wanted = next_request();
  set("PLC_ROBOT::ROBOT_MODULE_SERVICE", "{eOpCode: 11, nJob: 1, nRequest: " + std::to_string(wanted) + "}");
  ASSERT_TRUE(wait_until([&] { return joint(1) > 10; }));
  const pid_t pid = run()->node_pid.load();
  const pid_t thread = thread_called(pid, "robot-plan");
  ASSERT_GT(thread, 0);
  ASSERT_EQ(::syscall(SYS_tgkill, pid, thread, SIGSEGV), 0);
  ASSERT_TRUE(wait_until([&] { return module("robot").state.load() == scheduler::ModuleState::Faulted; }));
  EXPECT_CONTAINS(std::string(module("robot").last_fault), "the thread that plans motions crashed: SIGSEGV");
  EXPECT_EQ(state(), 5);
  EXPECT_EQ(number("PLC_ROBOT::ROBOT_MODULE_STATE.nError"), 33);
  for (const char axis : std::string("123456")) {
    EXPECT_NE(static_cast<unsigned>(number(std::string("PLC_ROBOT::AXIS") + axis + "_IN.status")) & 0x6FU, 0x27U);
  }
  const std::uint64_t runs = module("io").runs.load();
  EXPECT_TRUE(runs_reach("io", runs + 20)) << "the node goes on";
}

TEST_F(RobotNode, Where_it_stands_is_written_into_its_files) {
  begin(
      "# the cell\nFRAME pallet = POSE 300 100 0 RPY 0 0 90\nPOINT P1 = JOINT 30 10 -10 0 40 -20   # above\n"
      "POINT P2 = POSE 0 0 500 RPY 180 0 0 IN pallet\n");
  ASSERT_EQ(serve("eOpCode: 1"), 0);
  ASSERT_EQ(serve("eOpCode: 8, dTarget: [10, -20, 15, 5, 60, -30]"), 0);
  ASSERT_TRUE(wait_until([&] { return std::abs(joint(1) - 10) < 0.001 && std::abs(joint(6) + 30) < 0.001; }));
  for (const char* point : {"P1", "P2", "P3"}) {
    const Outcome taught = indurop({"robot", "teach", point});
    EXPECT_EQ(taught.code, 0) << taught.err;
    EXPECT_THAT(taught.err, testing::HasSubstr("test.job:"));
  }
  EXPECT_THAT(indurop({"robot", "teach", "CORNER", "--in", "palet"}).err,
              testing::HasSubstr("there is no frame 'palet'"));
  std::ifstream file(folder() / "test.job");
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  EXPECT_THAT(text, testing::StartsWith("# the cell\nFRAME pallet = POSE 300 100 0 RPY 0 0 90\nPOINT P1 = JOINT "));
  EXPECT_THAT(text, testing::HasSubstr("   # above\nPOINT P2 = POSE "));
  EXPECT_THAT(text, testing::HasSubstr(" IN pallet\nPOINT P3 = JOINT "));
  EXPECT_THAT(indurop({"robot", "points", "-o", "csv"}).out, testing::HasSubstr("P3,JOINT 1"));

  // From elsewhere it goes to each of them, and is where it was taught.
  ASSERT_EQ(indurop({"restart", "robot"}).code, 0);
  ASSERT_TRUE(wait_until([&] { return number("PLC_ROBOT::ROBOT_MODULE_STATE.nAXESGROUP") == 6 && state() != 2; }));
  ASSERT_EQ(serve("eOpCode: 1"), 0);
  for (int point = 1; point <= 3; ++point) {
    ASSERT_EQ(serve("eOpCode: 8, dTarget: [0, 0, 0, 0, 90, 0]"), 0);
    ASSERT_EQ(serve("eOpCode: 5, p_Target: " + std::to_string(point)), 0);
    EXPECT_TRUE(wait_until([&] { return std::abs(joint(1) - 10) < 0.01 && std::abs(joint(6) + 30) < 0.01; })) << point;
  }
}

TEST_F(RobotNode, Its_requests_are_no_parameters) {
  begin("");
  const Outcome saved = indurop({"recipe", "save", "all"});
  ASSERT_EQ(saved.code, 0) << saved.err;
  EXPECT_THAT(indurop({"recipe", "list", "-o", "json"}).out, testing::HasSubstr("\"values\":1,")) << "the override";
  ASSERT_EQ(indurop({"lock", "tune"}).code, 0);
  for (const char* request : {"ROBOT_JOG", "ROBOT_MODE", "ROBOT_ANSWER", "ROBOT_PAUSE", "ROBOT_GUIDE"}) {
    const Outcome refused = indurop({"set", std::string("PLC_ROBOT::") + request, "{}"});
    EXPECT_NE(refused.code, 0) << request;
    EXPECT_THAT(refused.err, testing::HasSubstr("only parameters may be written")) << request;
  }
  EXPECT_NE(indurop({"set", "PLC_ROBOT::ROBOT_HOLD", "1"}).code, 0);
  EXPECT_EQ(indurop({"set", "PLC_ROBOT::ROBOT_OVERRIDE", "50"}).code, 0);
  EXPECT_EQ(number("PLC_ROBOT::ROBOT_OVERRIDE"), 50);
  EXPECT_EQ(indurop({"lock", "none"}).code, 0);
}

TEST_F(RobotNode, Jobs_are_read_again_at_standstill) {
  begin("POINT A = JOINT 30 10 -10 0 40 -20\nMOVJ A\nSET O8 ON\n");
  ASSERT_EQ(serve("eOpCode: 1"), 0);
  ASSERT_EQ(serve("eOpCode: 11, nJob: 1"), 0);
  const std::string other =
      "POINT A = JOINT -20 10 -10 0 40 15\nPOINT P1 = JOINT 5 0 0 0 90 0\nMOVJ A\nSET O9 ON\nSET O8 OFF\n";
  write("test.job", other);
  const Outcome read = indurop({"robot", "reload"});
  EXPECT_EQ(read.code, 0) << read.err;
  EXPECT_EQ(state(), 1);  // its drives have power
  ASSERT_EQ(serve("eOpCode: 11, nJob: 1"), 0);
  EXPECT_NEAR(joint(1), -20, 0.01);
  EXPECT_EQ(number("PLC_ROBOT::O9"), 1);
  EXPECT_EQ(number("PLC_ROBOT::O8"), 0);

  const std::pair<std::string, const char*> wrong[] = {{"MOVJ NOWHERE\n", "test.job:1:6: error: "},
                                                       {other + "SET O99 ON\n", "O99"}};
  for (const auto& [job, said] : wrong) {
    write("test.job", job);
    const Outcome refused = indurop({"robot", "reload"});
    EXPECT_NE(refused.code, 0);
    EXPECT_THAT(refused.err, testing::HasSubstr(said));
    ASSERT_EQ(serve("eOpCode: 5, p_Target: 1"), 0);
    EXPECT_NEAR(joint(1), 5, 0.01);
    ASSERT_EQ(serve("eOpCode: 11, nJob: 1"), 0);
    EXPECT_NEAR(joint(1), -20, 0.01);
  }
  set("PLC_ROBOT::ROBOT_MODULE_SERVICE",
      "{eOpCode: 5, p_Target: 1, t_speed: 1, nRequest: " + std::to_string(next_request()) + "}");
  ASSERT_TRUE(wait_until([&] { return state() == 2; }));
  EXPECT_THAT(indurop({"robot", "reload"}).err, testing::HasSubstr("only at standstill"));
}

TEST_F(RobotNode, A_hand_at_a_terminal_moves_it_and_is_missed_when_it_is_killed) {
  begin("");
  ASSERT_EQ(serve("eOpCode: 1"), 0);
  ASSERT_EQ(serve("eOpCode: 8, dTarget: [0, 0, 0, 0, 90, 0]"), 0);
  const double height = number("PLC_ROBOT::ROBOT_ARM.position[2]");
  const Outcome up = indurop({"robot", "jog", "z+", "--speed", "20", "--for", "1s"});
  EXPECT_EQ(up.code, 0) << up.err;
  EXPECT_TRUE(wait_until([&] { return state() == 1; }));
  EXPECT_GT(number("PLC_ROBOT::ROBOT_ARM.position[2]"), height + 10);
  EXPECT_LT(number("PLC_ROBOT::ROBOT_ARM.position[2]"), height + 20.0 / 100 * 250 * 1.5);
  EXPECT_EQ(indurop({"robot", "jog", "J7+"}).code, 2);
  EXPECT_EQ(indurop({"robot", "jog", "up"}).code, 2);

  Program hand({INDUROP_PROGRAM, "robot", "jog", "J1+", "--speed", "30", "--node", node()}, environment());
  ASSERT_TRUE(wait_until([&] { return joint(1) > 1; }));
  hand.kill();
  EXPECT_TRUE(wait_until([&] { return state() == 1; }));
  EXPECT_EQ(number("PLC_ROBOT::ROBOT_JOG.bEnable"), 1);  // it was not released
  const double rests = joint(1);
  EXPECT_EQ(indurop({"robot", "jog", "J1-", "--speed", "30", "--for", "500ms"}).code, 0);
  EXPECT_TRUE(wait_until([&] { return joint(1) < rests - 0.5 && state() == 1; }));
}

TEST_F(RobotNode, Manual_mode_moves_it_slowly_and_only_with_the_enabling_switch) {
  begin("FRAME pallet = POSE 300 100 0 RPY 0 0 90\n");
  set("PLC_ROBOT::ROBOT_MODE", "{eMode: 2}");
  ASSERT_TRUE(wait_until([&] { return number("PLC_ROBOT::ROBOT_ARM.eMode") == 2; }));
  ASSERT_EQ(serve("eOpCode: 1"), 0);
  EXPECT_EQ(serve("eOpCode: 8, dTarget: [0, 0, 0, 0, 90, 0]"), 26) << "ROBOT_ERR_ENABLING";
  set("PLC_ROBOT::ROBOT_MODE.bEnable", "1");
  ASSERT_TRUE(wait_until([&] { return number("PLC_ROBOT::ROBOT_ARM.bMayMove") == 1; }));
  EXPECT_EQ(serve("eOpCode: 8, dTarget: [0, 0, 0, 0, 90, 0]"), 0);
  const double from = number("PLC_ROBOT::ROBOT_ARM.position[1]");
  EXPECT_EQ(indurop({"robot", "jog", "x+", "--frame", "pallet", "--speed", "40", "--for", "500ms"}).code, 0);
  ASSERT_TRUE(wait_until([&] { return state() == 1; }));
  EXPECT_GT(number("PLC_ROBOT::ROBOT_ARM.position[1]"), from + 5) << "its x is the base's y";
  const Outcome unknown = indurop({"robot", "jog", "x+", "--frame", "palet"});
  EXPECT_EQ(unknown.code, 2);
  EXPECT_THAT(unknown.err, testing::HasSubstr("there is no work frame 'palet': base, tool, world, pallet"));

  const int wanted = next_request();
  set("PLC_ROBOT::ROBOT_MODULE_SERVICE",
      "{eOpCode: 8, dTarget: [160, 0, 0, 0, 90, 0], nRequest: " + std::to_string(wanted) + "}");
  ASSERT_TRUE(wait_until([&] { return number("PLC_ROBOT::ROBOT_ARM.tool_speed") > 50; }));
  set("PLC_ROBOT::ROBOT_MODE", "{eMode: 1, bEnable: 1}");
  EXPECT_TRUE(wait_until([&] { return state() == 1; }));
  EXPECT_EQ(number("PLC_ROBOT::ROBOT_MODULE_STATE.nError"), 27) << "ROBOT_ERR_MODE";
}

TEST_F(RobotNode, The_emergency_stop_is_reported_in_its_tick_and_the_robot_brakes_on_its_path) {
  begin("");
  ASSERT_EQ(serve("eOpCode: 1"), 0);
  const int wanted = next_request();
  set("PLC_ROBOT::ROBOT_MODULE_SERVICE",
      "{eOpCode: 8, t_speed: 20, dTarget: [160, 80, 0, 0, 0, 0], nRequest: " + std::to_string(wanted) + "}");
  ASSERT_TRUE(wait_until([&] { return joint(1) > 10; }));
  const double stops = number("PLC_ROBOT::EMERGENCY_STOP.nCount");  // maybe one from before I14 became 1
  set("PLC_ROBOT::I14", "0");
  ASSERT_TRUE(wait_until([&] { return state() == 5; }));
  EXPECT_EQ(number("PLC_ROBOT::EMERGENCY_STOP.nCount"), stops + 1);
  EXPECT_GT(number("PLC_ROBOT::EMERGENCY_STOP.tReaction"), 0);
  EXPECT_EQ(number("PLC_ROBOT::ROBOT_MODULE_STATE.nError"), 14);
  EXPECT_LT(joint(1), 159);
  EXPECT_NEAR(joint(2), joint(1) / 2, 0.5);
  ASSERT_TRUE(
      wait_until([&] { return (static_cast<unsigned>(number("PLC_ROBOT::AXIS1_IN.status")) & 0x6FU) != 0x27; }));
  EXPECT_EQ(serve("eOpCode: 1"), 14) << "no power as long as the circuit is open";
  set("PLC_ROBOT::I14", "1");
  ASSERT_TRUE(wait_until([&] { return number("PLC_ROBOT::EMERGENCY_STOP.bActive") == 0; }));
  EXPECT_EQ(serve("eOpCode: 3"), 0);
  EXPECT_EQ(serve("eOpCode: 1"), 0);
  EXPECT_EQ(state(), 1);
}

TEST_F(RobotNode, Single_axes_and_the_request_of_the_chapter) {
  begin("POINT P1 = JOINT 10 0 0 0 0 0\n");
  set("PLC_ROBOT::ROBOT_MODULE_SERVICE.eOpCode", "1");
  set("PLC_ROBOT::msgRobotServiceEditNum", "1");
  ASSERT_TRUE(wait_until([&] { return number("PLC_ROBOT::msgRobotServiceEditNum") == 0; }));
  EXPECT_EQ(state(), 1);
  set("PLC_ROBOT::AXIS_SERVICE[2]", "{nRequest: 1, eOpCode: 4, dPosition: -15, dVelocity: 60}");
  ASSERT_TRUE(wait_until([&] { return number("PLC_ROBOT::AXIS_STATE[2].nDone") == 1; }));
  EXPECT_TRUE(wait_until([&] { return std::abs(joint(3) + 15) < 0.01; }));
}

TEST_F(RobotNode, Every_block_of_single_axes) {
  run_blocks("axis_blocks");
}

// Its first scan is before that of the robot, which does not carry out what stands there when it starts.
TEST_F(RobotNode, Every_block_of_single_axes_before_the_robot) {
  run_blocks("axis_blocks", 1);
}

TEST_F(RobotNode, Every_block_of_axes_that_follow_others) {
  run_blocks("sync_blocks");
}

TEST_F(RobotNode, Every_block_that_couples_an_axis_and_the_path) {
  run_blocks("path_blocks", 3, with_feeder());
}

TEST_F(RobotNode, Every_block_of_the_group) {
  run_blocks("group_blocks");
}

TEST_F(RobotNode, Every_use_of_the_block_that_presses) {
  run_blocks("press_blocks");
}

TEST_F(RobotNode, Every_block_of_products_that_move) {
  run_blocks("track_blocks");
}

// A post between two places, and a wall that no way leads around.
const char* const kPostAndWall =
    "KEEPOUT post = CYLINDER 750 0 0 750 0 700 RADIUS 60\nKEEPOUT left = BOX -100 210 0 -60 1500 3000\n"
    "KEEPOUT right = BOX -100 -1500 0 -60 -210 3000\nKEEPOUT above = BOX -100 -210 700 -60 210 3000\n"
    "POINT A = JOINT 50 30 -20 0 80 0\nMOVJ A SPEED 20%\n";

TEST_F(RobotNode, Every_use_of_the_block_that_moves_around_obstacles) {
  run_blocks("free_blocks", 3, kPostAndWall);
}

// With the planning thread.
TEST_F(RobotNode, A_force_holds_the_block_that_moves_around_obstacles) {
  auto all = modules(kPostAndWall);
  all.push_back({.file = std::string(BLOCKS_DIR) + "/free_blocks.so", .name = "plc", .period = "5ms", .priority = 3});
  start_and_wait(all);
  ASSERT_TRUE(wait_until([&] { return number("free_blocks::stage") >= 3; }));
  ASSERT_EQ(indurop({"force", "PLC_ROBOT::ROBOT_HOLD", "1"}).code, 0);
  ASSERT_TRUE(wait_until([&] { return number("PLC_ROBOT::ROBOT_ARM.override_now") == 0; }));
  const auto set_point = [&] { return number("PLC_ROBOT::ROBOT_ARM.command[0]"); };
  const double held = set_point();
  const double stage = number("free_blocks::stage");
  const double scans = number("free_blocks::scans");
  ASSERT_TRUE(wait_until([&] { return number("free_blocks::scans") > scans + 200; }));
  EXPECT_EQ(set_point(), held);
  EXPECT_EQ(number("free_blocks::stage"), stage);
  ASSERT_EQ(indurop({"unforce", "PLC_ROBOT::ROBOT_HOLD"}).code, 0);
  set("PLC_ROBOT::ROBOT_HOLD", "0");
  EXPECT_TRUE(wait_until([&] { return number("free_blocks::stage") == 100; }, std::chrono::seconds(60)))
      << number("free_blocks::stage") << indurop({"get", "PLC_ROBOT::ROBOT_JOB"}).out;
  EXPECT_EQ(indurop({"get", "free_blocks::ok_Stop"}).out, "true\n");
  EXPECT_EQ(indurop({"get", "free_blocks::ok_NoWay"}).out, "true\n");
}

TEST_F(RobotNode, Two_robots_in_one_node_move_independently) {
  start_and_wait(two_robots());
  set("PLC_ROBOT::I14", "1");
  set("PLC_ROBOT::I15", "1");
  ASSERT_TRUE(wait_until([&] { return number("PLC_ROBOT::EMERGENCY_STOP.bActive") == 0; }));
  const std::string service = "::ROBOT_MODULE_SERVICE";
  for (const std::string robot : {"PLC_ROBOT", "PLC_ROBOT2"}) {
    set(robot + service, "{eOpCode: 1, nRequest: 1}");
    ASSERT_TRUE(wait_until([&] { return number(robot + "::ROBOT_MODULE_STATE.eState") == 1; })) << robot;
  }
  set("PLC_ROBOT2" + service, "{eOpCode: 11, nJob: 1, nRequest: 2}");
  ASSERT_TRUE(wait_until([&] { return number("PLC_ROBOT2::O8") == 1; }));
  EXPECT_NEAR(number("PLC_ROBOT2::AXIS7_IN.position"), 25 * 1320000 / 360.0, 50);
  EXPECT_EQ(number("PLC_ROBOT2::ROBOT_MODULE_STATE.nAXESGROUP"), 7);
  EXPECT_EQ(number("PLC_ROBOT::AXIS1_IN.position"), 0) << "the other one has not moved";
  set("PLC_ROBOT" + service, "{eOpCode: 11, nJob: 1, nRequest: 2}");
  EXPECT_TRUE(wait_until([&] { return std::abs(joint(1) - 30) < 0.01; }));
  set("PLC_ROBOT::I14", "0");
  for (const std::string robot : {"PLC_ROBOT", "PLC_ROBOT2"}) {
    EXPECT_TRUE(wait_until([&] { return number(robot + "::ROBOT_MODULE_STATE.eState") == 5; })) << robot;
  }
}

TEST_F(RobotNode, Two_robots_in_a_simulation_are_the_same_on_every_run) {
  auto all = two_robots();
  all.push_back({.file = BOTH_ROBOTS, .name = "plc", .period = "10ms", .priority = 4});
  const auto everything = [&] {
    const Outcome outcome = run_to_end(all, {"--sim", "--until", "10s"});
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    return indurop({"vars", "-o", "json"}).out;
  };
  const std::string first = everything();
  EXPECT_NEAR(joint(1), 30, 0.01);
  EXPECT_NEAR(number("PLC_ROBOT2::AXIS7_IN.position"), 25 * 1320000 / 360.0, 50);
  EXPECT_EQ(number("PLC_ROBOT::ROBOT_JOB.nCycles"), 1);
  EXPECT_EQ(number("PLC_ROBOT2::ROBOT_JOB.nCycles"), 1);
  EXPECT_EQ(first, everything());
}

TEST_F(RobotNode, A_robot_waits_until_another_one_has_left_its_way) {
  start_and_wait(robots_that_share("POINT OUT = JOINT 90 0 0 0 0 0\nWAIT PLC_ROBOT::I4 ON\nMOVJ OUT\n"));
  set("PLC_ROBOT::I14", "1");
  set("PLC_ROBOT::I15", "1");
  ASSERT_TRUE(wait_until([&] { return number("PLC_ROBOT::EMERGENCY_STOP.bActive") == 0; }));
  const std::string service = "::ROBOT_MODULE_SERVICE";
  for (const std::string robot : {"PLC_ROBOT", "PLC_ROBOT2"}) {
    set(robot + service, "{eOpCode: 1, nRequest: 1}");
    ASSERT_TRUE(wait_until([&] { return number(robot + "::ROBOT_MODULE_STATE.eState") == 1; })) << robot;
    set(robot + service, "{eOpCode: 11, nJob: 1, nRequest: 2}");
  }
  const auto waits_for = [&] { return indurop({"get", "PLC_ROBOT2::ROBOT_SPACE.cWaitsFor"}).out; };
  ASSERT_TRUE(wait_until([&] { return waits_for() == "\"PLC_ROBOT\"\n"; })) << waits_for();
  EXPECT_EQ(number("PLC_ROBOT2::AXIS1_IN.position"), 0);
  EXPECT_EQ(number("PLC_ROBOT2::ROBOT_SPACE.bStands"), 1);
  set("PLC_ROBOT::I4", "1");
  EXPECT_TRUE(wait_until([&] { return number("PLC_ROBOT2::O8") == 1; }));
  EXPECT_GT(joint(1), 60) << "the other one went first";
  EXPECT_EQ(waits_for(), "\"\"\n");
}

TEST_F(RobotNode, Robots_that_share_their_space_do_so_in_a_simulation_in_the_same_way_on_every_run) {
  auto all = robots_that_share("POINT OUT = JOINT 90 0 0 0 0 0\nWAIT 1 s\nMOVJ OUT\n");
  all.push_back({.file = BOTH_ROBOTS, .name = "plc", .period = "10ms", .priority = 4});
  const auto everything = [&] {
    const Outcome outcome = run_to_end(all, {"--sim", "--until", "10s"});
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    return indurop({"vars", "-o", "json"}).out;
  };
  const std::string first = everything();
  EXPECT_EQ(number("PLC_ROBOT2::O8"), 1);
  EXPECT_EQ(number("PLC_ROBOT::ROBOT_JOB.nCycles"), 1);
  EXPECT_EQ(first, everything());
}

TEST_F(RobotNode, More_axes_than_variables_are_said_before_the_start) {
  auto wrong = modules("POINT A = JOINT 0 0 0 0 0 0 0\n");
  copy(SEVEN_AXES, "robot.urdf");
  wrong[1].properties = {{"urdf", "robot.urdf"}, {"jobs", "test.job"}};
  const Outcome outcome = run_to_end(wrong, {});
  EXPECT_NE(outcome.code, 0);
  EXPECT_NE(outcome.err.find("the arm has 7 axes, the .glb has variables of 6"), std::string::npos) << outcome.err;
}

TEST_F(RobotNode, What_is_wrong_with_robot_and_jobs_is_said_before_the_start) {
  auto wrong = modules("POINT A = JOINT 0 0 0 0 400 0\nMOVJ B\nSET O8 ON\n");
  wrong[1].properties[0].second = "other.urdf";
  const Outcome outcome = run_to_end(wrong);
  EXPECT_EQ(outcome.code, 1);
  const std::string said = outcome.out + outcome.err;
  EXPECT_CONTAINS(said, "test.job:2:6: error: there is no point 'B'");
  EXPECT_CONTAINS(said, "other.urdf:1:1: error: this robot description (property urdf) cannot be read");
  const Outcome unknown = run_to_end(modules("SET O77 ON\n"));
  EXPECT_EQ(unknown.code, 1);
  EXPECT_CONTAINS(unknown.out + unknown.err,
                  "jobs name variables that are no numbers or bools of this node: O77; indurop check says where");
}

}  // namespace
}  // namespace indurop::test
