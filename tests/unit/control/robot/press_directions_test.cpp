// SPDX-License-Identifier: Apache-2.0
// Tools that press in several directions: the forces are those that were asked for, the tool is where a linear system
// says, and neither the distance from the path nor its rate exceeds what the job declares. An interrupt waits.
#include <gmock/gmock.h>

#include <cmath>
#include <vector>

#include "control/robot/job/job.h"
#include "corrected_cell.h"
#include "press_springs.h"
#include "robot_fixture.h"

namespace indurop::robot {
namespace {

using testing::HasSubstr;

// The tool points downwards: its x axis is that of the base, its z axis points down. Begins at A.
class Press_directions : public CorrectedCell {
 protected:
  static Vec3 in_tool(const Vec3& base) { return {base[0], -base[1], -base[2]}; }
  [[nodiscard]] Vec3 shift() const { return in_tool(Vec3(x(), y(), z()) - at_); }
  // Runs the statement and what follows; the variables FX, FY, FZ are the forces in N along the axes of the tool.
  void press(const std::string& job, const Springs& springs, double period_ms = 4, const JobTexts& others = {}) {
    start(std::string(kSeam) + "MOVL A\n" + job, period_ms, urdf_of("gantry"), others);
    sensor = [this, springs] {
      force = springs.force(shift());
      write("FX", force[0]);
      write("FY", force[1]);
      write("FZ", force[2]);
    };
  }
  void write(const std::string& name, double value) {
    if (const auto found = values.find(name); found != values.end()) {
      *found->second = value;
    }
  }
  Vec3 at_{200, 0, 1300};
  Vec3 force = Vec3::Zero();  // N
};

TEST_F(Press_directions, Two_oblique_springs_get_the_forces_that_were_asked_for) {
  Springs springs;
  springs.add(20, {0.3, 0, 1}, 1);
  springs.add(15, {1, 0, -0.2}, 1.5);
  for (const double ms : {0.5, 1.0, 4.0, 10.0}) {
    SCOPED_TRACE(ms);
    press(
        "PRESS 18, FZ ALONG Z, 12, FX ALONG X TOOL MOST 60 N STIFFNESS 25 N/mm LIMIT 20 mm RATE 10 mm/s\nWAIT 4s\n"
        "SET OUT ON\nWAIT 1s\n",
        springs, ms);
    const Vec3 wanted(12, 0, 18);
    ASSERT_TRUE(follow([&] { return *values["OUT"] == 1; }, 30'000)) << message();
    EXPECT_LT((force - wanted).norm(), 0.05) << force.transpose();
    EXPECT_LT((shift() - springs.equilibrium(wanted)).norm(), 0.01) << shift().transpose();
  }
}

TEST_F(Press_directions, Three_springs_and_a_stiffness_for_each_direction) {
  Springs springs;
  springs.add(40, {0, 0, 1}, 1);
  springs.add(8, {1, 0.2, 0}, 0.5);
  springs.add(6, {0, -1, 0}, 0.5);
  press(
      "PRESS 30, FZ ALONG Z, 4, FX ALONG X, -3, FY ALONG Y TOOL MOST 60 N STIFFNESS 40, 9, 7 N/mm LIMIT 20 mm "
      "RATE 10 mm/s\nWAIT 5s\nSET OUT ON\nWAIT 1s\n",
      springs);
  const Vec3 wanted(4, -3, 30);
  ASSERT_TRUE(follow([&] { return *values["OUT"] == 1; })) << message();
  EXPECT_LT((force - wanted).norm(), 0.05) << force.transpose();
  EXPECT_LT((shift() - springs.equilibrium(wanted)).norm(), 0.01) << shift().transpose();
}

// Along a frame that is turned about z, while a line leads along y of the base.
TEST_F(Press_directions, Along_the_axes_of_a_frame_while_the_path_moves) {
  start(std::string(kSeam) +
            "FRAME f = POSE 0 0 0 RPY 0 0 30\nMOVL A\nPRESS 10, FX ALONG X, -20, FZ ALONG Z IN f MOST 60 N STIFFNESS "
            "20 N/mm LIMIT 20 mm RATE 10 mm/s\nWAIT 3s\nMOVL C SPEED 50 mm/s\nSET OUT ON\nPRESS OFF\n",
        4);
  const Vec3 along(std::cos(kPi / 6), std::sin(kPi / 6), 0);
  Vec3 f = Vec3::Zero();
  sensor = [&] {
    const Vec3 off = Vec3(x(), y(), z()) - at_;
    // A wall across x of the frame that moves with the path, and a floor.
    const double path = y() > 0 ? along[1] * off[1] : 0;
    f = {10 * std::max(0.0, along.dot(off) - path - 1), 0, -20 * std::max(0.0, -1 - off[2])};
    *values["FX"] = f[0];
    *values["FZ"] = f[2];
  };
  ASSERT_TRUE(follow([&] { return *values["OUT"] == 1; })) << message();
  EXPECT_NEAR(f[2], -20, 0.5);
  ASSERT_TRUE(follow([&] { return ended(); }));
  EXPECT_EQ(cell->out.error, ErrorCode::Ok) << message();
}

// Without a surface: the distance from the path and its rate, as differences of set points.
TEST_F(Press_directions, All_together_stay_within_the_declared_limit_and_rate) {
  press(
      "PRESS 20, FZ ALONG Z, 20, FX ALONG X, 20, FY ALONG Y TOOL MOST 60 N STIFFNESS 1 N/mm LIMIT 6 mm RATE 3 mm/s\n"
      "WAIT 5s\nSET OUT ON\nPRESS OFF\nMOVL HERE OFFSET 10, 0, 0\n",
      Springs());
  Vec3 last = shift();
  double farthest = 0;
  double fastest = 0;
  bool begun = false;
  ASSERT_TRUE(follow([&] {
    begun = begun || (cell->out.job.line > 5 && last.norm() < 1e-6);
    fastest = std::max(fastest, begun ? (shift() - last).norm() / period : 0);
    last = shift();
    farthest = std::max(farthest, begun ? last.norm() : 0);
    return *values["OUT"] == 1;
  }));
  EXPECT_LE(farthest, 6);
  EXPECT_GT(farthest, 5.9);
  EXPECT_LE(fastest, 3 * (1 + 1e-6));
  EXPECT_GT(fastest, 2);
  ASSERT_TRUE(follow([&] { return ended(); }));
  EXPECT_EQ(cell->out.error, ErrorCode::Ok) << message();
}

TEST_F(Press_directions, One_that_reaches_nothing_leaves_the_other_its_force) {
  Springs springs;
  springs.add(20, {0, 0, 1}, 1);
  press(
      "PRESS 15, FZ ALONG Z, 5, FX ALONG X TOOL MOST 60 N STIFFNESS 20 N/mm LIMIT 8 mm RATE 10 mm/s\nWAIT 6s\n"
      "SET OUT ON\nWAIT 1s\n",
      springs);
  ASSERT_TRUE(follow([&] { return *values["OUT"] == 1; }));
  EXPECT_NEAR(force[2], 15, 0.05);
  EXPECT_NEAR(shift()[0], 8 / std::sqrt(2), 0.06);
}

TEST_F(Press_directions, The_most_is_that_of_all_forces_together) {
  press("PRESS 0, FZ ALONG Z, 0, FX ALONG X TOOL MOST 50 N STIFFNESS 40 N/mm LIMIT 8 mm RATE 10 mm/s\nWAIT 1s\n",
        Springs());
  int count = 0;
  sensor = [&] {
    *values["FZ"] = ++count < 300 ? 29.9 : 30.1;
    *values["FX"] = 40;
  };
  ASSERT_TRUE(follow([&] { return resting() && ended(); }));
  EXPECT_THAT(message(), HasSubstr("more than the MOST of PRESS"));
  EXPECT_GE(count, 300);
  EXPECT_LT(count, 600);
}

// It comes when PRESS is off, as docs/robot.md says, and the path continues after it.
TEST_F(Press_directions, An_interrupt_waits_for_its_end) {
  Springs springs;
  springs.add(20, {0, 0, 1}, 1);
  springs.add(20, {1, 0, 0}, 1);
  press(
      "ON N CALL aside\nPRESS 15, FZ ALONG Z, 5, FX ALONG X TOOL MOST 60 N STIFFNESS 20 N/mm LIMIT 8 mm RATE 10 mm/s\n"
      "WAIT 2s\nSET OUT = 1\nMOVL A OFFSET 0, 100, 0 SPEED 100 mm/s\nPRESS OFF\nMOVL C SPEED 100 mm/s\nSET OUT = 3\n",
      springs, 4, {{"aside", "SET M = OUT + Z(HERE) / 10000\nMOVL C OFFSET 0, 0, 50\nMOVJ BACK\n"}});
  bool raised = false;
  ASSERT_TRUE(follow([&] {
    raised = raised || force[2] > 10;
    *values["N"] = raised ? 1 : 0;
    EXPECT_TRUE(*values["M"] == 0 || *values["OUT"] == 1 || *values["OUT"] == 3) << "it came while the tool pressed";
    return ended();
  })) << message();
  EXPECT_EQ(cell->out.error, ErrorCode::Ok) << message();
  EXPECT_TRUE(raised);
  EXPECT_GT(*values["M"], 1) << "it never came";
  EXPECT_LT(*values["M"], 2) << "it came too late";
  EXPECT_EQ(*values["OUT"], 3);
  EXPECT_NEAR(y(), 400, 1e-3);
}

TEST(Press_direction_lines, Wrong_ones_are_named) {
  const auto errors = [](const std::string& text) { return base::to_text(parse_jobs({{"a.job", text}}).diagnostics); };
  const std::string rest = " LIMIT 5 mm RATE 10 mm/s\n";
  const std::string two = "PRESS 20, F ALONG Z, 5, G ALONG X TOOL MOST 60 N ";
  EXPECT_EQ(errors(two + "STIFFNESS 40 N/mm" + rest), "");
  EXPECT_EQ(errors(two + "STIFFNESS 40, 10 N/mm" + rest), "");
  EXPECT_EQ(errors("PRESS 20, F ALONG Z, 2 * A, G ALONG X, 0, H ALONG Y MOST 60 N STIFFNESS 40, 10, 5 N/mm LIMIT 5 mm "
                   "RATE 10 mm/s AGE N 50 ms\nPRESS OFF\n"),
            "");
  EXPECT_THAT(errors(two + "STIFFNESS 40, 10, 5 N/mm" + rest),
              HasSubstr("a.job:1:60: error: STIFFNESS is one number for all directions or one for each of the 2, found "
                        "3"));
  EXPECT_THAT(errors("PRESS 20, F ALONG Z MOST 60 N STIFFNESS 40, 10 N/mm" + rest),
              HasSubstr("one for each of the 1, found 2"));
  EXPECT_THAT(errors(two + "STIFFNESS 40, 0 N/mm" + rest), HasSubstr("a.job:1:64: error: STIFFNESS is more than 0"));
  EXPECT_THAT(errors(two + "STIFFNESS 40, N/mm" + rest), HasSubstr("a.job:1:64: error: expected N/mm, found 'N'"));
  EXPECT_THAT(errors("PRESS 20, F ALONG Z, 5, G ALONG Z MOST 60 N STIFFNESS 40 N/mm" + rest),
              HasSubstr("a.job:1:33: error: the tool presses along Z already; each direction has an axis of its own"));
  EXPECT_THAT(errors("PRESS 20, F ALONG Z, 5 ALONG X MOST 60 N STIFFNESS 40 N/mm" + rest),
              HasSubstr("a.job:1:24: error: expected ',', found 'ALONG'"));
  EXPECT_THAT(errors("PRESS 20, F ALONG Z, 5, G MOST 60 N STIFFNESS 40 N/mm" + rest),
              HasSubstr("a.job:1:27: error: expected ALONG and X, Y or Z, found 'MOST'"));
  EXPECT_THAT(errors("PRESS 2, F ALONG Z, 5, G ALONG X, 1, H ALONG Y, 1, F ALONG Z MOST 60 N STIFFNESS 40 N/mm" + rest),
              HasSubstr("a.job:1:49: error: a tool presses in three directions at most"));
  EXPECT_THAT(errors("VAR n\nPRESS 20, F ALONG Z, n, G ALONG X MOST 60 N STIFFNESS 40 N/mm" + rest),
              HasSubstr("a.job:2:22: error: this is evaluated in each period"));
}

}  // namespace
}  // namespace indurop::robot
