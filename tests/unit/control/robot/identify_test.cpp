// SPDX-License-Identifier: Apache-2.0
// What an arm holds and the friction of its axes, from torques that orocos-kdl computes for random motions, with noise;
// and recordings that cannot show them.
#include "control/robot/files/identify.h"

#include <gmock/gmock.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <random>

#include "heavy_arm.h"
#include "robot_fixture.h"

namespace indurop::robot {
namespace {

using testing::HasSubstr;

constexpr double kUnit = 180 / kPi;

class Identification : public testing::Test {
 protected:
  Identification() : heavy(heavy_cell_arm(Joints::Constant(1000))) { std::ofstream(file()) << heavy.urdf; }
  ~Identification() override { std::filesystem::remove(file()); }
  static std::filesystem::path file() {
    return std::filesystem::path(testing::TempDir()) /
           (std::string(testing::UnitTest::GetInstance()->current_test_info()->name()) + ".urdf");
  }
  // Each axis swings by sines of its own. `noise`: N m.
  std::vector<ArmSample> record(const Body& held, double noise, double swing, int count = 1500) {
    std::normal_distribution<double> anything(0, noise);
    std::array<Joints, 2> often;
    std::array<Joints, 2> phase;
    for (std::size_t k = 0; k < often.size(); ++k) {
      for (int i = 0; i < kAxes; ++i) {
        often[k][i] = std::uniform_real_distribution<double>(0.4, 2.5)(random);
        phase[k][i] = std::uniform_real_distribution<double>(0, 6)(random);
      }
    }
    std::vector<ArmSample> samples;
    for (int n = 0; n < count; ++n) {
      const double t = 0.01 * n;
      Joints q = joints_of({0, 0.2, -0.3, 0, 1, 0});
      Joints v = Joints::Zero();
      Joints a = Joints::Zero();
      for (int i = 0; i < 6; ++i) {
        for (std::size_t k = 0; k < often.size(); ++k) {
          const double w = often[k][i];
          q[i] += swing * std::sin(w * t + phase[k][i]);
          v[i] += swing * w * std::cos(w * t + phase[k][i]);
          a[i] -= swing * w * w * std::sin(w * t + phase[k][i]);
        }
      }
      const Joints torque = kdl_torques(heavy, held, q, v, a);
      ArmSample sample(6);
      for (int i = 0; i < 6; ++i) {
        const double friction = dry(i) * (v[i] > 0 ? 1 : -1) + damping(i) * v[i];
        sample[static_cast<std::size_t>(i)] = {kUnit * q[i], kUnit * v[i], kUnit * a[i],
                                               torque[i] + friction + (noise > 0 ? anything(random) : 0)};
      }
      samples.push_back(sample);
    }
    return samples;
  }
  static double dry(int axis) { return 4 - 0.5 * axis; }
  static double damping(int axis) { return 10 - 1.5 * axis; }

  std::mt19937 random{1};
  HeavyArm heavy;
};

TEST_F(Identification, Without_noise_all_is_found_exactly) {
  for (int run = 0; run < 3; ++run) {
    const Body held = random_body(random, 8);
    const Identified found = identify(file(), {}, record(held, 0, 0.4));
    ASSERT_EQ(found.problem, "");
    EXPECT_NEAR(found.mass.value, held.mass, 1e-3);
    for (int k = 0; k < 3; ++k) {
      EXPECT_NEAR(found.centre[static_cast<std::size_t>(k)].value, 1000 * held.centre[k], 0.5) << k;
    }
    for (int i = 0; i < 6; ++i) {
      EXPECT_NEAR(found.axes[static_cast<std::size_t>(i)].dry.value, dry(i), 0.01) << i;
      EXPECT_NEAR(found.axes[static_cast<std::size_t>(i)].damping.value, damping(i), 0.01) << i;
    }
  }
}

TEST_F(Identification, With_noise_the_error_is_as_said) {
  int outside = 0;
  int numbers = 0;
  double worst = 0;
  for (int run = 0; run < 6; ++run) {
    const Body held = random_body(random, 8);
    const Identified found = identify(file(), {}, record(held, 2, 0.4));
    ASSERT_EQ(found.problem, "");
    const auto judge = [&](const Estimate& estimate, double real) {
      ++numbers;
      outside += std::abs(estimate.value - real) > estimate.within ? 1 : 0;
    };
    judge(found.mass, held.mass);
    worst = std::max(worst, std::abs(found.mass.value - held.mass));
    for (int k = 0; k < 3; ++k) {
      judge(found.centre[static_cast<std::size_t>(k)], 1000 * held.centre[k]);
    }
    for (int i = 0; i < 6; ++i) {
      judge(found.axes[static_cast<std::size_t>(i)].dry, dry(i));
      judge(found.axes[static_cast<std::size_t>(i)].damping, damping(i));
      EXPECT_NEAR(found.axes[static_cast<std::size_t>(i)].rest, 2, 0.2);
    }
  }
  EXPECT_LT(worst, 0.2);             // kg, at 2 N m
  EXPECT_LT(outside, numbers / 10);  // one of 20 is expected
  RecordProperty("worst", std::to_string(worst));
}

TEST_F(Identification, Drives_may_report_torques_later) {
  const Body held = random_body(random, 8);
  std::vector<ArmSample> samples = record(held, 0.5, 0.4);
  for (std::size_t n = samples.size() - 1; n >= 3; --n) {
    for (std::size_t i = 0; i < 6; ++i) {
      samples[n][i].torque = samples[n - 3][i].torque;
    }
  }
  const Identified found = identify(file(), {}, samples);
  ASSERT_EQ(found.problem, "");
  EXPECT_EQ(found.delay, 3U);
  EXPECT_NEAR(found.mass.value, held.mass, 0.1);
}

TEST_F(Identification, An_arm_that_holds_nothing_is_found_to_hold_nothing) {
  const Identified found = identify(file(), {}, record({}, 1, 0.4));
  ASSERT_EQ(found.problem, "");
  EXPECT_LT(std::abs(found.mass.value), found.mass.within + 0.05);
}

TEST_F(Identification, What_a_recording_cannot_show_is_said) {
  const Body held = random_body(random, 8);
  EXPECT_THAT(identify(file(), {}, {}).problem, HasSubstr("no values of the axes"));
  EXPECT_THAT(identify("missing.urdf", {}, record(held, 1, 0.4, 10)).problem, HasSubstr("missing.urdf"));
  EXPECT_THAT(identify(file(), {}, record(held, 1, 0.4, 10)).problem, HasSubstr("record a longer one"));
  EXPECT_THAT(identify(file(), {}, record(held, 20, 0.001)).problem, HasSubstr("turns the last axes far"));
  std::vector<ArmSample> still = record(held, 1, 0.4);
  for (ArmSample& sample : still) {
    for (AxisSample& axis : sample) {
      axis.torque = 0;
    }
  }
  EXPECT_THAT(identify(file(), {}, still).problem, HasSubstr("no torques"));
  still.front().pop_back();
  EXPECT_THAT(identify(file(), {}, still).problem, HasSubstr("the recording has 5 axes, the arm 6"));
}

}  // namespace
}  // namespace indurop::robot
