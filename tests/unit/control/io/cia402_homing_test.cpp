// SPDX-License-Identifier: Apache-2.0
// The homing methods of CiA 402 against where the pictures of IEC 61800-7-201 put the home position, from any place on
// the way, with any place of the switches.
#include "control/io/cia402_homing.h"

#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <random>
#include <string>

#include "control/io/cia402_drive.h"

namespace indurop::io {
namespace {

constexpr double kLow = -1000;
constexpr double kHigh = 1000;
constexpr double kNear = 0.1;  // degrees

double mark_above(double mark, double at) {
  return mark + std::ceil((at - mark) / 360) * 360;
}
double mark_below(double mark, double at) {
  return mark + std::floor((at - mark) / 360) * 360;
}

// The picture of each method: the edge of a switch, and on which side of it the mark is.
double expected(int method, const config::IoAxis& axis, double start) {
  const double left = axis.home_from.value_or(0);
  const double right = axis.home_to.value_or(0);
  const bool marks = method <= 14 || method == 33 || method == 34;
  const int picture = method >= 17 && method <= 30 ? method - 16 : method;
  struct Place {
    double edge;
    bool above;
  };
  const Place place = [&]() -> Place {
    switch (picture) {
      case 1:
        return {kLow, true};
      case 2:
        return {kHigh, false};
      case 3:
        return {left, false};
      case 4:
        return {left, true};
      case 5:
        return {right, true};
      case 6:
        return {right, false};
      case 7:
      case 14:
        return {left, false};
      case 8:
      case 13:
        return {left, true};
      case 9:
      case 12:
        return {right, false};
      case 10:
      case 11:
        return {right, true};
      default:
        return {start, picture == 34};
    }
  }();
  return !marks ? place.edge : place.above ? mark_above(axis.mark, place.edge) : mark_below(axis.mark, place.edge);
}

std::optional<double> found(const config::IoAxis& axis, double start) {
  Homing sut(axis);
  sut.start();
  double at = start;
  double before = start;
  constexpr double kStep = 5e-4;
  for (int i = 0; i < 1'000'000 && sut.state() == Homing::State::Moving; ++i) {
    const double speed = sut.step(before, at);
    before = at;
    at += speed * kStep;
  }
  return sut.state() == Homing::State::Done ? std::optional(sut.home()) : std::nullopt;
}

class HomingMethod : public testing::TestWithParam<int> {
 protected:
  config::IoAxis axis_with(std::mt19937& random) const {
    const int picture = GetParam() >= 17 && GetParam() <= 30 ? GetParam() - 16 : GetParam();
    std::uniform_real_distribution<double> any(-500, 500);
    config::IoAxis axis;
    axis.homing = GetParam();
    axis.low_limit = kLow;
    axis.high_limit = kHigh;
    axis.mark = any(random) / 3;
    axis.home_speed = 400;
    axis.creep_speed = 100;
    axis.home_from = any(random);
    axis.home_to = *axis.home_from + 30 + std::fabs(any(random)) / 5;
    if (picture == 3 || picture == 4) {
      axis.home_to.reset();
    } else if (picture == 5 || picture == 6) {
      axis.home_from.reset();
    }
    return axis;
  }
};

TEST_P(HomingMethod, Finds_the_place_of_the_standards_picture_from_everywhere) {
  std::mt19937 random(static_cast<unsigned>(GetParam()));
  std::uniform_real_distribution<double> anywhere(-990, 990);
  for (int i = 0; i < 40; ++i) {
    const config::IoAxis axis = axis_with(random);
    const double start = anywhere(random);
    const auto home = found(axis, start);
    ASSERT_TRUE(home) << "from " << start;
    EXPECT_NEAR(*home, expected(GetParam(), axis, start), kNear)
        << "from " << start << ", home switch " << axis.home_from.value_or(kLow) << " to "
        << axis.home_to.value_or(kHigh) << ", mark " << axis.mark;
  }
}

INSTANTIATE_TEST_SUITE_P(All, HomingMethod,
                         testing::Values(1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 17, 18, 19, 20, 21, 22, 23, 24,
                                         25, 26, 27, 28, 29, 30, 33, 34, 35, 37),
                         [](const auto& named) { return "method_" + std::to_string(named.param); });

TEST(Homing, Without_the_switch_it_fails_at_the_second_end) {
  config::IoAxis axis;
  axis.homing = 8;
  axis.low_limit = kLow;
  axis.high_limit = kHigh;
  axis.home_speed = 400;
  EXPECT_FALSE(found(axis, 0));
}

// Through the drive: with inertia, ramps and a limited torque.
TEST(Homing, A_drive_finds_the_edge_and_counts_from_there) {
  config::IoAxis axis;
  axis.counts = 360'000;
  axis.homing = 24;
  axis.start = 50;
  axis.low_limit = -100;
  axis.high_limit = 100;
  axis.home_from = 20;
  axis.home_to = 40;
  Cia402Drive sut(axis);
  DriveCommand command;
  command.mode = 6;
  DriveFeedback now;
  constexpr std::uint16_t kStarting[] = {0x00, 0x06, 0x07, 0x0F, 0x1F};
  for (const std::uint16_t control : kStarting) {
    command.control = control;
    now = sut.step(command, std::chrono::milliseconds(1));
  }
  for (int i = 0; i < 60'000 && (now.status & kModeBit12) == 0; ++i) {
    now = sut.step(command, std::chrono::milliseconds(1));
    ASSERT_EQ(now.status & kModeBit13, 0);
  }
  ASSERT_NE(now.status & kModeBit12, 0);
  for (int i = 0; i < 500; ++i) {
    now = sut.step(command, std::chrono::milliseconds(1));
  }
  EXPECT_NE(now.status & kTargetReached, 0);
  EXPECT_EQ(now.inputs, 4U) << "a little behind the left edge, on the home switch";
  EXPECT_GE(now.position, 0);
  EXPECT_LT(now.position, 200) << "0.2 degrees";
}

}  // namespace
}  // namespace indurop::io
