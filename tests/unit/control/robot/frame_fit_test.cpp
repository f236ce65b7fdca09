// SPDX-License-Identifier: Apache-2.0
// Where a frame is, from places that are known in it and in the base: random frames are found again, as Horn's method
// by quaternions finds them, and places that cannot show it are rejected.
#include "control/robot/kinematics/frame_fit.h"

#include <gmock/gmock.h>

#include <fstream>
#include <random>
#include <vector>

#include "control/robot/files/files.h"
#include "robot_fixture.h"

namespace indurop::robot {
namespace {

using testing::HasSubstr;

// The rotation by the eigenvector of the largest eigenvalue of a symmetric 4 x 4 matrix (Horn 1987).
Quat horn(const std::vector<MatchedPlace>& places) {
  Vec3 a = Vec3::Zero();
  Vec3 b = Vec3::Zero();
  for (const MatchedPlace& each : places) {
    a += each.in_frame / static_cast<double>(places.size());
    b += each.in_base / static_cast<double>(places.size());
  }
  Mat3 s = Mat3::Zero();
  for (const MatchedPlace& each : places) {
    s += (each.in_frame - a) * (each.in_base - b).transpose();
  }
  Eigen::Matrix4d n;
  n << s.trace(), s(1, 2) - s(2, 1), s(2, 0) - s(0, 2), s(0, 1) - s(1, 0),  //
      s(1, 2) - s(2, 1), s(0, 0) - s(1, 1) - s(2, 2), s(0, 1) + s(1, 0), s(2, 0) + s(0, 2), s(2, 0) - s(0, 2),
      s(0, 1) + s(1, 0), s(1, 1) - s(0, 0) - s(2, 2), s(1, 2) + s(2, 1), s(0, 1) - s(1, 0), s(2, 0) + s(0, 2),
      s(1, 2) + s(2, 1), s(2, 2) - s(0, 0) - s(1, 1);
  // Squared again and again, the matrix projects on the eigenvector of its largest eigenvalue.
  Eigen::Matrix4d power = n + n.norm() * Eigen::Matrix4d::Identity();
  for (int i = 0; i < 60; ++i) {
    power = power * power;
    power /= power.norm();
  }
  Eigen::Index best = 0;
  power.diagonal().maxCoeff(&best);
  const Eigen::Vector4d q = power.col(best).normalized();
  return {q[0], q[1], q[2], q[3]};
}

class Frame_fit : public testing::Test {
 protected:
  double in(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random); }
  Pose any_frame() {
    const Quat turn(std::normal_distribution<double>()(random), std::normal_distribution<double>()(random),
                    std::normal_distribution<double>()(random), std::normal_distribution<double>()(random));
    return {Vec3(in(-1, 1), in(-1, 1), in(-1, 1)), turn.normalized()};
  }
  std::vector<MatchedPlace> seen(const Pose& frame, int count, bool flat, double noise) {
    std::normal_distribution<double> anything(0, 1);
    std::vector<MatchedPlace> places;
    for (int i = 0; i < count; ++i) {
      const Vec3 place(in(-0.2, 0.2), in(-0.2, 0.2), flat ? 0 : in(-0.2, 0.2));
      const Vec3 off = noise * Vec3(anything(random), anything(random), anything(random));
      places.push_back({place, frame.position + frame.orientation * place + off});
    }
    return places;
  }
  std::mt19937 random{1};
};

TEST_F(Frame_fit, Finds_random_frames_again) {
  int lines = 0;
  for (int run = 0; run < 300; ++run) {
    const Pose frame = any_frame();
    const FrameFit found = fit_frame(seen(frame, 4 + run % 10, run % 2 == 0, 0));
    if (!found.wrong.empty()) {
      ++lines;  // random places may be nearly on a line
      continue;
    }
    EXPECT_LT(distance(found.frame, frame), 1e-9) << run;
    EXPECT_LT(found.most_error, 1e-9);
  }
  EXPECT_LE(lines, 3);
}

TEST_F(Frame_fit, Is_that_of_Horns_quaternions_with_noise) {
  for (int run = 0; run < 300; ++run) {
    const auto places = seen(any_frame(), 5 + run % 10, run % 2 == 0, 0.001);
    const FrameFit found = fit_frame(places);
    if (!found.wrong.empty()) {
      continue;  // random places may be nearly on a line
    }
    EXPECT_LT(found.frame.orientation.angularDistance(horn(places)), 1e-7) << run;
    EXPECT_NEAR(found.frame.orientation.toRotationMatrix().determinant(), 1, 1e-9);
  }
}

TEST_F(Frame_fit, Places_that_cannot_show_it_are_rejected) {
  const Pose frame = any_frame();
  std::vector<MatchedPlace> line;
  for (int i = 0; i < 5; ++i) {
    const Vec3 place(0.1 * i, 0.001 * (i % 2), 0);
    line.push_back({place, frame.position + frame.orientation * place});
  }
  EXPECT_THAT(fit_frame(line).wrong, HasSubstr("on one line"));
  EXPECT_THAT(fit_frame(std::vector<MatchedPlace>(2)).wrong, HasSubstr("on one line"));
  auto places = seen(frame, 6, true, 0);
  places[4].in_base += Vec3(0, 0.03, 0);
  const FrameFit found = fit_frame(places);
  EXPECT_THAT(found.wrong, HasSubstr("its places do not match"));
  EXPECT_EQ(found.worst, 4U);
}

class Matched_frames : public testing::Test {
 protected:
  std::string findings(const std::string& job) {
    const std::string folder = testing::TempDir();
    std::ofstream(folder + "/match.urdf") << cell_urdf();
    std::ofstream(folder + "/match.job") << job;
    FileNames names;
    names.urdf = folder + "/match.urdf";
    names.jobs = {folder + "/match.job"};
    return base::to_text(check_module(names, [](const char*) { return std::string(); }).files);
  }
};

// A camera at 500 100 0, turned by 90 degrees about z.
constexpr const char* kTouched =
    "POINT T1 = POSE 480 110 20 RPY 180 0 180\nPOINT T2 = POSE 480 190 20 RPY 180 0 180\n"
    "POINT T3 = POSE 420 190 20 RPY 180 0 180\nPOINT T4 = POSE 420 110.5 20 RPY 180 0 180\n";

TEST_F(Matched_frames, Are_found_and_their_deviation_is_said) {
  const std::string said =
      findings(std::string(kTouched) +
               "FRAME camera = MATCH T1 AT 10 20 20, T2 AT 90 20 20, T3 AT 90 80 20, T4 AT 10 80 20\n"
               "POINT P = POSE 50 0 100 RPY 180 0 0 IN camera\nMOVJ P\n");
  EXPECT_THAT(
      said, HasSubstr("match.job:5:7: note: frame 'camera': POSE 499.92 100.05 0.00 RPY 0.00 0.00 89.91; its points"));
  EXPECT_THAT(said, HasSubstr("its points agree within 0."));
  EXPECT_THAT(said, testing::Not(HasSubstr("error")));
}

TEST_F(Matched_frames, Wrong_lines_are_named) {
  EXPECT_THAT(findings(std::string(kTouched) + "FRAME camera = MATCH T1 AT 10 20 20, T2 AT 90 20 20\n"),
              HasSubstr("a frame is found from 3 to 32 points"));
  EXPECT_THAT(findings(std::string(kTouched) + "FRAME camera = MATCH T1 10 20 20\n"),
              HasSubstr("expected AT and x y z"));
  EXPECT_THAT(findings(std::string(kTouched) + "FRAME camera = MATCH T1 AT 10 20 20, T2 AT 90 20 20, T9 AT 90 80 20\n"),
              HasSubstr("there is no point 'T9'"));
  EXPECT_THAT(
      findings(std::string(kTouched) + "FRAME camera = MATCH T1 AT 10 20 20, T2 AT 90 20 20, T3 AT 90 120 20\n"),
      HasSubstr("its places do not match"));
}

}  // namespace
}  // namespace indurop::robot
