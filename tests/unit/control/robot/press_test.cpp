// SPDX-License-Identifier: Apache-2.0
// Tools that press against springs: the force follows the formula of its control loop, whatever the surface does; no
// limit is exceeded, and what fails ends the job.
#include <gmock/gmock.h>

#include <cmath>
#include <vector>

#include "control/robot/job/job.h"
#include "corrected_cell.h"
#include "robot_fixture.h"

namespace indurop::robot {
namespace {

using testing::HasSubstr;

class Press : public CorrectedCell {
 protected:
  // The tool points downwards; a surface of this stiffness in N/mm lies at this height in mm. `late`: periods that the
  // sensor needs.
  void touch(double stiffness, std::function<double()> height, std::size_t late = 0) {
    sensor = [this, stiffness, height = std::move(height), past = std::vector<double>(late, 0)]() mutable {
      force = stiffness * std::max(0.0, height() - z());
      past.insert(past.begin(), force);
      *values["F"] = past.back();
      past.pop_back();
    };
  }
  // At A, 3 mm above the surface.
  void press(const std::string& then, double period_ms = 4, const std::string& more = "") {
    start(std::string(kSeam) + "MOVL A\nPRESS 20, F ALONG Z TOOL MOST 60 N STIFFNESS 40 N/mm LIMIT 20 mm RATE 10 mm/s" +
              more + "\n" + then,
          period_ms);
    touch(40, [] { return 1297.0; });
  }
  double force = 0;  // N
};

// What is missing, e, obeys e' = -(e + l) / T with l' = e / 4T, so it is (1 - t / 2T) exp(-t / 2T) of what it was.
TEST_F(Press, The_force_follows_its_formula) {
  for (const double ms : {1, 4, 8}) {
    SCOPED_TRACE(ms);
    press("WAIT 3s\nSET OUT = F\nPRESS OFF\nMOVL A\n", ms);
    ASSERT_TRUE(follow([&] { return force >= 4; }));
    const double time = 2 * std::max(0.06, 15 * period);
    const double missing = 20 - force;
    double worst = 0;
    for (double t = 0; t < 2; t += period) {
      worst = std::max(worst, std::abs(20 - missing * (1 - t / time) * std::exp(-t / time) - force));
      EXPECT_NEAR(x(), 200, 1e-6);
      EXPECT_NEAR(y(), 0, 1e-6);
      step();
    }
    EXPECT_LT(worst, 2.5);
    EXPECT_NEAR(force, 20, 0.05);
    ASSERT_TRUE(follow([&] { return ended(); }));
    EXPECT_EQ(cell->out.error, ErrorCode::Ok) << message();
    EXPECT_NEAR(*values["OUT"], 20, 0.05);
    EXPECT_NEAR(z(), 1300, 1e-6);
  }
}

TEST_F(Press, It_settles_at_other_stiffnesses_and_with_a_late_sensor) {
  for (const double stiffness : {5.0, 40.0, 60.0}) {
    SCOPED_TRACE(stiffness);
    press("WAIT 10s\n");
    touch(
        stiffness, [] { return 1297.0; }, 2);
    ASSERT_TRUE(follow([&] { return force >= 4; }));
    double most = 0;
    for (int i = 0; i < 1500; ++i) {
      step();
      most = std::max(most, force);
    }
    EXPECT_LT(most, 30);
    EXPECT_NEAR(force, 20, 0.05);
    EXPECT_EQ(cell->out.error, ErrorCode::Ok) << message();
  }
}

// 4 mm/s up and down, which a sine of this frequency changes by 3 mm/s^2.
TEST_F(Press, Along_a_surface_that_rises_and_falls) {
  press("WAIT 1s\nMOVL B SPEED 100 mm/s\nPRESS OFF\nSET OUT = Z(HERE)\n");
  touch(40, [&] { return 1297 + 5 * std::sin(2 * kPi * (x() - 200) / 800); });
  double worst = 0;
  double steady = 0;
  ASSERT_TRUE(follow([&] {
    const double missing = x() > 200.1 ? std::abs(force - 20) : 0;
    worst = std::max(worst, missing);
    steady = std::max(steady, x() > 400 && x() < 2600 ? missing : 0);
    EXPECT_NEAR(y(), 0, 1e-6);
    return ended();
  }));
  EXPECT_EQ(cell->out.error, ErrorCode::Ok) << message();
  EXPECT_LT(worst, 10);
  EXPECT_LT(steady, 2);
  EXPECT_NEAR(x(), 2700, 1e-6);
  EXPECT_NEAR(*values["OUT"], z(), 1e-6);
}

TEST_F(Press, Without_a_surface_it_stays_at_its_limit) {
  press("WAIT 4s\nMOVL A OFFSET 200, 0, 0 SPEED 100 mm/s\nPRESS OFF\n");
  touch(40, [] { return -HUGE_VAL; });
  double lowest = HUGE_VAL;
  double fastest = 0;
  ASSERT_TRUE(follow([&] {
    const double before = z();
    lowest = std::min(lowest, before);
    fastest = std::max(fastest, x() > 200 ? 0 : cell->out.tool_speed);
    return ended();
  }));
  EXPECT_EQ(cell->out.error, ErrorCode::Ok) << message();
  EXPECT_NEAR(lowest, 1300 - 20, 0.21);
  EXPECT_GE(lowest, 1300 - 20);
}

TEST_F(Press, Too_much_force_ends_the_job) {
  press("WAIT 1s\nMOVL B SPEED 100 mm/s\n");
  touch(40, [&] { return x() > 1000 ? 1320.0 : 1297.0; });
  ASSERT_TRUE(follow([&] { return resting() && ended(); }));
  EXPECT_EQ(cell->out.error, ErrorCode::Line);
  EXPECT_THAT(message(), HasSubstr("more than the MOST of PRESS"));
  EXPECT_LT(x(), 1000 + 60);
}

TEST_F(Press, A_sensor_that_is_silent_or_reports_no_number_ends_the_job) {
  press("WAIT 5s\n", 4, " AGE N 100 ms");
  int count = 0;
  sensor = [&] { *values["N"] += ++count < 900 ? 1 : 0; };
  ASSERT_TRUE(follow([&] { return resting() && ended(); }));
  EXPECT_THAT(message(), HasSubstr("PRESS has had no new measurement"));
  // The line that is wrong is that of the PRESS, whatever line is executed.
  press("WAIT 0.1s\nMOVL B SPEED 100 mm/s\n");
  sensor = [&] { *values["F"] = z() < 1299 ? std::nan("") : 0; };
  ASSERT_TRUE(follow([&] { return resting() && ended(); }));
  EXPECT_EQ(cell->out.error, ErrorCode::Line);
  EXPECT_THAT(message(), HasSubstr(":5:11: this has no value"));
}

TEST_F(Press, In_a_hold_nothing_moves_and_at_a_low_override_it_is_slow) {
  press("WAIT 60s\n");
  ASSERT_TRUE(follow([&] { return z() < 1299; }));
  cell->in.hold = true;
  for (int i = 0; i < 100; ++i) {
    step();
  }
  const double held = z();
  for (int i = 0; i < 250; ++i) {
    step();
    EXPECT_EQ(z(), held);
  }
  cell->in.hold = false;
  cell->in.speed_override = 10;
  for (int i = 0; i < 500; ++i) {
    step();
    EXPECT_LE(cell->out.tool_speed, 1 + 1e-6);
  }
  EXPECT_LT(z(), held - 1);
  cell->in.speed_override = 100;
  ASSERT_TRUE(follow([&] { return force > 19.9; }));
}

TEST_F(Press, A_stopped_job_continues_to_press) {
  press("WAIT 1s\nMOVL B SPEED 200 mm/s\n");
  ASSERT_TRUE(follow([&] { return x() > 800; }));
  cell->ask(Service::JobStop);
  ASSERT_TRUE(follow([&] { return cell->out.state == GroupState::Standby; }));
  EXPECT_NEAR(force, 20, 0.5);
  ASSERT_TRUE(cell->out.job.can_resume);
  cell->ask(Service::JobResume);
  ASSERT_TRUE(follow([&] { return ended(); }));
  EXPECT_EQ(cell->out.error, ErrorCode::Ok) << message();
  EXPECT_NEAR(x(), 2700, 1e-3);
  EXPECT_NEAR(force, 20, 0.5);
}

// Breakpoints and the end of a job wait until it rests; stops of all kinds keep the limits.
TEST_F(Press, It_rests_before_the_job_pauses_or_ends) {
  press("WAIT 0.15s\nSET OUT ON\n");
  cell->in.breakpoints[0] = {1, 7};
  ASSERT_TRUE(
      follow([&] { return cell->out.job.state == JobState::Paused && cell->out.state == GroupState::Standby; }));
  EXPECT_LT(z(), 1300);
  const double paused = z();
  for (int i = 0; i < 100; ++i) {
    step();
    EXPECT_EQ(z(), paused);
  }
  press("WAIT 0.15s\n");
  ASSERT_TRUE(follow([&] { return ended(); }));
  EXPECT_EQ(cell->out.error, ErrorCode::Ok) << message();
  EXPECT_LT(z(), 1300);
}

TEST_F(Press, Stops_of_all_kinds_keep_the_limits) {
  for (int at = 0; at < 12; ++at) {
    SCOPED_TRACE(at);
    press("WAIT 0.6s\nMOVL B SPEED 800 mm/s\n");
    touch(40, [&] { return 1297 + 3 * std::sin(x() / 20); });
    const int before = 20 * at;
    ASSERT_TRUE(follow([&] { return z() < 1300 - 1e-9; }));
    for (int i = 0; i < before; ++i) {
      step();
    }
    stop(at % 3);
    EXPECT_GE(z(), 1300 - 20 - 5);
  }
}

TEST_F(Press, What_would_leave_its_path_is_refused) {
  const std::vector<std::pair<std::string, std::string>> refused{
      {"MOVJ B", "PRESS shifts lines"},
      {"MOVL HERE OFFSET 10, 0, 0", "how far the tool has pressed"},
      {"CORRECT 0, 1, 0 LIMIT 20 mm RATE 50 mm/s", "PRESS is on already"},
      {"CORRECT OFF", "PRESS is on; it ends with PRESS OFF"}};
  for (const auto& [line, why] : refused) {
    press("TRY\n" + line + "\nRECOVER\nPRESS OFF\nSET OUT = ERROR\nMOVL C\nEND\n");
    ASSERT_TRUE(follow([&] { return *values["OUT"] > 0 || ended(); }));
    EXPECT_THAT(message(), HasSubstr(why));
    ASSERT_TRUE(follow([&] { return ended(); }));
    EXPECT_EQ(cell->out.error, ErrorCode::Ok) << message();
  }
}

TEST(Press_lines, Wrong_ones_are_named) {
  const auto errors = [](const std::string& text) { return base::to_text(parse_jobs({{"a.job", text}}).diagnostics); };
  const std::string rest = " MOST 60 N STIFFNESS 40 N/mm LIMIT 5 mm RATE 10 mm/s";
  EXPECT_EQ(
      errors("PRESS 20, -F ALONG Z TOOL" + rest + " AGE N 50 ms\nPRESS OFF\nPRESS G * 2, F ALONG X" + rest + "\n"), "");
  EXPECT_THAT(errors("PRESS 20\n"), HasSubstr("a.job:1:"));
  EXPECT_THAT(errors("PRESS 20, F" + rest + "\n"), HasSubstr("a.job:1:13: error: expected ALONG and X, Y or Z, found"));
  EXPECT_THAT(errors("PRESS 20, F ALONG W" + rest + "\n"), HasSubstr("expected ALONG and X, Y or Z"));
  EXPECT_THAT(errors("PRESS 20, F ALONG Z IN g" + rest + "\n"), HasSubstr("there is no frame 'g'"));
  EXPECT_THAT(errors("PRESS 20, F ALONG Z STIFFNESS 4 N/mm\n"), HasSubstr("expected MOST and a number of N"));
  EXPECT_THAT(errors("PRESS 20, F ALONG Z MOST 60 N STIFFNESS 0 N/mm\n"),
              HasSubstr("STIFFNESS is more than 0 and at most"));
  EXPECT_THAT(errors("PRESS 20, F ALONG Z MOST 60 N STIFFNESS 4 N\n"), HasSubstr("expected N/mm"));
  EXPECT_THAT(errors("VAR n\nPRESS n, F ALONG Z" + rest + "\n"), HasSubstr("none of the job"));
  const std::string above =
      ": error: PRESS fails above its MOST, which is less than this force; MOST has to leave some";
  EXPECT_THAT(errors("PRESS 70, F ALONG Z" + rest + "\n"), HasSubstr("a.job:1:7" + above));
  EXPECT_THAT(errors("PRESS 7 * -10, F ALONG Z" + rest + "\n"), HasSubstr("a.job:1:7" + above));
  EXPECT_THAT(errors("PRESS 20, 80 ALONG Z" + rest + "\n"), HasSubstr("a.job:1:11" + above));
  // Their sum is measured: 63.6 N.
  EXPECT_THAT(errors("PRESS 45, F ALONG Z, 45, G ALONG X" + rest + "\n"), HasSubstr(above));
  EXPECT_EQ(errors("PRESS 42, F ALONG Z, 42, G ALONG X" + rest + "\nPRESS OFF\nPRESS G + 70, F ALONG Z" + rest), "");
}

}  // namespace
}  // namespace indurop::robot
