// SPDX-License-Identifier: Apache-2.0
#include "control/robot/job/job.h"

#include <gtest/gtest.h>

#include "control/robot/job/runner.h"

namespace indurop::robot {
namespace {

ReadJobs parse(const std::string& text) {
  return parse_jobs({{"a.job", text}});
}

JobBook good(const std::string& text) {
  auto [book, errors] = parse(text);
  EXPECT_TRUE(errors.empty()) << base::to_text(errors);
  return book;
}

class JobRecorder final : public Signals, public MotionPort {
 public:
  double read(std::size_t index) noexcept override { return values[index]; }
  void write(std::size_t index, double value) noexcept override { values[index] = value; }
  [[nodiscard]] bool ready() const noexcept override { return true; }
  [[nodiscard]] bool settled() const noexcept override { return at_rest; }
  Fault move(const MoveCommand& command) noexcept override {
    moves.push_back(command);
    return answer;
  }
  double values[8] = {};
  std::vector<MoveCommand> moves;
  Fault answer;
  bool at_rest = true;
};

TEST(Job, Points_speeds_and_zones_reach_the_motion) {
  const JobBook book = good(
      "POINT A = JOINT 0 10 20 30 40 50   # degrees\n"
      "point B = POSE 500, 0, 300 RPY 180 0 0 posture 4\n"
      "SPEED 50%\nZONE 20 mm\nMOVJ A\nSPEED 250 mm/s\nACC 30%\nMOVL B\nMOVC A B\n");
  JobRunner sut(book);
  JobRecorder port;
  sut.start(0);
  sut.step(0.01, port, port);
  ASSERT_EQ(port.moves.size(), 3U);
  EXPECT_NEAR(port.moves[0].target.joints[5], radians(50), 1e-12);
  EXPECT_DOUBLE_EQ(port.moves[0].speed, 0.5);
  EXPECT_DOUBLE_EQ(port.moves[0].zone, 0.02);
  EXPECT_DOUBLE_EQ(port.moves[1].tool_speed, 0.25);
  EXPECT_DOUBLE_EQ(port.moves[0].acceleration, 1);
  EXPECT_DOUBLE_EQ(port.moves[1].acceleration, 0.3);
  EXPECT_EQ(port.moves[1].target.posture, std::uint8_t{4});
  EXPECT_DOUBLE_EQ(port.moves[1].target.pose.position.x(), 0.5);
  EXPECT_EQ(port.moves[2].move, Move::Circle);
  EXPECT_FALSE(port.moves[2].mid.is_pose);
  EXPECT_EQ(sut.report().state, JobState::Ended);
}

TEST(Job, A_free_motion_has_a_seed_and_a_time) {
  const JobBook book = good(
      "POINT A = JOINT 0 10 20 30 40 50\nZONE 10 mm\nSPEED 100 mm/s\nMOVE FREE TO A\n"
      "POINT B = POSE 500 0 300 RPY 180 0 0\nMOVE FREE TO B OFFSET 0, 0, 5 SEED 7 WITHIN 500 ms SPEED 50%\n");
  JobRunner sut(book);
  JobRecorder port;
  sut.start(0);
  sut.step(0.01, port, port);
  ASSERT_EQ(port.moves.size(), 2U);
  for (const MoveCommand& move : port.moves) {
    EXPECT_EQ(move.move, Move::Free);
    EXPECT_EQ(move.zone, 0);
    EXPECT_EQ(move.tool_speed, 0);
  }
  EXPECT_EQ(port.moves[0].seed, 0U);
  EXPECT_EQ(port.moves[0].within, 10);
  EXPECT_EQ(port.moves[0].speed, 1);
  EXPECT_EQ(port.moves[1].seed, 7U);
  EXPECT_EQ(port.moves[1].within, 0.5);
  EXPECT_EQ(port.moves[1].speed, 0.5);
  EXPECT_TRUE(port.moves[1].target.is_pose);
}

TEST(Job, A_spline_is_a_motion_for_each_of_its_points) {
  const JobBook book = good(
      "POINT A = JOINT 0 10 20 30 40 50\nPOINT B = POSE 500 0 300 RPY 180 0 0\nMOVS A B, A\nMOVJ A STRAIGHT\nMOVJ A\n");
  JobRunner sut(book);
  JobRecorder port;
  sut.start(0);
  sut.step(0.01, port, port);
  ASSERT_EQ(port.moves.size(), 5U);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(port.moves[i].move, Move::Spline);
    EXPECT_EQ(port.moves[i].more, i < 2);
    EXPECT_FALSE(port.moves[i].straight);
  }
  EXPECT_TRUE(port.moves[1].target.is_pose);
  EXPECT_TRUE(port.moves[3].straight);
  EXPECT_FALSE(port.moves[4].straight);
}

TEST(Job, Signals_loops_jumps_and_calls) {
  const auto [book, errors] =
      parse_jobs({{"main.job",
                   "LOOP 3\n  CALL count\n  LOOP 2\n    CALL count\n  END\nEND\n"
                   "LABEL again\nIF I0 >= 9 GOTO out\nCALL count\nGOTO again\nLABEL out\nSET O1 = -2.5\n"},
                  {"folder/count.job", "IF O0 GOTO on\nSET O0 ON\nGOTO out\nLABEL on\nSET O0 OFF\nLABEL out\n"}});
  ASSERT_TRUE(errors.empty()) << base::to_text(errors);
  ASSERT_EQ(book.signals, (std::vector<std::string>{"I0", "O1", "O0"}));
  JobRunner sut(book);
  JobRecorder port;
  port.values[0] = 9;
  sut.start(0);
  sut.step(0.01, port, port);
  EXPECT_EQ(sut.report().state, JobState::Ended);
  EXPECT_EQ(port.values[2], 1);  // switched nine times
  EXPECT_DOUBLE_EQ(port.values[1], -2.5);
}

TEST(Job, Waits_for_rest_signals_and_time) {
  const JobBook book = good("SET O0 ON\nWAIT I1 OFF\nWAIT 0.03s\nSET O0 OFF\n");
  JobRunner sut(book);
  JobRecorder port;
  port.at_rest = false;
  sut.start(0);
  sut.step(0.01, port, port);
  EXPECT_EQ(port.values[0], 0);
  port.at_rest = true;
  port.values[1] = 1;
  sut.step(0.01, port, port);
  EXPECT_EQ(port.values[0], 1);
  EXPECT_EQ(sut.report().state, JobState::Waits);
  EXPECT_EQ(sut.report().line, 2U);
  port.values[1] = 0;
  int periods = 0;
  for (; port.values[0] == 1 && periods < 100; ++periods) {
    sut.step(0.01, port, port);
  }
  EXPECT_EQ(periods, 4);
}

TEST(Job, A_wait_that_takes_too_long_names_its_line) {
  const JobBook book = good("\nWAIT I1 TIMEOUT 50 ms\n");
  JobRunner sut(book);
  JobRecorder port;
  sut.start(0);
  for (int i = 0; i < 10; ++i) {
    sut.step(0.01, port, port);
  }
  EXPECT_EQ(sut.report().state, JobState::Failed);
  EXPECT_STREQ(sut.report().message, "a.job:2: the condition did not become true in time");
}

TEST(Job, A_motion_that_fails_names_its_line) {
  const JobBook book = good("POINT A = JOINT 0 0 0 0 0 0\n\nMOVL A\n");
  JobRunner sut(book);
  JobRecorder port;
  port.answer = {ErrorCode::Unreachable};
  sut.start(0);
  sut.step(0.01, port, port);
  EXPECT_STREQ(sut.report().message, "a.job:3: the target is out of reach");
}

TEST(Job, Endless_loops_and_recursion_do_not_hang) {
  const JobBook loop = good("LOOP\nSET O0 ON\nEND\n");
  JobRunner sut(loop);
  JobRecorder port;
  sut.start(0);
  sut.step(0.01, port, port);
  EXPECT_TRUE(sut.running());
  const JobBook recursion = good("CALL a\n");
  JobRunner deep(recursion);
  deep.start(0);
  deep.step(0.01, port, port);
  EXPECT_STREQ(deep.report().message, "a.job:1: jobs call each other too deep; does one call itself without end?");
}

TEST(Job, Numbered_points_are_found_by_their_number) {
  const JobBook book =
      good("POINT P7 = JOINT 0 0 0 0 0 0\nPOINT P = JOINT 1 0 0 0 0 0\nPOINT P12 = JOINT 2 0 0 0 0 0\n");
  EXPECT_EQ(book.numbered_point(7), 0);
  EXPECT_EQ(book.numbered_point(12), 2);
  EXPECT_EQ(book.numbered_point(8), -1);
  EXPECT_EQ(book.numbered_point(4000000000U), -1);
}

struct Bad {
  const char* text;
  const char* error;
};

class JobErrorsTest : public testing::TestWithParam<Bad> {};

TEST_P(JobErrorsTest, Name_place_and_cure) {
  const auto errors = parse(GetParam().text).diagnostics;
  ASSERT_FALSE(errors.empty());
  EXPECT_EQ(base::to_string(errors[0]), GetParam().error);
}

INSTANTIATE_TEST_SUITE_P(
    Golden, JobErrorsTest,
    testing::Values(
        Bad{"MOVE A\n",
            "a.job:1:6: error: a motion around obstacles is MOVE FREE TO P; others are MOVJ, MOVL, MOVC and MOVS"},
        Bad{"POINT A = JOINT 0 0 0 0 0 0\nMOVE FREE TO A SEED 1.5\n",
            "a.job:2:21: error: a seed is a whole number from 0 to 4294967295"},
        Bad{"POINT A = JOINT 0 0 0 0 0 0\nMOVE FREE TO A WITHIN 0 s\n",
            "a.job:2:23: error: a search for a way may take up to 600 s, and more than 0"},
        Bad{"POINT A = JOINT 0 0 0 0 0 0\nMOVJ A WITHIN 2 s\n",
            "a.job:2:8: error: unexpected 'WITHIN'; one statement per line"},
        Bad{"FLY A\n",
            "a.job:1:1: error: unknown statement 'FLY'; known are POINT, FRAME, TOOL, LOAD, BODY, KEEPOUT, PARAM, "
            "VAR, "
            "SPEED, ACC, ZONE, MOVJ, MOVL, MOVC, MOVS, MOVE FREE TO, SEARCH, WEAVE, CORRECT, PRESS, TRACK, PUSH, "
            "FOLLOW, SET, "
            "PULSE, WAIT, "
            "ASK, "
            "CALL, "
            "ON, "
            "OFF, RETURN, RAISE, "
            "MESSAGE, "
            "LABEL, GOTO, IF, ELSEIF, ELSE, WHILE, FOR, LOOP, EXIT, SWITCH, CASE, DEFAULT, TRY, RECOVER and END"},
        Bad{"  MOVJ ABOV\nPOINT ABOVE = JOINT 0 0 0 0 0 0\n",
            "a.job:1:8: error: there is no point 'ABOV'; did you mean 'ABOVE'?"},
        Bad{"MOVS A\nPOINT A = JOINT 0 0 0 0 0 0\n",
            "a.job:1:1: error: a spline goes through two points or more; MOVL goes to one"},
        Bad{"POINT A = JOINT 0 0 0 0 0 0\nMOVS A 5\n",
            "a.job:2:8: error: expected the name of a point of the spline, found '5'"},
        Bad{"MOVJ\n", "a.job:1:5: error: expected the name of a point, found the end of the line"},
        Bad{"POINT A = JOINT 1 2 3\n",
            "a.job:1:22: error: expected 6 numbers: the angles of the six joints in degrees; "
            "found the end of the line as number 4"},
        Bad{"POINT A = POSE 1 2 3\n",
            "a.job:1:21: error: expected RPY and roll, pitch and yaw in degrees, found the end of the line"},
        Bad{"POINT A = JOINT 1 2 3 4 5 6\nPOINT A = JOINT 1 2 3 4 5 6\n",
            "a.job:2:7: error: there is already a point 'A' at a.job:1"},
        Bad{"POINT A = POSE 500 0 300 RPY 180 0 0 POSTURE 3.7\n",
            "a.job:1:46: error: a posture is a whole number from 0 to 7: 1 over the back, 2 other elbow, 4 wrist "
            "turned "
            "over, added"},
        Bad{"SPEED 120%\n", "a.job:1:7: error: a speed is above 0 and at most 100 %"},
        Bad{"SPEED 20 km/h\n", "a.job:1:10: error: expected % or mm/s, found 'km'"},
        Bad{"ZONE -1\n", "a.job:1:6: error: a zone is from 0 (stop at the point) to 1000 mm"},
        Bad{"ACC 0%\n", "a.job:1:5: error: an acceleration is from 1 to 100 % of the full one"},
        Bad{"ACC 101%\n", "a.job:1:5: error: an acceleration is from 1 to 100 % of the full one"},
        Bad{"ACC 2 m/s\n", "a.job:1:7: error: expected %, found 'm'"},
        Bad{"ACC\n", "a.job:1:4: error: expected the acceleration, 50%, found the end of the line"},
        Bad{"WAIT 5\n", "a.job:1:7: error: expected s or ms, found the end of the line"},
        Bad{"WAIT I2 ON now\n", "a.job:1:12: error: unexpected 'now'; one statement per line"},
        Bad{"GOTO nowhere\n", "a.job:1:6: error: there is no label 'nowhere'"},
        Bad{"LABEL a\nLABEL a\n", "a.job:2:7: error: there is already a label 'a' in line 1"},
        Bad{"LOOP 2\n", "a.job:1:1: error: LOOP without END"},
        Bad{"END\n", "a.job:1:1: error: END without LOOP, IF, WHILE, FOR, SWITCH or TRY"},
        Bad{"LOOP 0\nEND\n",
            "a.job:1:6: error: a LOOP runs a whole number of times, from 1; without a number it runs for ever"},
        Bad{"CALL b\n", "a.job:1:6: error: there is no job 'b'"},
        Bad{"SET 5 ON\n", "a.job:1:5: error: expected the name of a variable, found '5'"},
        Bad{"IF I0 = 3 GO on\n", "a.job:1:11: error: unexpected 'GO'; one statement per line"},
        Bad{"SET O1 $\n", "a.job:1:8: error: expected ON, OFF or the value, found '$'"}));

TEST(Job, All_errors_at_once) {
  EXPECT_EQ(parse("MOVJ A\nFOO\nSPEED 0%\n").diagnostics.size(), 3U);
}

}  // namespace
}  // namespace indurop::robot
