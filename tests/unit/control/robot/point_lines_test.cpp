// SPDX-License-Identifier: Apache-2.0
#include "control/robot/job/point_lines.h"

#include <gmock/gmock.h>

#include <random>

namespace indurop::robot {
namespace {

TEST(Point_lines, A_new_point_stands_at_the_end) {
  EXPECT_EQ(put_point("", 0, "A", "JOINT 1").text, "POINT A = JOINT 1\n");
  const WithPoint out = put_point("POINT A = JOINT 1\n# end", 0, "B", "JOINT 2");
  EXPECT_EQ(out.text, "POINT A = JOINT 1\n# end\nPOINT B = JOINT 2\n");
  EXPECT_EQ(out.line, 3);
}

TEST(Point_lines, Of_the_line_of_a_point_its_place_alone_is_another) {
  const std::string text =
      "# points\r\n  point A = JOINT 1 2   # the first, 3 / 4\r\nPOINT B = JOINT 3 // the second\nMOVJ A\nPOINT "
      "C=JOINT 5";
  EXPECT_EQ(put_point(text, 2, "A", "JOINT 9").text,
            "# points\r\n  POINT A = JOINT 9   # the first, 3 / 4\r\nPOINT B = JOINT 3 // the second\nMOVJ A\n"
            "POINT C=JOINT 5");
  EXPECT_EQ(put_point(text, 3, "B", "POSE 1").text,
            "# points\r\n  point A = JOINT 1 2   # the first, 3 / 4\r\nPOINT B = POSE 1 // the second\nMOVJ A\n"
            "POINT C=JOINT 5");
  EXPECT_THAT(put_point(text, 5, "C", "JOINT 6").text, testing::EndsWith("MOVJ A\nPOINT C = JOINT 6"));
}

// The parser of jobs is the judge: what is written is read as the same place, to the last digit that is written.
TEST(Point_lines, Random_places_are_read_as_they_were_written) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> turn(-3.1, 3.1);
  std::uniform_real_distribution<double> way(-1.5, 1.5);
  const Arm arm({}, {});
  for (int i = 0; i < 500; ++i) {
    Joints joints = Joints::Zero();
    for (int axis = 0; axis < arm.count(); ++axis) {
      joints[axis] = turn(random);
    }
    const auto any = [&] {
      return Pose{{way(random), way(random), way(random)}, from_rpy({turn(random), turn(random), turn(random)})};
    };
    const Pose frame = any();
    const Pose pose = any();
    const std::string text =
        put_point(put_point("FRAME f = " + pose_text(frame) + "\n", 0, "A", joint_text(arm, joints)).text, 0, "B",
                  pose_text(seen_from(frame, pose)) + " IN f")
            .text;
    ReadJobs read = parse_jobs({{"test.job", text}});
    ASSERT_TRUE(read.diagnostics.empty()) << text << base::to_string(read.diagnostics.front());
    ASSERT_TRUE(place_frames(read.book, arm).empty());
    EXPECT_LT((read.book.points[0].target.joints - joints).norm(), 1e-4) << text;
    const Twist off = difference(read.book.points[1].target.pose, pose);
    EXPECT_LT(off.head<3>().norm(), 1e-4) << text;  // a turn of a thousandth of a degree at 2.6 m
    EXPECT_LT(off.tail<3>().norm(), 1e-4) << text;
    EXPECT_EQ(place_text(read.book, read.book.points[0], arm), joint_text(arm, joints));
  }
}

TEST(Point_lines, There_is_no_minus_zero) {
  Joints joints = Joints::Zero();
  joints[1] = -1e-9;
  EXPECT_EQ(joint_text(Arm({}, {}), joints), "JOINT 0 0 0 0 0 0");
}

}  // namespace
}  // namespace indurop::robot
