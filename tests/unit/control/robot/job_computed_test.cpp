// SPDX-License-Identifier: Apache-2.0
// Points and frames that jobs compute, offsets that turn, and settings on the line of a motion. Compared with matrices
// made of turns about single axes.
#include <gmock/gmock.h>

#include <cmath>
#include <random>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "job_world.h"

namespace indurop::robot {
namespace {

using testing::HasSubstr;
using Matrix = Eigen::Matrix4d;

Matrix turn(int axis, double angle) {
  Matrix m = Matrix::Identity();
  const int a = (axis + 1) % 3;
  const int b = (axis + 2) % 3;
  m(a, a) = m(b, b) = std::cos(angle * kPi / 180);
  m(b, a) = std::sin(angle * kPi / 180);
  m(a, b) = -m(b, a);
  return m;
}

// Of "POSE x y z RPY r p y": about x, then y, then z of the fixed frame.
Matrix matrix(double x, double y, double z, double roll, double pitch, double yaw) {
  Matrix m = turn(2, yaw) * turn(1, pitch) * turn(0, roll);
  m.topRightCorner<3, 1>() = Vec3(x, y, z);
  return m;
}

Matrix matrix(const Pose& pose) {
  Matrix m = Matrix::Identity();
  m.topLeftCorner<3, 3>() = pose.orientation.toRotationMatrix();
  m.topRightCorner<3, 1>() = 1000 * pose.position;
  return m;
}

// Keeps the commands; the tip of its arm is where its first six joints say: x y z in m, and a turn about z.
class CommandLog final : public Signals, public MotionPort {
 public:
  explicit CommandLog(const std::vector<std::string>& names) : names_(names) {}
  double read(std::size_t index) noexcept override { return values[names_[index]]; }
  void write(std::size_t index, double value) noexcept override { values[names_[index]] = value; }
  [[nodiscard]] bool ready() const noexcept override { return true; }
  [[nodiscard]] bool settled() const noexcept override { return at_rest; }
  Fault move(const MoveCommand& command) noexcept override {
    commands.push_back(command);
    return {};
  }
  [[nodiscard]] Joints commanded() const noexcept override { return joints; }
  [[nodiscard]] Pose tip_at(const Joints& q) const noexcept override {
    return {q.head<3>(), rotation_by(Vec3(0, 0, q[3]))};
  }
  std::map<std::string, double> values;
  std::vector<MoveCommand> commands;
  Joints joints = Joints::Zero();
  bool at_rest = true;

