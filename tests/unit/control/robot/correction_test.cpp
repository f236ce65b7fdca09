// SPDX-License-Identifier: Apache-2.0
// Paths that a sensor corrects: compared with the straight line that was asked for and with what the sensor said, in
// each period and whatever happens meanwhile; and what jobs may not do meanwhile.
#include <gmock/gmock.h>

#include <cmath>
#include <map>
#include <random>

#include "control/robot/job/job.h"
#include "corrected_cell.h"

namespace indurop::robot {
namespace {

using testing::HasSubstr;

class Correction : public CorrectedCell {};

// A seam of this shape over the line from A to B.
double seam(double x) {
  return 15 * std::sin(2 * kPi * x / 800);
}

TEST_F(Correction, The_tip_is_on_the_seam_that_the_sensor_sees) {
  start(std::string(kSeam) +
        "MOVL A\nCORRECT 0, DY, 0 LIMIT 20 mm RATE 50 mm/s\nMOVL B SPEED 100 mm/s\nCORRECT OFF\nSET OUT = Y(HERE)\n");
  double worst = 0;
  sensor = [&] { *values["DY"] = seam(x()); };
  ASSERT_TRUE(follow([&] {
    if (x() > 300 && x() < 2690) {
      worst = std::max(worst, std::abs(y() - seam(x())));
      EXPECT_NEAR(z(), 1300, 1e-6);
    }
    return ended();
  }));
  EXPECT_EQ(cell->out.error, ErrorCode::Ok) << message();
  EXPECT_LT(worst, 0.7);  // mm; the seam moves away by up to 12 mm/s
  EXPECT_NEAR(*values["OUT"], seam(2700), 0.7);
  EXPECT_NEAR(x(), 2700, 1e-6);
}

TEST_F(Correction, Neither_its_limit_nor_its_rate_is_exceeded) {
  start(std::string(kSeam) + "MOVL A\nCORRECT 0, DY, DZ LIMIT 8 mm RATE 30 mm/s\nMOVL B SPEED 200 mm/s\n");
  std::mt19937 random(3);
  std::uniform_real_distribution<double> anything(-60, 60);
  double far = 0;
  double fast = 0;
  double last = HUGE_VAL;
  int left = 0;
  sensor = [&] {
    if (--left < 0) {
      left = static_cast<int>(random() % 120);
      *values["DY"] = anything(random);
      *values["DZ"] = anything(random);
    }
  };
  ASSERT_TRUE(follow([&] { return x() > 250; }));
  ASSERT_TRUE(follow([&] {
    far = std::max({far, std::abs(y()), std::abs(z() - 1300)});
    fast = std::max(fast, std::isinf(last) ? 0 : std::abs(y() - last) / period);
    last = y();
    return ended();
  }));
  EXPECT_EQ(cell->out.error, ErrorCode::Ok) << message();
  EXPECT_LE(far, 8 + 1e-6);
  EXPECT_GT(far, 7.9);
  EXPECT_LE(fast, 30 + 1e-3);
  EXPECT_GT(fast, 25);
}

TEST_F(Correction, A_frame_and_the_tool_give_its_axes) {
  for (const auto& [where, wanted] : {std::pair{"IN f", Vec3(1450, 10, 1300)}, {"TOOL", Vec3(1450, -10, 1300)}}) {
    start("FRAME f = POSE 0 0 0 RPY 0 0 90\n" + std::string(kSeam) + "MOVL A\nCORRECT " +
          (std::string(where) == "TOOL" ? "0, 10, 0 TOOL" : "10, 0, 0 IN f") +
          " LIMIT 20 mm RATE 50 mm/s\nMOVL B SPEED 200 mm/s\n");
    ASSERT_TRUE(follow([&] { return x() >= 1450; }));
    EXPECT_NEAR(y(), wanted[1], 1e-3) << where;
    EXPECT_NEAR(z(), wanted[2], 1e-3) << where;
    ASSERT_TRUE(follow([&] { return ended(); }));
    EXPECT_EQ(cell->out.error, ErrorCode::Ok) << message();
  }
}

TEST_F(Correction, A_sensor_that_is_silent_ends_the_job_where_it_is) {
  start(std::string(kSeam) +
        "MOVL A\nCORRECT 0, DY, 0 LIMIT 20 mm RATE 50 mm/s AGE BEAT 100 ms\nWAIT 0.5s\nMOVL B SPEED 200 mm/s\n");
  sensor = [&] {
    *values["DY"] = 10;
    *values["BEAT"] += cell->out.tool_speed > 0 && x() < 1000 ? 1 : 0;  // it need not count while the robot stands
  };
  ASSERT_TRUE(follow([&] { return resting() && ended(); }));
  EXPECT_EQ(cell->out.error, ErrorCode::Line);
  EXPECT_THAT(message(), HasSubstr("no new measurement"));
  EXPECT_LT(x(), 1000 + 200 * 0.1 + 60);
  EXPECT_NEAR(y(), 10, 1e-3);
}

TEST_F(Correction, A_stopped_job_continues_on_the_corrected_path) {
  start(std::string(kSeam) + "MOVL A\nCORRECT 0, DY, 0 LIMIT 20 mm RATE 50 mm/s\nMOVL B SPEED 200 mm/s\n");
  sensor = [&] { *values["DY"] = 12; };
  ASSERT_TRUE(follow([&] { return x() > 800; }));
  cell->ask(Service::JobStop);
  ASSERT_TRUE(follow([&] { return cell->out.state == GroupState::Standby; }));
  EXPECT_NEAR(y(), 12, 1e-3);
  const double stood = x();
  ASSERT_TRUE(cell->out.job.can_resume);
  cell->ask(Service::JobResume);
  ASSERT_TRUE(follow([&] {
    EXPECT_NEAR(y(), 12, 1e-3);
    return ended();
  }));
  EXPECT_EQ(cell->out.error, ErrorCode::Ok) << message();
  EXPECT_GT(stood, 800);
  EXPECT_NEAR(x(), 2700, 1e-3);
}

TEST_F(Correction, A_robot_that_was_moved_away_returns_to_where_it_was_corrected_to) {
  start(std::string(kSeam) + "MOVL A\nCORRECT 0, DY, 0 LIMIT 20 mm RATE 50 mm/s\nMOVL B SPEED 200 mm/s\n");
  sensor = [&] { *values["DY"] = 12; };
  ASSERT_TRUE(follow([&] { return x() > 800; }));
  cell->ask(Service::JobStop);
  ASSERT_TRUE(follow([&] { return cell->out.state == GroupState::Standby; }));
  cell->in.jog.enabled = true;
  cell->in.jog.frame = JogFrame::Base;
  cell->in.jog.speed[1] = 5;
  ASSERT_TRUE(follow([&] { return y() > 40; }));
  cell->in.jog = {};
  ASSERT_TRUE(follow([&] { return cell->out.state == GroupState::Standby; }));
  cell->ask(Service::JobResume);
  ASSERT_TRUE(follow([&] { return x() > 900 || ended(); }));
  EXPECT_NEAR(y(), 12, 1e-3);
  ASSERT_TRUE(follow([&] { return ended(); }));
  EXPECT_EQ(cell->out.error, ErrorCode::Ok) << message();
}

TEST_F(Correction, At_standstill_nothing_moves) {
  start(std::string(kSeam) +
        "MOVL A\nCORRECT 0, DY, 0 LIMIT 20 mm RATE 50 mm/s\nWAIT 0.5s\nSET OUT ON\nMOVL B SPEED 200 mm/s\n");
  sensor = [&] { *values["DY"] = 15; };
  ASSERT_TRUE(follow([&] { return *values["OUT"] > 0; }));
  EXPECT_NEAR(y(), 0, 1e-9);
  ASSERT_TRUE(follow([&] { return x() > 600; }));
  cell->in.hold = true;
  sensor = [&] { *values["DY"] = -15; };
  for (int i = 0; i < 250; ++i) {
    step();
  }
  const double held = y();
  for (int i = 0; i < 250; ++i) {
    step();
    EXPECT_EQ(y(), held);
  }
  cell->in.hold = false;
  ASSERT_TRUE(follow([&] { return ended(); }));
  EXPECT_EQ(cell->out.error, ErrorCode::Ok) << message();
  EXPECT_NEAR(y(), -15, 1e-3);
}

TEST_F(Correction, After_its_end_motions_begin_where_the_arm_is) {
  start(std::string(kSeam) +
        "MOVL A\nCORRECT 0, DY, 0 LIMIT 20 mm RATE 50 mm/s\nMOVL B SPEED 200 mm/s\nCORRECT OFF\nMOVL HERE OFFSET 0, 0, "
        "50\nSET OUT = Y(HERE)\nMOVL C\n");
  sensor = [&] { *values["DY"] = 12; };
  ASSERT_TRUE(follow([&] { return ended(); }));
  EXPECT_EQ(cell->out.error, ErrorCode::Ok) << message();
  EXPECT_NEAR(*values["OUT"], 12, 1e-3);
  EXPECT_NEAR(y(), 400, 1e-3);
}

TEST_F(Correction, The_next_job_begins_without_it) {
  start(std::string(kSeam) + "MOVL A\nCORRECT 0, DY, 0 LIMIT 20 mm RATE 50 mm/s\nMOVL B SPEED 300 mm/s\n");
  sensor = [&] { *values["DY"] = 12; };
  ASSERT_TRUE(follow([&] { return ended(); }));
  EXPECT_NEAR(y(), 12, 1e-3);
  begin();
  ASSERT_TRUE(follow([&] { return std::abs(x() - 200) < 1e-6 && cell->out.tool_speed < 1e-9; }));
  EXPECT_NEAR(y(), 0, 1e-6);
}

TEST_F(Correction, In_manual_mode_the_tip_keeps_250_mm_per_s) {
  start(std::string(kSeam) + "MOVL A\nCORRECT 0, DY, DZ LIMIT 50 mm RATE 80 mm/s\nMOVL B\n");
  int left = 0;
  double sign = 50;
  sensor = [&] {
    if (--left < 0) {
      left = 100;
      sign = -sign;
    }
    *values["DY"] = *values["DZ"] = sign;
  };
  cell->in.mode = {OperatingMode::Manual, true, 0};
  ASSERT_TRUE(follow([&] {
    EXPECT_LE(cell->out.tool_speed, 250 + 1e-6);
    return ended();
  }));
  ASSERT_TRUE(cell->serve(Service::None) || true);
}

struct Refused {
  const char* name;
  const char* job;
  const char* why;
};
class Correction_refuses : public Correction, public testing::WithParamInterface<Refused> {};

TEST_P(Correction_refuses, What_would_leave_its_path) {
  start("TOOL t = POSE 0 0 50 RPY 0 0 0\n" + std::string(kSeam) +
        "MOVL A\nTRY\nCORRECT 0, 5, 0 LIMIT 20 mm RATE 50 mm/s\nMOVL A OFFSET 500, 0, 0\n" + GetParam().job +
        "\nRECOVER\nCORRECT OFF\nSET OUT = ERROR\nMOVL C\nEND\n");
  ASSERT_TRUE(follow([&] { return *values["OUT"] > 0 || ended(); }));
  EXPECT_THAT(message(), HasSubstr(GetParam().why));
  ASSERT_TRUE(follow([&] { return ended(); }));
  EXPECT_EQ(cell->out.error, ErrorCode::Ok) << message();
  EXPECT_NEAR(y(), 400, 1e-3);
}

INSTANTIATE_TEST_SUITE_P(
    All, Correction_refuses,
    testing::Values(Refused{"A_joint_motion", "MOVJ B", "before another motion"},
                    Refused{"Here", "MOVL HERE OFFSET 10, 0, 0", "HERE, FOUND and BACK include the correction"},
                    Refused{"Twice", "CORRECT 0, 1, 0 LIMIT 20 mm RATE 50 mm/s", "CORRECT is on already"},
                    Refused{"Another_tool", "TOOL t", "tool and load must not change"}),
    [](const auto& each) { return std::string(each.param.name); });

TEST_F(Correction, A_job_cannot_begin_inside_of_it) {
  start("WAIT 1s\n" + std::string(kSeam) + "MOVL A\nCORRECT 0, 5, 0 LIMIT 20 mm RATE 50 mm/s\nMOVL B\nMOVL A\n");
  ASSERT_TRUE(cell->serve(Service::JobStop));
  cell->in.service.line = 7;
  begin();
  ASSERT_TRUE(follow([&] { return ended(); }));
  EXPECT_THAT(message(), HasSubstr("cannot begin between CORRECT or PRESS and its OFF"));
}

TEST_F(Correction, An_interrupt_waits_for_its_end) {
  start(std::string(kSeam) +
            "MOVL A\nON I4 CALL aside\nCORRECT 0, 5, 0 LIMIT 20 mm RATE 50 mm/s\nMOVL B SPEED 300 "
            "mm/s\nCORRECT OFF\nSET OUT = 1\nWAIT 1s\n",
        4, urdf_of("gantry"), {{"aside", "SET SEEN = OUT + 1\n"}});
  sensor = [&] { *values["I4"] = x() > 1000 ? 1 : 0; };
  ASSERT_TRUE(follow([&] { return ended(); }));
  EXPECT_EQ(cell->out.error, ErrorCode::Ok) << message();
  EXPECT_GE(*values["SEEN"], 1);
}

TEST_F(Correction, Of_an_interrupt_ends_with_it) {
  start(std::string(kSeam) + "MOVL A\nON I4 CALL aside\nMOVL B SPEED 300 mm/s\n", 4, urdf_of("gantry"),
        {{"aside",
          "CORRECT 0, 15, 0 LIMIT 20 mm RATE 50 mm/s\nMOVL A OFFSET 350, 0, 50 SPEED 100 mm/s\nSET SEEN = "
          "Y(HERE)\n"}});
  sensor = [&] { *values["I4"] = x() > 510 ? 1 : 0; };
  ASSERT_TRUE(follow([&] { return *values["SEEN"] > 0 || ended(); }));
  EXPECT_NEAR(*values["SEEN"], 15, 0.2);
  ASSERT_TRUE(follow([&] { return ended(); }));
  EXPECT_EQ(cell->out.error, ErrorCode::Ok) << message();
  EXPECT_NEAR(x(), 2700, 1e-3);
  EXPECT_NEAR(y(), 0, 1e-3);
}

// Stops of all kinds while the sensor jumps.
TEST_F(Correction, Emergency_stops_keep_their_limits) {
  for (int at = 0; at < 12; ++at) {
    SCOPED_TRACE(at);
    start(std::string(kSeam) + "MOVL A\nCORRECT 0, DY, DZ LIMIT 30 mm RATE 200 mm/s\nMOVL B SPEED 800 mm/s\n");
    int count = 0;
    sensor = [&] { *values["DY"] = *values["DZ"] = ++count / 40 % 2 == 0 ? 30 : -30; };
    ASSERT_TRUE(follow([&] { return x() > 400 + 100 * at; }));
    stop(at % 3);
    EXPECT_LE(std::abs(y()), 30 + 5);
  }
}

TEST(Correction_lines, Wrong_ones_are_named) {
  const auto errors = [](const std::string& text) { return base::to_text(parse_jobs({{"a.job", text}}).diagnostics); };
  EXPECT_EQ(errors("CORRECT 0, DY, 0 LIMIT 20 mm RATE 50 mm/s AGE N 100 ms\nCORRECT OFF\n"), "");
  EXPECT_THAT(errors("CORRECT 0, DY\n"), HasSubstr("a.job:1:"));
  EXPECT_THAT(errors("CORRECT 0, DY, 0 RATE 50 mm/s\n"), HasSubstr("a.job:1:18: error: expected LIMIT"));
  EXPECT_THAT(errors("CORRECT 0, DY, 0 LIMIT 20 mm\n"), HasSubstr("expected RATE and a number of mm/s"));
  EXPECT_THAT(errors("CORRECT 0, DY, 0 LIMIT 0 mm RATE 5 mm/s\n"), HasSubstr("more than 0 and at most 1000 mm"));
  EXPECT_THAT(errors("CORRECT 0, DY, 0 LIMIT 20 RATE 5 mm/s\n"), HasSubstr("expected mm, found"));
  EXPECT_THAT(errors("CORRECT 0, DY, 0 LIMIT 20 mm RATE 5 mm\n"), HasSubstr("expected mm/s"));
  EXPECT_THAT(errors("CORRECT 0, DY, 0 IN g LIMIT 20 mm RATE 5 mm/s\n"), HasSubstr("there is no frame 'g'"));
  EXPECT_THAT(errors("VAR n\nCORRECT 0, n, 0 LIMIT 20 mm RATE 5 mm/s\n"), HasSubstr("none of the job"));
  EXPECT_THAT(errors("CORRECT 0, DY, 0 LIMIT 20 mm RATE 5 mm/s AGE N 0 ms\n"), HasSubstr("more than 0 s"));
}

}  // namespace
}  // namespace indurop::robot
