// SPDX-License-Identifier: Apache-2.0
// Jobs whose tool weaves across lines, circles and splines: compared with a formula that is written otherwise, whatever
// the speed, and with the same path without a wave.
#include <gmock/gmock.h>

#include <cmath>
#include <vector>

#include "control/robot/job/job.h"
#include "corrected_cell.h"
#include "weave_reference.h"

namespace indurop::robot {
namespace {

using testing::HasSubstr;

class Weave : public CorrectedCell {
 protected:
  // Runs the job to its end, and calls `each` in each period in which OUT is 1.
  template <class Each>
  void run(const std::string& job, const Each& each, double period_ms = 4) {
    start(job, period_ms);
    ASSERT_TRUE(follow(
        [&] {
          if (*values["OUT"] == 1) {
            each();
          }
          return ended();
        },
        100'000));
    EXPECT_EQ(cell->out.error, ErrorCode::Ok) << message();
  }
};

// The line from A to B along x; the tool points down, so y is to its left.
TEST_F(Weave, Is_the_same_at_any_speed_and_override) {
  for (const WaveShape shape : {WaveShape::Sine, WaveShape::Triangle, WaveShape::Trapezoid}) {
    for (const double speed : {30.0, 400.0}) {
      SCOPED_TRACE(speed);
      double far = 0;
      int count = 0;
      run(std::string(kSeam) + "MOVL A\nWEAVE " + word_of(shape) + " WIDTH 12 mm LENGTH 40 mm\nSPEED " +
              std::to_string(speed) + " mm/s\nSET OUT = 1\nMOVL A OFFSET 500, 0, 0\nWEAVE OFF\nSET OUT = 2\n",
          [&] {
            cell->in.speed_override = ++count / 100 % 2 == 0 ? 100 : 40;
            EXPECT_NEAR(y(), wave_reference(shape, 12, 40, x() - 200, 500), 1e-6) << x();
            EXPECT_NEAR(z(), 1300, 1e-6);
            far = std::max(far, std::abs(y()));
          });
      EXPECT_GT(far, 5.9);
      EXPECT_NEAR(x(), 700, 1e-6);
      EXPECT_NEAR(y(), 0, 1e-6);
    }
  }
}

TEST_F(Weave, Its_plane_may_be_turned) {
  constexpr double kTurned = 30 * kPi / 180;
  run(std::string(kSeam) +
          "MOVL A\nWEAVE SINE WIDTH 12 mm LENGTH 40 mm TURNED 30\nSPEED 100 mm/s\nSET OUT = 1\nMOVL A OFFSET 500, 0, "
          "0\nSET OUT = 2\n",
      [&] {
        const double far = wave_reference(WaveShape::Sine, 12, 40, x() - 200, 500);
        EXPECT_NEAR(y(), far * std::cos(kTurned), 1e-6);
        EXPECT_NEAR(z() - 1300, far * std::sin(kTurned), 1e-6);
      });
}

TEST_F(Weave, Follows_a_circle) {
  // Around (1200, 400), from its left over its lower end to its right: to the left of the motion is inside.
  run("POINT A = POSE 900 400 1300 RPY 180 0 0\nPOINT M = POSE 1200 100 1300 RPY 180 0 0\nPOINT B = POSE 1500 400 1300 "
      "RPY 180 0 0\nMOVL A\nWEAVE TRIANGLE WIDTH 20 mm LENGTH 50 mm\nSPEED 150 mm/s\nSET OUT = 1\nMOVC M B\nSET OUT = "
      "2\n",
      [&] {
        const double radius = std::hypot(x() - 1200, y() - 400);
        const double turned = std::atan2(y() - 400, x() - 1200) + kPi;
        const double gone = 300 * (turned > 1.5 * kPi ? 0 : turned);
        EXPECT_NEAR(300 - radius, wave_reference(WaveShape::Triangle, 20, 50, gone, 300 * kPi), 1e-5) << gone;
      });
}

TEST_F(Weave, Follows_a_spline) {
  const std::string points = std::string(kSeam) +
                             "POINT S1 = POSE 500 150 1300 RPY 180 0 0\nPOINT S2 = POSE 800 -50 1300 RPY 180 0 0\n"
                             "POINT S3 = POSE 1100 100 1300 RPY 180 0 0\nMOVL A\n";
  // Without a wave, slowly: a polygon of many short sides.
  std::vector<Vec3> places;
  std::vector<double> at;
  run(points + "SET OUT = 1\nMOVS S1 S2 S3 SPEED 30 mm/s\nSET OUT = 2\n", [&] {
    const Vec3 place(x(), y(), z());
    if (places.empty() || (place - places.back()).norm() > 1e-9) {
      at.push_back(places.empty() ? 0 : at.back() + (place - places.back()).norm());
      places.push_back(place);
    }
  });
  std::size_t k = 0;
  double far = 0;
  run(points + "WEAVE SINE WIDTH 10 mm LENGTH 30 mm\nSET OUT = 1\nMOVS S1 S2 S3 SPEED 100 mm/s\nSET OUT = 2\n", [&] {
    // The side on whose normal the tip is, from the last one on.
    const Vec3 place(x(), y(), z());
    while (k + 2 < places.size() && (place - places[k + 1]).dot(places[k + 1] - places[k]) > 0) {
      ++k;
    }
    const Vec3 side = places[k + 1] - places[k];
    const double along = (place - places[k]).dot(side) / side.norm();
    const double left = (Vec3::UnitZ().cross(side) / side.norm()).dot(place - places[k]);
    EXPECT_NEAR(left, wave_reference(WaveShape::Sine, 10, 30, at[k] + along, at.back()), 0.01) << at[k];
    far = std::max(far, std::abs(left));
  });
  EXPECT_GT(far, 4.9);
  EXPECT_NEAR(x(), 1100, 1e-6);
}

TEST_F(Weave, A_short_line_has_a_small_wave) {
  double far = 0;
  run(std::string(kSeam) +
          "MOVL A\nWEAVE SINE WIDTH 12 mm LENGTH 40 mm\nSPEED 100 mm/s\nSET OUT = 1\nMOVL A OFFSET 30, 0, 0\nSET OUT = "
          "2\n",
      [&] {
        EXPECT_NEAR(y(), wave_reference(WaveShape::Sine, 12, 40, x() - 200, 30), 1e-6);
        far = std::max(far, std::abs(y()));
      });
  EXPECT_GT(far, 0.5);
}

// From a resume on, and after steps back, the tip is on the same wave.
TEST_F(Weave, A_stopped_job_continues_on_it) {
  start(std::string(kSeam) + "MOVL A\nWEAVE SINE WIDTH 12 mm LENGTH 40 mm\nMOVL B SPEED 200 mm/s\n");
  ASSERT_TRUE(follow([&] { return x() > 800; }));
  cell->ask(Service::JobStop);
  ASSERT_TRUE(follow([&] { return cell->out.state == GroupState::Standby; }));
  EXPECT_NEAR(y(), wave_reference(WaveShape::Sine, 12, 40, x() - 200, 2500), 1e-6);
  ASSERT_TRUE(cell->out.job.can_resume);
  cell->ask(Service::JobResume);
  ASSERT_TRUE(follow([&] {
    EXPECT_NEAR(y(), wave_reference(WaveShape::Sine, 12, 40, x() - 200, 2500), 1e-6);
    return ended();
  }));
  EXPECT_EQ(cell->out.error, ErrorCode::Ok) << message();
  EXPECT_NEAR(x(), 2700, 1e-6);
}

TEST_F(Weave, Joint_motions_zones_and_interrupts_are_without_it) {
  start("TOOL t = POSE 0 0 50 RPY 0 0 0\n" + std::string(kSeam) +
            "MOVL A\nON I4 CALL aside\nWEAVE SINE WIDTH 12 mm LENGTH 40 mm\nZONE 50 mm\nMOVL B SPEED 300 mm/s\nMOVL C "
            "SPEED 300 mm/s\nMOVJ A\nSET OUT = 1\n",
        4, urdf_of("gantry"), {{"aside", "MOVL BACK OFFSET 0, 0, 100 SPEED 200 mm/s\nMOVL BACK\nSET SEEN = 1\n"}});
  bool passed = false;
  sensor = [&] { *values["I4"] = x() > 1000 ? 1 : 0; };
  ASSERT_TRUE(follow([&] {
    passed = passed || std::hypot(x() - 2700, y()) < 1e-6;
    if (z() > 1310) {
      EXPECT_NEAR(y(), wave_reference(WaveShape::Sine, 12, 40, x() - 200, 2500), 1e-3);
    }
    return ended();
  }));
  EXPECT_EQ(cell->out.error, ErrorCode::Ok) << message();
  EXPECT_TRUE(passed) << "ZONE does not count while it weaves";
  EXPECT_EQ(*values["SEEN"], 1);
}

TEST_F(Weave, A_correction_is_added) {
  sensor = [&] { *values["DY"] = 8; };
  run(std::string(kSeam) +
          "MOVL A\nCORRECT 0, DY, 0 LIMIT 20 mm RATE 50 mm/s\nWEAVE SINE WIDTH 12 mm LENGTH 40 mm\nSET OUT = 1\nMOVL B "
          "SPEED 200 mm/s\nSET OUT = 2\nCORRECT OFF\n",
      [&] {
        if (x() > 500) {
          EXPECT_NEAR(y() - 8, wave_reference(WaveShape::Sine, 12, 40, x() - 200, 2500), 1e-3);
        }
      });
}

TEST_F(Weave, A_side_out_of_the_workspace_is_refused) {
  Settings settings;
  settings.workspace = {0, -5, 0, 3000, 500, 2000};
  cell = std::make_unique<Cell>(std::string(kSeam) + "MOVL A\nWEAVE SINE WIDTH 12 mm LENGTH 40 mm\nMOVL B\n", 4, 0,
                                true, settings, urdf_of("gantry"));
  ASSERT_TRUE(cell->serve(Service::GroupEnable));
  begin();
  ASSERT_TRUE(cell->until([&] { return ended(); }));
  EXPECT_EQ(cell->out.error, ErrorCode::Workspace) << message();
  EXPECT_NEAR(x(), 200, 1e-6);
}

TEST_F(Weave, A_tool_that_points_along_the_line_has_no_side) {
  start("POINT A = POSE 500 0 900 RPY 180 0 0\nMOVL A\nWEAVE SINE WIDTH 12 mm LENGTH 40 mm\nMOVL A OFFSET 0, 0, 200\n");
  ASSERT_TRUE(follow([&] { return ended(); }));
  EXPECT_EQ(cell->out.error, ErrorCode::Wave);
  EXPECT_THAT(message(), HasSubstr("main.job:4: the tool points along the way"));
  EXPECT_NEAR(z(), 900, 1e-6);
}

TEST(Weave_lines, Wrong_ones_are_named) {
  const auto errors = [](const std::string& text) { return base::to_text(parse_jobs({{"a.job", text}}).diagnostics); };
  EXPECT_EQ(errors("WEAVE SINE WIDTH 6 mm LENGTH 4 mm\nWEAVE TRIANGLE WIDTH 6 mm LENGTH 4 mm TURNED -30\nWEAVE OFF\n"),
            "");
  EXPECT_THAT(errors("WEAVE\n"), HasSubstr("a.job:1:6: error: expected SINE, TRIANGLE, TRAPEZOID or OFF"));
  EXPECT_THAT(errors("WEAVE SINE 6 mm\n"), HasSubstr("a.job:1:12: error: expected WIDTH and a number of mm"));
  EXPECT_THAT(errors("WEAVE SINE WIDTH 6 LENGTH 4 mm\n"), HasSubstr("expected mm, found 'LENGTH'"));
  EXPECT_THAT(errors("WEAVE SINE WIDTH 0.2 mm LENGTH 4 mm\n"), HasSubstr("0.5 to 200 mm wide"));
  EXPECT_THAT(errors("WEAVE SINE WIDTH 6 mm LENGTH 4000 mm\n"), HasSubstr("0.5 to 1000 mm long"));
  EXPECT_THAT(errors("WEAVE SINE WIDTH 6 mm\n"), HasSubstr("expected LENGTH"));
  EXPECT_THAT(errors("WEAVE SINE WIDTH 6 mm LENGTH 4 mm TURNED 200\n"), HasSubstr("-180 to 180 degrees"));
}

}  // namespace
}  // namespace indurop::robot