 private:
  const std::vector<std::string>& names_;
};

// As the arm's files do after parsing.
void place_points(JobBook& book) {
  for (Point& point : book.points) {
    if (point.frame >= 0) {
      const Pose& frame = book.frames[static_cast<std::size_t>(point.frame)].pose;
      point.in_frame = point.target.pose;
      point.target.pose = frame * point.in_frame;
      point.axes = frame.orientation;
    }
  }
}

class Job_places : public testing::Test {
 protected:
  void run(const std::string& text, const Joints& at = Joints::Zero()) {
    ReadJobs read = parse_jobs({{"a.job", text}});
    ASSERT_TRUE(read.diagnostics.empty()) << base::to_text(read.diagnostics);
    place_points(read.book);
    CommandLog robot(read.book.signals);
    robot.joints = at;
    JobRunner sut(read.book);
    sut.start(0);
    for (int i = 0; i < 1000 && sut.running(); ++i) {
      sut.step(0.001, robot, robot);
    }
    message = sut.report().message;
    commands = robot.commands;
    values = robot.values;
  }
  static std::string errors(const std::string& text) {
    return base::to_text(parse_jobs({{"a.job", text}}).diagnostics);
  }
  // Where the last motion goes.
  void expect_last(const Matrix& wanted) {
    ASSERT_FALSE(commands.empty()) << message;
    const Matrix got = matrix(commands.back().target.pose);
    EXPECT_TRUE(got.isApprox(wanted, 1e-9)) << got << "\nwanted\n" << wanted;
  }
  std::string message;
  std::vector<MoveCommand> commands;
  std::map<std::string, double> values;
};

const std::string kDeclared =
    "FRAME camera = POSE 500 100 0 RPY 0 180 90\nFRAME part = POSE 0 0 0 RPY 0 0 0\n"
    "POINT PICK = POSE 10 20 50 RPY 180 0 0 IN part\nPOINT P = POSE 400 0 300 RPY 180 0 0\n";

TEST_F(Job_places, A_part_that_a_camera_sees_turned_is_picked_where_it_lies) {
  run(kDeclared +
      "VAR x = 30\nVAR y = -12.5\nVAR angle = 35\n"
      "part = camera : POSE x, y, 0 RPY 0, 0, angle\nMOVL PICK OFFSET 0, 0, 100\n");
  expect_last(matrix(500, 100, 0, 0, 180, 90) * matrix(30, -12.5, 0, 0, 0, 35) * matrix(0, 0, 100, 0, 0, 0) *
              matrix(10, 20, 50, 180, 0, 0));
}

TEST_F(Job_places, Places_are_joined_and_inverted) {
  run(kDeclared + "VAR a = 40\nP = INV(camera) : (POSE 1, 2, 3 RPY a, -a, 2 * a : INV(PICK)) : POSE 5 6 7\nMOVL P\n");
  expect_last(matrix(500, 100, 0, 0, 180, 90).inverse() * matrix(1, 2, 3, 40, -40, 80) *
              matrix(10, 20, 50, 180, 0, 0).inverse() * matrix(5, 6, 7, 0, 0, 0));
  run(kDeclared + "P = POSE 1 2 3 RPY 10 20 30 IN camera\nMOVL P OFFSET 4, 5, 6\n");
  expect_last(matrix(500, 100, 0, 0, 180, 90) * matrix(4, 5, 6, 0, 0, 0) * matrix(1, 2, 3, 10, 20, 30));
}

TEST_F(Job_places, Here_is_where_the_robot_stands) {
  const Joints at = joints_of({0.1, 0.2, 0.3, kPi / 2});
  run(kDeclared + "P = HERE : POSE 10, 0, 0\nMOVL P\nSET OUT = Z(HERE)\nMOVL HERE OFFSET TOOL 1, 2, 3\n", at);
  ASSERT_EQ(commands.size(), 2U);
  expect_last(matrix(100, 200, 300, 0, 0, 90) * matrix(1, 2, 3, 0, 0, 0));
  EXPECT_NEAR(values["OUT"], 300, 1e-9);
  commands.pop_back();
  expect_last(matrix(100, 200, 300, 0, 0, 90) * matrix(10, 0, 0, 0, 0, 0));
}

TEST_F(Job_places, An_offset_turns_about_the_axes_of_its_frame_or_of_the_tool) {
  const Matrix p = matrix(10, 20, 50, 180, 0, 0);
  run(kDeclared + "VAR a = 25\nMOVL PICK OFFSET 1, 2, 3 RPY 0, a, 0\n");
  Matrix wanted = matrix(0, 0, 0, 0, 25, 0) * p;
  wanted.topRightCorner<3, 1>() = p.topRightCorner<3, 1>() + Vec3(1, 2, 3);
  expect_last(wanted);
  run(kDeclared + "MOVL PICK OFFSET TOOL 1, 2, 3 RPY 10, 20, 30\n");
  expect_last(p * matrix(1, 2, 3, 10, 20, 30));
}

TEST_F(Job_places, Coordinates_are_those_of_the_pose) {
  run(kDeclared +
      "P = POSE 1 2 3 RPY 10 20 30\nSET X = X(P)\nSET Y = Y(P)\nSET Z = Z(P)\nSET R = ROLL(P)\nSET P_ = PITCH(P)\n"
      "SET W = YAW(P)\nSET D = DIST(P, POSE 1, 2, 15)\n");
  const std::pair<const char*, double> wanted[] = {{"X", 1},   {"Y", 2},  {"Z", 3}, {"R", 10},
                                                   {"P_", 20}, {"W", 30}, {"D", 12}};
  for (const auto& [name, value] : wanted) {
    EXPECT_NEAR(values[name], value, 1e-9) << name;
  }
}

TEST_F(Job_places, Random_products_equal_those_of_matrices) {
  std::mt19937 random(1);
  const auto in = [&](double most) { return std::round(std::uniform_real_distribution<double>(-most, most)(random)); };
  for (int i = 0; i < 300; ++i) {
    Matrix wanted = Matrix::Identity();
    std::string text;
    for (int k = 0; k < 5; ++k) {
      const double x = in(900), y = in(900), z = in(900), r = in(180), p = in(89), w = in(180);
      const bool inverse = in(1) > 0;
      std::ostringstream pose;
      pose << "POSE " << x << ", " << y << " + 0, " << z << " RPY " << r << ", " << p << ", " << w;
      text += (k == 0 ? "" : " : ") + (inverse ? "INV(" + pose.str() + ")" : pose.str());
      const Matrix one = matrix(x, y, z, r, p, w);
      wanted = wanted * (inverse ? Matrix(one.inverse()) : one);
    }
    run(kDeclared + "P = " + text + "\nMOVL P\n");
    expect_last(wanted);
  }
}

TEST_F(Job_places, Each_start_begins_with_the_declared_places) {
  ReadJobs read = parse_jobs({{"a.job", kDeclared + "MOVL P\nP = POSE 1 2 3 RPY 0 0 0\nMOVL P\n"}});
  ASSERT_TRUE(read.diagnostics.empty()) << base::to_text(read.diagnostics);
  CommandLog robot(read.book.signals);
  JobRunner sut(read.book);
  for (int run = 0; run < 2; ++run) {
    sut.start(0);
    for (int i = 0; i < 10; ++i) {
      sut.step(0.001, robot, robot);
    }
  }
  ASSERT_EQ(robot.commands.size(), 4U);
  EXPECT_EQ(robot.commands[1].target.pose.position, Vec3(0.001, 0.002, 0.003));
  EXPECT_EQ(robot.commands[2].target.pose.position, Vec3(0.4, 0, 0.3));
}

TEST_F(Job_places, Settings_on_the_line_of_a_motion_are_valid_for_it_only) {
  run(kDeclared +
      "SPEED 50%\nZONE 5 mm\nMOVL P SPEED 100 mm/s ZONE 2 mm ACC 30%\nMOVJ P STRAIGHT SPEED 20%\nMOVS P PICK ACC 10%\n"
      "MOVL P OFFSET 0, 0, 1 ZONE 0\n");
  ASSERT_EQ(commands.size(), 5U);
  EXPECT_EQ(commands[0].tool_speed, 0.1);
  EXPECT_EQ(commands[0].zone, 0.002);
  EXPECT_EQ(commands[0].acceleration, 0.3);
  EXPECT_EQ(commands[1].speed, 0.2);
  EXPECT_EQ(commands[1].zone, 0.005);
  EXPECT_TRUE(commands[1].straight);
  EXPECT_EQ(commands[2].acceleration, 0.1);
  EXPECT_EQ(commands[3].acceleration, 0.1);
  EXPECT_EQ(commands[4].speed, 0.5);
  EXPECT_EQ(commands[4].tool_speed, 0);
  EXPECT_EQ(commands[4].zone, 0);
  EXPECT_EQ(commands[4].acceleration, 1);
}

TEST_F(Job_places, Settings_may_be_computed) {
  run(kDeclared + "VAR n = 20\nSPEED 2 * n + 5 %\nZONE n / 4 mm\nMOVL P SPEED 5 * n mm/s ACC n + 10%\nMOVL P ZONE n\n");
  ASSERT_EQ(commands.size(), 2U) << message;
  EXPECT_NEAR(commands[0].tool_speed, 0.1, 1e-15);
  EXPECT_NEAR(commands[0].zone, 0.005, 1e-15);
  EXPECT_NEAR(commands[0].acceleration, 0.3, 1e-15);
  EXPECT_NEAR(commands[1].speed, 0.45, 1e-15);
  EXPECT_NEAR(commands[1].zone, 0.02, 1e-15);
  run(kDeclared + "VAR n = 120\nMOVL P SPEED n%\n");
  EXPECT_EQ(message, "a.job:6:14: a speed is above 0, and at most 100 %");
  run(kDeclared + "VAR n = -1\nZONE n mm\n");
  EXPECT_EQ(message, "a.job:6:6: a zone is from 0 (stop at the point) to 1000 mm");
  run(kDeclared + "VAR n = 0\nACC n%\n");
  EXPECT_EQ(message, "a.job:6:5: an acceleration is from 1 to 100 % of the full one");
}

TEST_F(Job_places, What_has_no_value_is_named_with_line_and_column) {
  run(kDeclared + "VAR n = 0\nP = camera : POSE 1 / n, 2, 3\nMOVL P\n");
  EXPECT_THAT(message, HasSubstr("a.job:6:5: this has no value: it divides by 0"));
  EXPECT_TRUE(commands.empty());
  run(kDeclared + "P = FOUND : POSE 1, 2, 3\n");
  EXPECT_THAT(message, HasSubstr("a.job:5:5: FOUND is where UNTIL ended a motion"));
  run(kDeclared + "MOVL FOUND\n");
  EXPECT_THAT(message, HasSubstr("a.job:5: FOUND is where UNTIL ended a motion"));
}

TEST_F(Job_places, Mistakes_are_named_where_they_are) {
  const std::pair<const char*, const char*> cases[] = {
      {"Q = POSE 1 2 3\n", "a.job:1:1: error: there is no point and no frame 'Q' to compute; declare it, POINT Q ="},
      {"POINT Q = JOINT 0 0 0 0 0 0\nQ = HERE\n", "a.job:2:1: error: 'Q' has joint angles; declare it as POSE"},
      {"POINT P = POSE 1 2 3 RPY 0 0 0\nP = POSE 1, 2\n", "a.job:2:14: error: expected ','"},
      {"POINT P = POSE 1 2 3 RPY 0 0 0\nP = PP : HERE\n", "a.job:2:5: error: there is no point or frame 'PP'"},
      {"POINT P = POSE 1 2 3 RPY 0 0 0\nP = P : 3\n", "a.job:2:9: error: expected POSE x, y, z RPY r, p, y, HERE"},
      {"POINT P = POSE 1 2 3 RPY 0 0 0\nP = INV(P\n", "a.job:2:10: error: expected ')'"},
      {"VAR d = DIST(HERE)\n", "a.job:1:18: error: expected ',' and the other place"},
      {"ON X(HERE) > 1 AND I4 CALL a\n", "a.job:1:4: error: an interrupt monitors shared variables"},
      {"FRAME f = POSE 0 0 0 RPY 0 0 0\nKEEPOUT z = BALL 0 0 0 RADIUS 5 IN f\nf = HERE\n",
       "a.job:2:9: error: zone 'z' is in frame 'f', which jobs compute"},
      {"POINT P = POSE 1 2 3 RPY 0 0 0\nMOVL P SPEED\n", "a.job:2:13: error: expected the speed, 50% or 250 mm/s"},
      {"POINT P = POSE 1 2 3 RPY 0 0 0\nMOVL P ACC 0%\n", "a.job:2:12: error: an acceleration is from 1 to 100 %"},
      {"POINT P = POSE 1 2 3 RPY 0 0 0\nMOVL P OFFSET 0, 0, 1 RPY 1, 2\n", "a.job:2:31: error: expected ','"},
  };
  for (const auto& [text, wanted] : cases) {
    EXPECT_THAT(errors(text), HasSubstr(wanted)) << text;
  }
  std::string many;
  for (int i = 0; i < 33; ++i) {
    const std::string name = "Q" + std::to_string(i);
    many += "POINT " + name + " = POSE 1 2 3 RPY 0 0 0\n" + name + " = HERE\n";
  }
  EXPECT_THAT(errors(many), HasSubstr("a.job:66:1: error: more than 32 points and frames are computed"));
}

// An arm that moves along x by 1 mm in each period once it was commanded to, and comes to rest 3 periods after halt().
class Job_searches : public Job_places {
 protected:
  class Mover final : public Signals, public MotionPort {
   public:
    double read(std::size_t) noexcept override { return x >= edge ? 1 : 0; }
    void write(std::size_t, double value) noexcept override { written.push_back(value); }
    [[nodiscard]] bool ready() const noexcept override { return true; }
    [[nodiscard]] bool settled() const noexcept override { return left == 0; }
    Fault move(const MoveCommand& command) noexcept override {
      last = command;
      ++moves;
      left = 100;
      return {};
    }
    void halt() noexcept override {
      left = halted ? left : 3;
      halted = true;
    }
    [[nodiscard]] PathPlace place() const noexcept override { return {left > 0 ? last.ticket : 0, 0, 0, 0}; }
    [[nodiscard]] Joints commanded() const noexcept override { return joints_of({0.001 * x}); }
    [[nodiscard]] Pose tip_at(const Joints& q) const noexcept override { return {q.head<3>(), Quat::Identity()}; }
    void step() {
      x += left > 0 ? 1 : 0;
      left -= left > 0 ? 1 : 0;
      halted = halted && left > 0;
    }
    double x = 0, edge = 40;
    int left = 0, moves = 0;
    bool halted = false;
    MoveCommand last;
    std::vector<double> written;
  };
  void search(const std::string& text, Mover& robot) {
    const auto [book, errors] = parse_jobs({{"a.job", "POINT P = POSE 100 0 0 RPY 0 0 0\n" + text}});
    ASSERT_TRUE(errors.empty()) << base::to_text(errors);
    JobRunner sut(book);
    sut.start(0);
    for (int i = 0; i < 1000 && sut.running(); ++i) {
      sut.step(0.001, robot, robot);
      robot.step();
    }
    message = sut.report().message;
    state = sut.state();
  }
  JobState state = JobState::Idle;
};

TEST_F(Job_searches, A_motion_ends_where_its_condition_becomes_true) {
  Mover robot;
  search("ZONE 20 mm\nMOVL P UNTIL I4 SPEED 20 mm/s\nSET O = FOUND\nSET O = X(FOUND)\nSET O = X(HERE)\nMOVL FOUND\n",
         robot);
  EXPECT_EQ(state, JobState::Ended) << message;
  EXPECT_THAT(robot.written, testing::ElementsAre(1, testing::DoubleNear(40, 1e-9), testing::DoubleNear(43, 1e-9)));
  EXPECT_EQ(robot.moves, 2);
  EXPECT_NEAR(robot.last.target.joints[0], 0.04, 1e-12);
}

TEST_F(Job_searches, Without_it_the_motion_goes_to_its_end_and_a_search_fails) {
  Mover robot;
  robot.edge = 1000;
  search("MOVL P UNTIL I4\nSET O = FOUND\nTRY\nSEARCH P UNTIL I4\nRECOVER\nSET O = ERROR\nEND\nSEARCH P UNTIL I4\n",
         robot);
  EXPECT_EQ(state, JobState::Failed);
  EXPECT_EQ(message, "a.job:9: the search came to its end and found nothing");
  EXPECT_THAT(robot.written, testing::ElementsAre(0, static_cast<double>(ErrorCode::Line)));
  EXPECT_EQ(robot.x, 300);
}

TEST_F(Job_searches, May_begin_from_what_was_found) {
  Mover robot;
  search("MOVL P UNTIL I4\nMOVL FOUND OFFSET 5, 0, 0 UNTIL X(HERE) > 60\nSET O = X(FOUND)\n", robot);
  EXPECT_EQ(state, JobState::Ended) << message;
  EXPECT_NEAR(robot.last.target.pose.position.x(), 0.045, 1e-12);
  EXPECT_THAT(robot.written, testing::ElementsAre(testing::DoubleNear(61, 1e-9)));
}

TEST_F(Job_searches, What_is_true_already_moves_nothing) {
  Mover robot;
  robot.edge = 0;
  search("SEARCH P UNTIL I4\nSET O = X(FOUND)\n", robot);
  EXPECT_EQ(state, JobState::Ended) << message;
  EXPECT_EQ(robot.moves, 0);
  EXPECT_THAT(robot.written, testing::ElementsAre(0));
}

TEST_F(Job_searches, Conditions_may_read_place_time_and_variables) {
  Mover robot;
  search("VAR far = 25\nMOVL P UNTIL X(HERE) >= far OR TIME > 10\nSET O = X(FOUND)\n", robot);
  EXPECT_THAT(robot.written, testing::ElementsAre(testing::DoubleNear(25, 1e-9)));
  Mover other;
  search("VAR n = 0\nMOVL P UNTIL 1 / (X(HERE) - 10) > 5\n", other);
  EXPECT_THAT(message, HasSubstr("a.job:3:14: this has no value: it divides by 0"));
  EXPECT_LE(other.x, 14) << "it is stopped";
}

TEST_F(Job_searches, Mistakes_are_named_where_they_are) {
  const std::string p = "POINT P = POSE 1 2 3 RPY 0 0 0\n";
  const std::pair<std::string, const char*> cases[] = {
      {p + "SEARCH P SPEED 10%\n", "a.job:2:1: error: a SEARCH ends by UNTIL and a condition"},
      {p + "MOVL P UNTIL I4 ZONE 5 mm\n", "a.job:2:1: error: a motion with UNTIL ends at rest; leave its ZONE out"},
      {p + "MOVS P P UNTIL I4\n",
       "a.job:2:10: error: UNTIL comes once, after the points of a MOVL, MOVJ, MOVC or SEARCH"},
      {p + "MOVL P UNTIL I4\nSET O ON BEFORE 5 mm\n",
       "a.job:3:1: error: a motion with UNTIL has no place known before"},
      {p + "MOVL P UNTIL\n", "a.job:2:13: error: expected the condition that ends the motion"},
  };
  for (const auto& [text, wanted] : cases) {
    EXPECT_THAT(errors(text), HasSubstr(wanted)) << text;
  }
}

}  // namespace
}  // namespace indurop::robot
