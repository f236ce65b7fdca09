// SPDX-License-Identifier: Apache-2.0
// Random calibrations whose truth is known: without noise they are exact; with noise, the errors shrink with the number
// of points and are distributed as the estimated deviations say; points that cannot show the result are rejected.
// INDUROP_ROBOT_CALIBRATIONS sets how many.
#include "control/robot/kinematics/calibration.h"

#include <gmock/gmock.h>

#include <array>
#include <cmath>
#include <cstdlib>
#include <random>
#include <vector>

#include "control/robot/kinematics/geometry.h"
#include "robot_fixture.h"

namespace indurop::robot {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;

enum class Kind { Tip, Tool, Frame, Camera, HandCamera };
constexpr std::array kAll{Kind::Tip, Kind::Tool, Kind::Frame, Kind::Camera, Kind::HandCamera};

int calibrations(int usual) {
  return number_of("INDUROP_ROBOT_CALIBRATIONS", usual);
}

class Calibration_of : public testing::Test {
 protected:
  double in(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random); }
  double normal() { return gauss(random); }
  Vec3 noise(double sigma) { return sigma * Vec3(normal(), normal(), normal()); }
  Quat any_turn() { return Quat(normal(), normal(), normal(), normal()).normalized(); }
  Vec3 any_place(double far) { return {in(-far, far), in(-far, far), in(-far, far)}; }
  // Within about 60 degrees of straight down.
  Quat hand_turn() { return Quat(0, 1, 0, 0) * rotation_by({in(-1, 1), in(-1, 1), in(-2, 2)}); }

  // Of an end whose tool has the tip at `at` and its axes turned by `turn`.
  Measured end_with_tip(Mark mark, const Pose& tool, const Vec3& at, const Quat& turn, double sigma) {
    return {mark, {at - turn * tool.position + noise(sigma), turn}, {}};
  }
  std::vector<Measured> of_tool(const Pose& tool, std::size_t count, bool turned, double sigma) {
    const Vec3 tip = any_place(0.5);
    std::vector<Measured> points;
    for (std::size_t i = 0; i < count; ++i) {
      points.push_back(end_with_tip(Mark::Tip, tool, tip, hand_turn(), sigma));
    }
    for (std::size_t i = 0; turned && i < std::max<std::size_t>(1, count / 4); ++i) {
      for (const Mark mark : {Mark::AlongX, Mark::PlaneXZ}) {
        const Quat turn = hand_turn();
        // The fixed place as the tool sees it.
        const Vec3 seen(mark == Mark::AlongX ? in(0.1, 0.2) : in(-0.1, 0.1), 0,
                        mark == Mark::AlongX ? 0 : in(0.1, 0.2));
        points.push_back(end_with_tip(mark, tool, tip - turn * tool.orientation * seen, turn, sigma));
      }
    }
    return points;
  }
  std::vector<Measured> of_frame(const Pose& frame, std::size_t count, double sigma) {
    std::vector<Measured> points;
    for (std::size_t i = 0; i < count; ++i) {
      const std::array<Vec3, 3> places{Vec3::Zero(), Vec3(in(0.2, 0.6), 0, 0), Vec3(in(-0.3, 0.3), in(0.2, 0.5), 0)};
      const std::array marks{Mark::Origin, Mark::OnX, Mark::PlaneXY};
      for (std::size_t k = 0; k < 3; ++k) {
        points.push_back({marks[k], {frame.position + frame.orientation * places[k] + noise(sigma), any_turn()}, {}});
      }
    }
    return points;
  }
  std::vector<Measured> of_camera(const Pose& camera, std::size_t count, double sigma, bool flat = false) {
    std::vector<Measured> points;
    for (std::size_t i = 0; i < count; ++i) {
      Vec3 seen = any_place(0.3);
      seen.z() = flat ? 0 : seen.z();
      points.push_back({Mark::Seen,
                        {camera.position + camera.orientation * seen + noise(sigma), Quat::Identity()},
                        {seen, Quat::Identity()}});
    }
    return points;
  }
  std::vector<Measured> of_hand_camera(const Pose& camera, std::size_t count, double sigma) {
    const Pose thing{any_place(0.5), any_turn()};
    std::vector<Measured> points;
    for (std::size_t i = 0; i < count; ++i) {
      const Pose end{any_place(0.4), hand_turn()};
      Pose seen = inverse_of(end * camera) * thing;
      seen.position += noise(sigma);
      seen.orientation = seen.orientation * rotation_by(noise(sigma / kTurnArm));
      points.push_back({Mark::Seen, end, seen});
    }
    return points;
  }
  Calibrated run(Kind kind, const Pose& truth, std::size_t count, double sigma) {
    switch (kind) {
      case Kind::Tip:
      case Kind::Tool:
        return calibrate_tool(of_tool(truth, count, kind == Kind::Tool, sigma));
      case Kind::Frame:
        return calibrate_frame(of_frame(truth, count, sigma));
      case Kind::Camera:
        return calibrate_camera(of_camera(truth, count, sigma));
      case Kind::HandCamera:
        break;
    }
    return calibrate_hand_camera(of_hand_camera(truth, count, sigma));
  }
  // Position, then rotation vector in the axes of the result.
  static Twist error_of(const Calibrated& found, const Pose& truth) {
    Twist error;
    error.head<3>() = found.result.position - truth.position;
    error.tail<3>() = rotation_between(truth.orientation, found.result.orientation);
    return error;
  }

