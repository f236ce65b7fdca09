// SPDX-License-Identifier: Apache-2.0
// Work frames and offsets of jobs: where motions go to, against homogeneous transformations.
#include <gmock/gmock.h>

#include <string>
#include <utility>

#include "job_world.h"
#include "robot_fixture.h"

namespace indurop::robot {
namespace {

using testing::HasSubstr;
using Transform = Eigen::Isometry3d;

class Recorder final : public Signals, public MotionPort {
 public:
  double read(std::size_t) noexcept override { return value; }
  void write(std::size_t, double) noexcept override {}
  [[nodiscard]] bool ready() const noexcept override { return true; }
  [[nodiscard]] bool settled() const noexcept override { return true; }
  Fault move(const MoveCommand& command) noexcept override {
    moves.push_back(command);
    return {};
  }
  double value = 0;
  std::vector<MoveCommand> moves;
};

Transform transform(double x, double y, double z, double roll, double pitch, double yaw) {
  Transform t = Transform::Identity();
  t.translate(Vec3(x, y, z) / 1000);
  t.rotate(Eigen::AngleAxisd(radians(yaw), Vec3::UnitZ()) * Eigen::AngleAxisd(radians(pitch), Vec3::UnitY()) *
           Eigen::AngleAxisd(radians(roll), Vec3::UnitX()));
  return t;
}

std::vector<MoveCommand> moves_of(const std::string& text, double value = 0) {
  auto [book, errors] = parse_jobs({{"a.job", text}});
  EXPECT_TRUE(errors.empty()) << base::to_text(errors);
  const auto wrong = place_frames(book, cell_arm());
  EXPECT_TRUE(wrong.empty()) << base::to_text(wrong);
  JobRunner sut(book);
  Recorder recorder;
  recorder.value = value;
  sut.start(0);
  sut.step(0.01, recorder, recorder);
  EXPECT_EQ(sut.report().state, JobState::Ended) << sut.report().message;
  return recorder.moves;
}

void expect_at(const MoveCommand& move, const Transform& wanted) {
  const Pose& pose = move.target.pose;
  EXPECT_LT((pose.position - wanted.translation()).norm(), 1e-12);
  EXPECT_LT((pose.orientation.toRotationMatrix() - wanted.linear()).norm(), 1e-12);
}

TEST(JobPlaces, Points_are_in_their_frame_and_offsets_along_its_axes) {
  const auto moves = moves_of(
      "MOVL P\nMOVL P OFFSET 10, 20, 30\nMOVL P OFFSET TOOL 0, 0, -50\nMOVJ Q OFFSET 0, 0, I4 * 2 STRAIGHT\nMOVL P\n"
      "POINT P = POSE 100 50 0 RPY 180 0 30 IN pallet\n"
      "POINT Q = POSE 400 0 300 RPY 180 10 0 POSTURE 0\n"
      "FRAME pallet = POSE 500 -200 100 RPY 5 -10 45\n",
      40);
  ASSERT_EQ(moves.size(), 5U);
  const Transform pallet = transform(500, -200, 100, 5, -10, 45);
  const Transform p = transform(100, 50, 0, 180, 0, 30);
  expect_at(moves[0], pallet * p);
  expect_at(moves[1], pallet * Eigen::Translation3d(0.01, 0.02, 0.03) * p);
  expect_at(moves[2], pallet * p * Eigen::Translation3d(0, 0, -0.05));
  expect_at(moves[3], Eigen::Translation3d(0, 0, 0.08) * transform(400, 0, 300, 180, 10, 0));
  EXPECT_TRUE(moves[3].straight);
  expect_at(moves[4], pallet * p);
}

TEST(JobPlaces, A_frame_is_taught_by_three_points) {
  const auto moves = moves_of(
      "FRAME table = POINTS O X Y\n"
      "POINT O = POSE 400 100 200 RPY 180 0 0\n"
      "POINT X = POSE 400 300 200 RPY 90 20 0   # how the tool is turned there does not matter\n"
      "POINT Y = POSE 250 180 200 RPY 180 0 0\n"
      "POINT P = POSE 10 20 30 RPY 180 0 0 IN table\n"
      "MOVL P\n");
  ASSERT_EQ(moves.size(), 1U);
  expect_at(moves[0], transform(400, 100, 200, 0, 0, 90) * transform(10, 20, 30, 180, 0, 0));
}

TEST(JobPlaces, A_frame_may_be_taught_by_joint_angles) {
  const Pose origin = cell_arm().forward(joints_of({0.1, -0.3, 0.4, 0, 1.2, 0}));
  const auto moves = moves_of(
      "POINT O = JOINT 5.729577951308232 -17.188733853924695 22.918311805232928 0 68.75493541569878 0\n"
      "POINT X = POSE " +
      std::to_string(origin.position.x() * 1000 + 100) + " " + std::to_string(origin.position.y() * 1000) + " " +
      std::to_string(origin.position.z() * 1000) +
      " RPY 0 0 0\nPOINT Y = POSE 0 900 0 RPY 0 0 0\nFRAME f = POINTS O, X, Y\nPOINT P = POSE 0 0 0 RPY 0 0 0 IN "
      "f\nMOVL P\n");
  ASSERT_EQ(moves.size(), 1U);
  EXPECT_LT((moves[0].target.pose.position - origin.position).norm(), 1e-9);
}

TEST(JobPlaces, Mistakes_are_named_where_they_are) {
  const std::pair<const char*, const char*> cases[] = {
      {"POINT P = POSE 0 0 0 RPY 0 0 0 IN nowhere\n", "a.job:1:35: error: there is no frame 'nowhere'"},
      {"FRAME f = POSE 0 0 0\n", "a.job:1:21: error: expected RPY"},
      {"FRAME f = POSE 0 0 0 RPY 0 0 0\nFRAME f = POSE 0 0 0 RPY 0 0 0\n",
       "a.job:2:7: error: there is already a frame 'f'"},
      {"FRAME f = POINTS A B\n", "a.job:1:21: error: expected three points"},
      {"FRAME f = POINTS A B C\nPOINT A = POSE 0 0 0 RPY 0 0 0\nPOINT B = POSE 1 0 0 RPY 0 0 0\n",
       "a.job:1:22: error: there is no point 'C'"},
      {"POINT P = JOINT 0 0 0 0 0 0\nMOVL P OFFSET 0, 0, 1\n",
       "a.job:2:6: error: an OFFSET goes from a point given as POSE"},
      {"POINT P = POSE 0 0 0 RPY 0 0 0\nMOVL P OFFSET 0, 0\n", "a.job:2:19: error: expected ','"},
      {"POINT P = POSE 0 0 0 RPY 0 0 0\nMOVL P OFFSET 0 0 -5\n", "a.job:2:17: error: expected ','"},
      {"FRAME f = 3\n", "a.job:1:11: error: expected POSE, POINTS or MATCH"},
  };
  for (const auto& [text, wanted] : cases) {
    EXPECT_THAT(base::to_text(parse_jobs({{"a.job", text}}).diagnostics), HasSubstr(wanted)) << text;
  }
}

TEST(JobPlaces, A_frame_of_points_on_one_line_is_no_frame) {
  const std::pair<const char*, const char*> cases[] = {
      {"POINT Y = POSE 700 0 0 RPY 0 0 0\n", "a.job:1:7: error: frame 'f': its three points lie on one line"},
      {"POINT Y = POSE 500 0 0.5 RPY 0 0 0\n", "frame 'f': two of its points are the same place"},
  };
  for (const auto& [third, wanted] : cases) {
    auto [book, errors] = parse_jobs({{"a.job",
                                       "FRAME f = POINTS O X Y\nPOINT O = POSE 500 0 0 RPY 0 0 0\n"
                                       "POINT X = POSE 600 0 0 RPY 0 0 0\n" +
                                           std::string(third)}});
    ASSERT_TRUE(errors.empty()) << base::to_text(errors);
    EXPECT_THAT(base::to_text(place_frames(book, cell_arm())), HasSubstr(wanted));
  }
}

}  // namespace
}  // namespace indurop::robot
