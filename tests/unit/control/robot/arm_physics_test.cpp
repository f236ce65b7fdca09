// SPDX-License-Identifier: Apache-2.0
// The arm behind simulated drives: an axis with a known load accelerates so that orocos-kdl, asked the other
// way round, finds the torque of the drive and the push from outside.
#include <indurop/robot/arm_physics.h>

#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <filesystem>
#include <fstream>
#include <kdl/chainjnttojacsolver.hpp>

#include "heavy_arm.h"
#include "robot_fixture.h"
#include "tests/unit/allocations.h"

namespace indurop::robot {
namespace {

class File {
 public:
  explicit File(const std::string& text)
      : path_(std::filesystem::path(testing::TempDir()) / ("physics." + std::to_string(::getpid()) + ".urdf")) {
    std::ofstream(path_) << text;
  }
  File(const File&) = delete;
  File& operator=(const File&) = delete;
  ~File() { std::filesystem::remove(path_); }
  [[nodiscard]] std::string name() const { return path_.string(); }

 private:
  std::filesystem::path path_;
};

double between(std::mt19937& random, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random);
}

TEST(ArmPhysics, Accelerates_as_KDL_says) {
  constexpr double kPeriod = 0.002;
  std::mt19937 random(11);
  for (int i = 0; i < 200; ++i) {
    const HeavyArm heavy = heavy_arm(random, {1 + i % 7, i % 2 == 1, 0});
    const File file(heavy.urdf);
    std::vector<std::string> errors;
    const auto sut = ArmPhysics::load(file.name(), errors);
    ASSERT_TRUE(sut) << (errors.empty() ? "" : errors.front());
    ASSERT_EQ(sut->axis_count(), static_cast<std::size_t>(heavy.count));
    Body held{};
    if (i % 3 == 0) {
      const double radius = between(random, 0.02, 0.2);
      held = {between(random, 0.1, 8), Vec3(0.1, -0.05, 0.2), Mat3::Zero()};
      held.inertia = 0.4 * held.mass * radius * radius * Mat3::Identity();
      sut->hold(held.mass, held.centre.x(), held.centre.y(), held.centre.z(), radius);
    }
    std::vector<AxisPhysics> axes(sut->axis_count());
    std::vector<double> loads(sut->axis_count());
    Joints velocity = Joints::Zero();
    for (std::size_t k = 0; k < axes.size(); ++k) {
      axes[k] = {between(random, -0.4, 0.4), between(random, -300, 300), between(random, -50, 50),
                 between(random, 0.1, 10), between(random, 0, 5)};
      velocity[static_cast<int>(k)] = between(random, -3, 3);
    }
    sut->step(axes, kPeriod, loads);
    Joints q = Joints::Zero();
    for (std::size_t k = 0; k < axes.size(); ++k) {
      axes[k].position += kPeriod * velocity[static_cast<int>(k)];
      q[static_cast<int>(k)] = axes[k].position;
    }
    const std::uint64_t before = g_allocations;
    sut->step(axes, kPeriod, loads);
    ASSERT_EQ(g_allocations, before);
    Joints acceleration = Joints::Zero();
    for (std::size_t k = 0; k < axes.size(); ++k) {
      acceleration[static_cast<int>(k)] = (axes[k].torque - loads[k]) / axes[k].inertia;
    }
    const Joints needed = kdl_torques(heavy, held, q, velocity, acceleration);
    for (std::size_t k = 0; k < axes.size(); ++k) {
      const auto axis = static_cast<int>(k);
      ASSERT_NEAR(needed[axis] + axes[k].rotor * acceleration[axis], axes[k].torque + axes[k].push, 1e-5)
          << "arm " << i << ", axis " << k + 1;
    }
  }
}

// The power of a hand is the same at the arm's end and at the axes.
TEST(ArmPhysics, A_hand_at_the_end_pushes_the_axes) {
  std::mt19937 random(12);
  for (int i = 0; i < 50; ++i) {
    const HeavyArm heavy = heavy_arm(random, {2 + i % 6, i % 2 == 1, 0});
    const File file(heavy.urdf);
    std::vector<std::string> errors;
    const auto sut = ArmPhysics::load(file.name(), errors);
    ASSERT_TRUE(sut);
    std::vector<AxisPhysics> axes(sut->axis_count());
    KDL::JntArray q(static_cast<unsigned>(axes.size()));
    for (std::size_t k = 0; k < axes.size(); ++k) {
      q(static_cast<unsigned>(k)) = axes[k].position = between(random, -0.4, 0.4);
    }
    std::array<double, 6> wrench{};
    for (double& one : wrench) {
      one = between(random, -50, 50);
    }
    std::vector<double> torques(axes.size());
    sut->push_end(axes, wrench, torques);
    KDL::ChainJntToJacSolver solver(heavy.chain);
    KDL::Jacobian jacobian(static_cast<unsigned>(axes.size()));
    solver.JntToJac(q, jacobian);
    const Eigen::VectorXd expected = jacobian.data.transpose() * Eigen::Matrix<double, 6, 1>(wrench.data());
    for (std::size_t k = 0; k < axes.size(); ++k) {
      EXPECT_NEAR(torques[k], expected[static_cast<Eigen::Index>(k)], 1e-9) << i;
    }
  }
}

TEST(ArmPhysics, An_arm_without_masses_is_reported) {
  std::vector<std::string> errors;
  EXPECT_FALSE(ArmPhysics::load("/nowhere/arm.urdf", errors));
  ASSERT_EQ(errors.size(), 1U);
  EXPECT_NE(errors[0].find("cannot read /nowhere/arm.urdf"), std::string::npos) << errors[0];
  const File light(cell_urdf());
  EXPECT_FALSE(ArmPhysics::load(light.name(), errors));
  EXPECT_NE(errors.back().find("the links have no masses"), std::string::npos) << errors.back();
  const File none("<robot/>");
  EXPECT_FALSE(ArmPhysics::load(none.name(), errors));
  EXPECT_EQ(errors.size(), 3U);
}

}  // namespace
}  // namespace indurop::robot