  std::mt19937 random{1};
  std::normal_distribution<double> gauss;
};

TEST_F(Calibration_of, Points_without_noise_is_exact) {
  for (const Kind kind : kAll) {
    int rejected = 0;
    for (int i = 0; i < calibrations(200); ++i) {
      const Pose truth{any_place(0.3), any_turn()};
      const Calibrated found = run(kind, truth, 6, 0);
      if (!found.wrong.empty()) {
        ++rejected;  // turned too little by chance
        continue;
      }
      const Twist error = error_of(found, truth);
      EXPECT_LT(error.head<3>().norm(), 1e-9) << static_cast<int>(kind);
      EXPECT_LT(kind == Kind::Tip ? 0 : error.tail<3>().norm(), 1e-9) << static_cast<int>(kind);
      EXPECT_LT(found.most, 1e-9);
    }
    EXPECT_LT(rejected, calibrations(200) / 20 + 1) << static_cast<int>(kind);
  }
}

// Of n numbers, e' (sigma^2 C)^-1 e has the mean n and the variance 2 n, and what remains, divided by sigma^2, as many
// as there are spare equations.
TEST_F(Calibration_of, Noise_deviates_as_it_says) {
  constexpr double kSigma = 2e-4;
  const int rounds = calibrations(300);
  for (const Kind kind : kAll) {
    const Eigen::Index numbers = kind == Kind::Tip ? 3 : 6;
    double sum = 0;
    double rest = 0;
    double spare = 0;
    int within = 0;
    int numbers_seen = 0;
    int done = 0;
    for (int i = 0; i < rounds; ++i) {
      const Pose truth{any_place(0.3), any_turn()};
      const Calibrated found = run(kind, truth, 8, kSigma);
      if (!found.wrong.empty()) {
        continue;
      }
      ++done;
      const Twist error = error_of(found, truth);
      const auto cofactor = found.cofactor.topLeftCorner(numbers, numbers);
      sum += error.head(numbers).dot(cofactor.inverse() * error.head(numbers)) / (kSigma * kSigma);
      rest += found.spare * found.sigma * found.sigma / (kSigma * kSigma);
      spare += found.spare;
      const Vec3 place = found.place_deviation();
      for (Eigen::Index k = 0; k < 3; ++k) {
        within += std::abs(error[k]) < place[k] ? 1 : 0;
        ++numbers_seen;
      }
    }
    ASSERT_GT(done, rounds * 9 / 10);
    const double mean = sum / done;
    const auto n = static_cast<double>(numbers);
    EXPECT_NEAR(mean, n, 5 * std::sqrt(2 * n / done)) << static_cast<int>(kind);
    EXPECT_NEAR(rest / spare, 1, 5 * std::sqrt(2 / spare)) << static_cast<int>(kind);
    // 68 % of a normal distribution; a little less of Student's, with few spare equations.
    EXPECT_NEAR(static_cast<double>(within) / numbers_seen, 0.67, 0.06) << static_cast<int>(kind);
    RecordProperty("chi_square_" + std::to_string(static_cast<int>(kind)), std::to_string(mean));
    std::printf("kind %d: chi-square %.3f of %ld, variance of the rest %.4f, within one deviation %.3f, %d of %d\n",
                static_cast<int>(kind), mean, static_cast<long>(numbers), rest / spare,
                static_cast<double>(within) / numbers_seen, done, rounds);
  }
}

