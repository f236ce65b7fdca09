// SPDX-License-Identifier: Apache-2.0
// Outputs that follow an expression: proportional to the reported speed of the tip, and 0 whenever the job does not
// run.
#include <gmock/gmock.h>

#include <algorithm>

#include "control/robot/job/job.h"
#include "corrected_cell.h"

namespace indurop::robot {
namespace {

using testing::HasSubstr;

class Followed_outputs : public CorrectedCell {};

TEST_F(Followed_outputs, Are_proportional_to_the_speed_of_the_tip) {
  start(std::string(kSeam) + "MOVL A\nFOLLOW GLUE = 0.02 * TIPSPEED\nMOVL B SPEED 400 mm/s\nFOLLOW GLUE OFF\nMOVL C\n");
  double last = 0;
  double most = 0;
  ASSERT_TRUE(follow([&] {
    if (x() > 210 && x() < 2690) {
      EXPECT_NEAR(*values["GLUE"], 0.02 * last, 1e-6);
      most = std::max(most, *values["GLUE"]);
    }
    last = cell->out.tool_speed;
    return x() > 2690;
  }));
  EXPECT_NEAR(most, 8, 0.01);
  ASSERT_TRUE(follow([&] { return y() > 1; }));
  ASSERT_TRUE(follow([&] {
    EXPECT_EQ(*values["GLUE"], 0);
    return ended();
  }));
}

TEST_F(Followed_outputs, Are_off_whenever_the_job_does_not_run) {
  for (const Service how : {Service::JobStop, Service::GroupDisable}) {
    start(std::string(kSeam) + "MOVL A\nFOLLOW GLUE = 5\nMOVL B SPEED 400 mm/s\n");
    ASSERT_TRUE(follow([&] { return x() > 800; }));
    EXPECT_EQ(*values["GLUE"], 5);
    cell->ask(how);
    step();
    step();
    EXPECT_EQ(*values["GLUE"], 0);
    ASSERT_TRUE(follow([&] { return cell->out.tool_speed == 0 && ended(); }));
    EXPECT_EQ(*values["GLUE"], 0);
    if (how == Service::JobStop) {
      cell->ask(Service::JobResume);
      ASSERT_TRUE(follow([&] { return x() > 1200; }));
      EXPECT_EQ(*values["GLUE"], 5);
      ASSERT_TRUE(follow([&] { return ended(); }));
      EXPECT_EQ(*values["GLUE"], 0);
    }
  }
}

TEST_F(Followed_outputs, End_by_a_set_and_a_failed_job) {
  start(std::string(kSeam) +
        "MOVL A\nFOLLOW GLUE = 5\nMOVL A OFFSET 300, 0, 0\nSET GLUE = 2\nMOVL B\nFOLLOW OTHER = 100 / "
        "DY\nWAIT 1s\n");
  sensor = [&] { *values["DY"] = x() > 2690 && *values["OTHER"] > 0 ? 0 : 4; };
  ASSERT_TRUE(follow([&] { return x() > 1000; }));
  EXPECT_EQ(*values["GLUE"], 2);
  ASSERT_TRUE(follow([&] { return *values["OTHER"] == 25; }));
  ASSERT_TRUE(follow([&] { return ended(); }));
  EXPECT_THAT(message(), HasSubstr("divides by 0"));
  EXPECT_EQ(*values["OTHER"], 0);
  EXPECT_EQ(cell->out.error, ErrorCode::Line);
}

TEST(Followed_output_lines, Wrong_ones_are_named) {
  const auto errors = [](const std::string& text) { return base::to_text(parse_jobs({{"a.job", text}}).diagnostics); };
  EXPECT_THAT(errors("VAR n\nFOLLOW O9 = n * TIPSPEED\n"), HasSubstr("none of the job"));
  EXPECT_EQ(errors("FOLLOW O9 = 0.02 * TIPSPEED\nFOLLOW O9 OFF\n"), "");
}

}  // namespace
}  // namespace indurop::robot
