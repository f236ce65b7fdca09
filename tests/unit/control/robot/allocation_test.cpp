// SPDX-License-Identifier: Apache-2.0
// The controller's step allocates nothing: not while it plans, blends, calculates inverse kinematics in either way,
// runs a job, or fails.

#include <gtest/gtest.h>

#include "heavy_arm.h"
#include "robot_fixture.h"
#include "tests/unit/allocations.h"

namespace indurop::robot {
namespace {

class NoSignals final : public Signals {
 public:
  double read(std::size_t /*index*/) noexcept override { return 1; }
  void write(std::size_t /*index*/, double /*value*/) noexcept override {}
};

// Runs job 1 with drives that follow their commands; returns what the steps allocated.
std::uint64_t allocations_of(const std::string& urdf, const std::string& job, Outputs& out, std::string& message,
                             const Settings& settings = {}) {
  const auto sut = controller_of(urdf, job, settings);
  NoSignals signals;
  Inputs in;
  const std::uint64_t before = g_allocations;
  for (int i = 0; i < 3000; ++i) {
    sut->step(in, signals, out);
    for (std::size_t k = 0; k < kJoints; ++k) {
      in.drives[k] = {0, 0x27, out.drives[k].mode, out.drives[k].position};
    }
    if (i == 2 || i == 100) {  // power is requested once drives that had it have had time to switch off
      in.service.code = static_cast<std::int32_t>(i == 2 ? Service::GroupEnable : Service::JobStart);
      in.service.job = 1;
      ++in.service.number;
    }
    in.speed_override = i % 200 < 20 ? 30 : 100;
    in.answer = {static_cast<std::uint32_t>(i / 5), out.job.question.number, i % 3 == 0 ? 20.0 : 50.0};
  }
  const std::uint64_t counted = g_allocations - before;
  message = out.job.message;  // lives as long as the controller
  return counted;
}

TEST(RobotAllocation, A_whole_job_allocates_nothing) {
  Outputs out;
  std::string message;
  const std::string job =
      "POINT A = JOINT 20 10 -20 0 60 0\nPOINT B = POSE 500 100 400 RPY 180 0 180\n"
      "POINT C = POSE 500 -100 500 RPY 180 0 180\nPOINT FAR = POSE 3000 0 0 RPY 0 0 0\n"
      "LOOP 3\nZONE 50\nMOVJ A\nMOVL B\nMOVL C\nSET O1 ON\nWAIT 50ms\n"
      "ASK n = \"part \", O1, \" of how many?\" 1 TO 40 TIMEOUT 0.1s ELSE\nEND\nEND\nMOVC B A\nMOVL FAR\n";
  EXPECT_EQ(allocations_of(cell_urdf(), job, out, message), 0U);
  EXPECT_EQ(out.job.state, JobState::Failed);  // it came to its last line
  EXPECT_EQ(out.error, ErrorCode::Unreachable);
}

TEST(RobotAllocation, Neither_does_a_path_that_is_corrected) {
  Outputs out;
  std::string message;
  const std::string job =
      "POINT A = POSE 500 100 400 RPY 180 0 180\nPOINT B = POSE 500 -100 400 RPY 180 0 180\nMOVJ A\n"
      "CORRECT 5 * SIN(200 * TIME), 0, I1 LIMIT 20 mm RATE 50 mm/s\nFOLLOW O9 = 0.02 * TIPSPEED\nLOOP 3\nMOVL B\n"
      "MOVL A\nEND\nCORRECT OFF\n";
  EXPECT_EQ(allocations_of(cell_urdf(), job, out, message), 0U);
  EXPECT_EQ(out.job.state, JobState::Ended) << message;
}

TEST(RobotAllocation, Neither_does_one_with_a_tool_that_presses) {
  Outputs out;
  std::string message;
  const std::string job =
      "POINT A = POSE 500 100 400 RPY 180 0 180\nPOINT B = POSE 500 -100 400 RPY 180 0 180\nMOVJ A\n"
      "PRESS 5, 20 * SIN(200 * TIME) ALONG Z TOOL MOST 60 N STIFFNESS 4 N/mm LIMIT 20 mm RATE 50 mm/s\nWAIT 0.5s\n"
      "LOOP 3\nMOVL B\nMOVL A\nEND\nPRESS OFF\n";
  EXPECT_EQ(allocations_of(cell_urdf(), job, out, message), 0U);
  EXPECT_EQ(out.job.state, JobState::Ended) << message;
}

TEST(RobotAllocation, Neither_does_one_with_a_wave) {
  Outputs out;
  std::string message;
  const std::string job =
      "POINT A = POSE 500 100 400 RPY 180 0 180\nPOINT B = POSE 500 -100 400 RPY 180 0 180\nPOINT C = POSE 550 0 400 "
      "RPY 180 0 180\nMOVJ A\nWEAVE TRIANGLE WIDTH 6 mm LENGTH 60 mm\nMOVL B\nMOVC C A\nMOVS C B A\n";
  EXPECT_EQ(allocations_of(cell_urdf(), job, out, message), 0U);
  EXPECT_EQ(out.job.state, JobState::Ended) << message;
}

TEST(RobotAllocation, Neither_does_one_whose_torques_are_limited) {
  Outputs out;
  std::string message;
  const std::string job =
      "POINT A = JOINT 20 10 -20 0 60 0\nPOINT B = POSE 500 100 400 RPY 180 0 180\n"
      "POINT C = POSE 500 -100 500 RPY 180 0 180\nLOAD 3 kg CENTRE 0 0 50\n"
      "LOOP 3\nZONE 50\nMOVJ A\nMOVL B\nMOVL C\nZONE 0\nMOVJ A\nMOVL B\nLOAD 0\nEND\n";
  const HeavyArm heavy = heavy_cell_arm(joints_of({250, 250, 130, 26, 22, 12}));
  Settings settings;
  settings.rated_torque = {400, 400, 200, 60, 50, 30};
  settings.collision_limit = std::vector<double>(6, 1e6);  // its drives tell no torque
  EXPECT_EQ(allocations_of(heavy.urdf, job, out, message, settings), 0U);
  EXPECT_EQ(out.job.state, JobState::Ended) << message;
}

TEST(RobotAllocation, Neither_does_an_arm_without_closed_form) {
  std::string urdf = cell_urdf();
  const std::string wrist = "<origin xyz=\"0.09 0 0\" rpy=\"0 0 0\"/>";
  urdf.replace(urdf.find(wrist), wrist.size(), "<origin xyz=\"0.09 0 0.04\" rpy=\"0 0 0\"/>");
  Outputs out;
  std::string message;
  const std::string job =
      "POINT A = JOINT 20 10 -20 0 60 0\nPOINT B = POSE 500 100 400 RPY 180 0 180\nMOVJ A\nMOVJ B\nMOVL A\n";
  EXPECT_EQ(allocations_of(urdf, job, out, message), 0U);
  EXPECT_EQ(out.job.state, JobState::Ended) << message;
}

}  // namespace
}  // namespace indurop::robot