TEST_F(Calibration_of, More_points_has_smaller_errors) {
  constexpr double kSigma = 2e-4;
  for (const Kind kind : kAll) {
    std::array<double, 2> squares{};
    const std::array<std::size_t, 2> counts{10, 40};
    for (std::size_t k = 0; k < 2; ++k) {
      int done = 0;
      for (int i = 0; i < calibrations(200); ++i) {
        const Pose truth{any_place(0.3), any_turn()};
        const Calibrated found = run(kind, truth, counts[k], kSigma);
        if (found.wrong.empty()) {
          squares[k] += error_of(found, truth).head<3>().squaredNorm();
          ++done;
        }
      }
      squares[k] = std::sqrt(squares[k] / done);
    }
    // Four times the points, half the error.
    EXPECT_NEAR(squares[0] / squares[1], 2, 0.45) << static_cast<int>(kind);
    std::printf("kind %d: error with 10 points %.4f mm, with 40 %.4f mm\n", static_cast<int>(kind), 1000 * squares[0],
                1000 * squares[1]);
  }
}

TEST_F(Calibration_of, One_wrong_point_names_it) {
  std::vector<Measured> points = of_tool({{0, 0.05, 0.2}, Quat::Identity()}, 8, false, 1e-4);
  points[5].at.position.x() += 0.02;
  Calibrated found = calibrate_tool(points);
  EXPECT_EQ(found.worst, 5U);
  EXPECT_THAT(found.wrong, HasSubstr("point 6 is 1"));
  points = of_camera({{0.5, 0, 0.2}, any_turn()}, 8, 1e-4);
  points[2].at.position.y() += 0.05;
  found = calibrate_camera(points);
  EXPECT_THAT(found.wrong, HasSubstr("point 3 is"));
}

TEST_F(Calibration_of, Too_few_points_are_rejected) {
  const Pose tool{{0, 0.05, 0.2}, any_turn()};
  EXPECT_THAT(calibrate_tool(of_tool(tool, 3, false, 0)).wrong, HasSubstr("a tool needs 4 points"));
  EXPECT_THAT(calibrate_tool({}).wrong, HasSubstr("there are 0"));
  EXPECT_THAT(calibrate_camera(of_camera(tool, 3, 0)).wrong, HasSubstr("a camera needs 4 pairs"));
  EXPECT_THAT(calibrate_hand_camera(of_hand_camera(tool, 3, 0)).wrong, HasSubstr("needs 4 positions"));
  std::vector<Measured> points = of_frame(tool, 1, 0);
  points.pop_back();
  EXPECT_THAT(calibrate_frame(points).wrong, HasSubstr("there is none in the plane"));
  points = of_tool(tool, 6, true, 0);
  points.pop_back();
  EXPECT_THAT(calibrate_tool(points).wrong, HasSubstr("take the missing one"));
}

