// SPDX-License-Identifier: Apache-2.0
// What the files of a robot say of its surroundings, for pages that show them.
#include "control/robot/files/list_bodies.h"

#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "control/robot/files/files.h"
#include "robot_fixture.h"

namespace indurop::robot {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

class Listed_bodies : public testing::Test {
 protected:
  Listed_bodies() {
    std::filesystem::create_directories(folder);
    std::ofstream(folder / "arm.urdf") << cell_urdf();
  }
  ~Listed_bodies() override { std::filesystem::remove_all(folder); }
  [[nodiscard]] ListedBodies list(const std::string& job) const {
    std::ofstream(folder / "belt.job") << job;
    return list_bodies({folder / "arm.urdf", {folder / "belt.job"}, {}});
  }
  std::filesystem::path folder =
      std::filesystem::path(testing::TempDir()) /
      (std::string("listed_") + testing::UnitTest::GetInstance()->current_test_info()->name());
};

const std::string kBeltJob = R"(POINT BEGIN = POSE 400 -300 50 RPY 180 0 0
POINT END   = POSE 400 300 50 RPY 180 0 0
POINT SIDE  = POSE 300 -300 50 RPY 180 0 0
FRAME conveyor = POINTS BEGIN END SIDE
FRAME pallet   = POSE 420 -120 30 RPY 0 0 90
FRAME part     = POSE 450 0 50 RPY 0 0 0
FRAME disc     = POSE -300 0 50 RPY 0 0 0
POINT ABOVE    = POSE 0 0 80 RPY 180 0 0 IN part
POINT FIRST    = POSE 10 20 5 RPY 180 0 0 IN pallet
part = conveyor : POSE 100, 0, 0 RPY 0, 0, 0
TRACK part ON BELT 2 ALONG conveyor
TRACK OFF
TRACK part ON BELT 2 ALONG conveyor
TRACK OFF
TRACK part ON TABLE 1 ABOUT disc
TRACK OFF
)";

TEST_F(Listed_bodies, Frames_have_their_places_and_points) {
  const ListedBodies now = list(kBeltJob);
  ASSERT_THAT(now.problem, IsEmpty());
  EXPECT_THAT(now.frames, ElementsAre("conveyor", "pallet", "part", "disc"));
  ASSERT_EQ(now.work_frames.size(), 4U);
  const ListedFrame& conveyor = now.work_frames[0];
  EXPECT_NEAR(conveyor.position[1], -300, 1e-9);
  EXPECT_NEAR(conveyor.orientation[2], 90, 1e-9);
  EXPECT_FALSE(conveyor.computed);
  const ListedFrame& pallet = now.work_frames[1];
  ASSERT_EQ(pallet.points.size(), 1U);
  EXPECT_EQ(pallet.points[0].name, "FIRST");
  EXPECT_NEAR(pallet.points[0].position[0], 420 - 20, 1e-9);
  EXPECT_NEAR(pallet.points[0].position[1], -120 + 10, 1e-9);
  EXPECT_NEAR(pallet.points[0].position[2], 35, 1e-9);
  EXPECT_TRUE(now.work_frames[2].computed);
  EXPECT_THAT(now.work_frames[3].points, IsEmpty());
}

TEST_F(Listed_bodies, Belts_and_tables_that_jobs_track_are_listed_once) {
  const ListedBodies now = list(kBeltJob);
  ASSERT_EQ(now.belts.size(), 2U);
  EXPECT_EQ(now.belts[0].number, 2);
  EXPECT_FALSE(now.belts[0].turns);
  EXPECT_EQ(now.belts[0].along, "conveyor");
  EXPECT_EQ(now.belts[0].part, "part");
  EXPECT_NEAR(now.belts[0].length, 600, 1e-9);
  EXPECT_EQ(now.belts[1].number, 1);
  EXPECT_TRUE(now.belts[1].turns);
  EXPECT_EQ(now.belts[1].along, "disc");
  EXPECT_EQ(now.belts[1].length, 0);
}

TEST_F(Listed_bodies, Nothing_is_shown_of_files_with_errors) {
  const ListedBodies now = list(kBeltJob + "MOVL NOWHERE\n");
  EXPECT_THAT(now.problem, HasSubstr("NOWHERE"));
  EXPECT_THAT(now.work_frames, IsEmpty());
  EXPECT_THAT(now.belts, IsEmpty());
  EXPECT_EQ(now.frames.size(), 4U);
}

}  // namespace
}  // namespace indurop::robot