TEST_F(Calibration_of, Points_that_cannot_show_it_are_rejected) {
  for (int i = 0; i < calibrations(100); ++i) {
    const Pose truth{any_place(0.3), any_turn()};
    const Vec3 place = any_place(0.5);
    const Vec3 axis = any_place(1).normalized();
    std::vector<Measured> about_one;
    std::vector<Measured> little;
    std::vector<Measured> same;
    std::vector<Measured> seen_about_one;
    const Quat first = hand_turn();
    for (int k = 0; k < 6; ++k) {
      about_one.push_back(end_with_tip(Mark::Tip, truth, place, first * rotation_by(0.4 * k * axis), 1e-4));
      little.push_back(end_with_tip(Mark::Tip, truth, place, first * rotation_by(0.02 * any_place(1)), 1e-4));
      same.push_back(end_with_tip(Mark::Tip, truth, place, k < 3 ? hand_turn() : same.back().at.orientation, 1e-4));
      const Pose end{any_place(0.4), first * rotation_by(0.4 * k * axis)};
      seen_about_one.push_back({Mark::Seen, end, inverse_of(end * truth)});
    }
    EXPECT_THAT(calibrate_tool(about_one).wrong, HasSubstr("all about one axis"));
    EXPECT_THAT(calibrate_tool(little).wrong, HasSubstr("are turned by 5 degrees or more from all others"));
    EXPECT_THAT(calibrate_tool(same).wrong, HasSubstr("are turned by 5 degrees or more from all others"));
    EXPECT_THAT(calibrate_hand_camera(seen_about_one).wrong, HasSubstr("all about one axis"));

    std::vector<Measured> line;
    for (int k = 0; k < 6; ++k) {
      const Vec3 seen = 0.1 * k * axis;
      line.push_back({Mark::Seen,
                      {truth.position + truth.orientation * seen + noise(1e-4), Quat::Identity()},
                      {seen, Quat::Identity()}});
    }
    EXPECT_THAT(calibrate_camera(line).wrong, HasSubstr("on one line"));
    std::vector<Measured> corner = of_frame(truth, 1, 0);
    corner[2].at.position = corner[0].at.position + 1.5 * (corner[1].at.position - corner[0].at.position);
    EXPECT_THAT(calibrate_frame(corner).wrong, HasSubstr("the three lie on one line"));
    corner[1].at.position = corner[0].at.position + Vec3(0.001, 0, 0);
    EXPECT_THAT(calibrate_frame(corner).wrong, HasSubstr("less than 10 mm from the origin"));
    std::vector<Measured> tool = of_tool(truth, 6, true, 0);
    if (calibrate_tool(tool).wrong.empty()) {
      tool.back().at = tool[tool.size() - 2].at;
      EXPECT_THAT(calibrate_tool(tool).wrong, HasSubstr("less than 10 mm from the x axis"));
    }
  }
}

TEST_F(Calibration_of, Three_points_of_a_frame_leave_nothing) {
  const Pose truth{any_place(0.3), any_turn()};
  const Calibrated found = calibrate_frame(of_frame(truth, 1, 1e-3));
  EXPECT_THAT(found.wrong, IsEmpty());
  EXPECT_EQ(found.spare, 0);
  EXPECT_EQ(found.sigma, 0);
  EXPECT_LT(found.most, 1e-9);
}

TEST_F(Calibration_of, A_flat_picture_and_its_scale) {
  const Pose truth{any_place(0.3), any_turn()};
  std::vector<Measured> points = of_camera(truth, 5, 0, true);
  EXPECT_LT(error_of(calibrate_camera(points), truth).norm(), 1e-9);
  for (Measured& one : points) {
    one.seen.position *= 0.99;
  }
  EXPECT_NEAR(calibrate_camera(points).scale, 1 / 0.99, 1e-9);
}

}  // namespace
}  // namespace indurop::robot
