// SPDX-License-Identifier: Apache-2.0
// Torques of random arms as orocos-kdl has them, and as energies have them: Lagrange's equation by numeric derivatives,
// of arms with linkages too, which KDL does not know.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "heavy_arm.h"
#include "robot_fixture.h"

namespace indurop::robot {
namespace {

ArmModel model_of(const std::string& urdf) {
  auto read = arm_from_urdf("robot.urdf", urdf);
  if (!read) {
    throw std::runtime_error(base::to_string(read.error().front()));
  }
  return std::move(read).value();
}

std::string wrong_with(const std::string& urdf) {
  const auto read = arm_from_urdf("robot.urdf", urdf);
  return read ? "" : base::to_string(read.error().front());
}

Joints anything(const Arm& arm, std::mt19937& random, double most) {
  Joints values = Joints::Zero();
  for (int i = 0; i < arm.count(); ++i) {
    values[i] = std::uniform_real_distribution<double>(-most, most)(random);
  }
  return values;
}

TEST(Dynamics, Torques_are_those_of_KDL) {
  std::mt19937 random(7);
  for (int arm = 0; arm < 60; ++arm) {
    const HeavyArm heavy = heavy_arm(random, {1 + arm % 7, arm % 2 == 1, 0});
    const ArmModel model = model_of(heavy.urdf);
    Dynamics sut = model.dynamics;
    ASSERT_TRUE(sut.known());
    for (int i = 0; i < 60; ++i) {
      const Body held = i % 3 == 0 ? Body{} : random_body(random, 8);
      sut.hold(held);
      const Joints q = anywhere(model.arm, random);
      const Joints v = anything(model.arm, random, 4);
      const Joints a = anything(model.arm, random, 20);
      const Joints wanted = kdl_torques(heavy, held, q, v, a);
      ASSERT_LT((sut.torques(q, v, a) - wanted).cwiseAbs().maxCoeff(), 1e-8 * (1 + wanted.cwiseAbs().maxCoeff()));
    }
  }
}

// Bodies by arms that end in their centres, whose Jacobians say how they move.
struct Energies {
  std::vector<Link> links;
  std::vector<Body> bodies;
  int count = 0;

  [[nodiscard]] Arm until(std::size_t i) const {
    Arm::Axes axes;
    return {axes, Pose{bodies[i].centre, Quat::Identity()}, count, links.data(), i + 1};
  }
  [[nodiscard]] Eigen::Matrix<double, kAxes, kAxes> mass(const Joints& q) const {
    Eigen::Matrix<double, kAxes, kAxes> m = Eigen::Matrix<double, kAxes, kAxes>::Zero();
    for (std::size_t i = 0; i < links.size(); ++i) {
      const Arm arm = until(i);
      const Jacobian j = arm.jacobian(q);
      const Mat3 turn = arm.forward(q).orientation.toRotationMatrix();
      const Mat3 inertia = turn * bodies[i].inertia * turn.transpose();
      for (int a = 0; a < count; ++a) {
        for (int b = 0; b < count; ++b) {
          m(a, b) += bodies[i].mass * j.col(a).head<3>().dot(j.col(b).head<3>()) +
                     j.col(a).tail<3>().dot(inertia * j.col(b).tail<3>());
        }
      }
    }
    return m;
  }
  [[nodiscard]] double height(const Joints& q) const {
    double sum = 0;
    for (std::size_t i = 0; i < links.size(); ++i) {
      sum += 9.80665 * bodies[i].mass * until(i).forward(q).position.z();
    }
    return sum;
  }
  [[nodiscard]] Joints torques(const Joints& q, const Joints& v, const Joints& a) const {
    constexpr double kStep = 1e-5;
    Joints result = mass(q) * a + (mass(q + kStep * v) - mass(q - kStep * v)) / (2 * kStep) * v;
    for (int i = 0; i < count; ++i) {
      Joints to = q;
      Joints from = q;
      to[i] += kStep;
      from[i] -= kStep;
      const double lagrangian = v.dot(mass(to) * v) / 2 - height(to) - (v.dot(mass(from) * v) / 2 - height(from));
      result[i] -= lagrangian / (2 * kStep);
    }
    return result;
  }
};

TEST(Dynamics, Torques_are_those_of_energies_with_linkages_too) {
  std::mt19937 random(11);
  for (int arm = 0; arm < 24; ++arm) {
    Energies all;
    all.count = 2 + arm % 3;
    const int links = all.count + arm % 4;
    for (int i = 0; i < links; ++i) {
      Link link;
      link.direction = random_body(random, 1).centre.normalized();
      link.point = 2 * random_body(random, 1).centre;
      link.kind = random() % 4 == 0 ? AxisKind::Sliding : AxisKind::Turning;
      link.axis = i < all.count ? i : static_cast<int>(random() % static_cast<unsigned>(all.count));
      link.ratio = i < all.count ? 1 : -1.5;
      all.links.push_back(link);
      all.bodies.push_back(random_body(random, 10));
    }
    const Dynamics sut(all.links, all.bodies, Pose{}, {}, Joints::Zero());
    for (int i = 0; i < 6; ++i) {
      const Joints q = anything(all.until(0), random, 2);
      const Joints v = anything(all.until(0), random, 3);
      const Joints a = anything(all.until(0), random, 10);
      const Joints wanted = all.torques(q, v, a);
      ASSERT_LT((sut.torques(q, v, a) - wanted).cwiseAbs().maxCoeff(), 1e-6 * (1 + wanted.cwiseAbs().maxCoeff()));
      ASSERT_LT((sut.inertial(q, a) - all.mass(q) * a).cwiseAbs().maxCoeff(), 1e-8 * (1 + wanted.norm()));
    }
  }
}

// A pendulum: what anybody computes by hand. Another link is fixed to the one that swings, and a finger slides there.
constexpr const char* kPendulum = R"(<robot name="pendulum">
<link name="base"><inertial><mass value="50"/><inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial></link>
<link name="rod">
  <inertial><origin xyz="1 0 0"/><mass value="2"/><inertia ixx="0.1" iyy="0.1" izz="0.1" ixy="0" ixz="0" iyz="0"/></inertial>
</link>
<link name="grip"><inertial><mass value="1"/><inertia ixx="0.1" iyy="0.1" izz="0.1" ixy="0" ixz="0" iyz="0"/></inertial></link>
<link name="finger"><inertial><mass value="0.5"/><inertia ixx="0.1" iyy="0.1" izz="0.1" ixy="0" ixz="0" iyz="0"/></inertial></link>
<link name="tool0"/>
<joint name="swing" type="revolute"><parent link="base"/><child link="rod"/><axis xyz="0 1 0"/>
  <limit lower="-3" upper="3" velocity="2" effort="60"/><dynamics damping="3" friction="0.7"/></joint>
<joint name="hold" type="fixed"><parent link="rod"/><child link="grip"/><origin xyz="2 0 0"/></joint>
<joint name="close" type="prismatic"><parent link="grip"/><child link="finger"/><origin xyz="1 0 0"/>
  <limit lower="0" upper="0.1" velocity="1" effort="5"/></joint>
<joint name="end" type="fixed"><parent link="rod"/><child link="tool0"/><origin xyz="2 0 0"/></joint>
</robot>
)";

TEST(Dynamics, A_pendulum_is_as_computed_by_hand) {
  const ArmModel model = model_of(kPendulum);
  Dynamics sut = model.dynamics;
  ASSERT_TRUE(sut.known());
  const double g = 9.80665;
  const Joints rest = Joints::Zero();
  Joints faster = rest;
  faster[0] = 1;
  EXPECT_NEAR(sut.torques(rest, rest, rest)[0], -(2 * 1 + 1 * 2 + 0.5 * 3) * g, 1e-9);
  EXPECT_NEAR(sut.inertial(rest, faster)[0], 0.3 + 2 * 1 + 1 * 4 + 0.5 * 9, 1e-9);
  sut.hold({4, Vec3(0, 0, 0.5), Mat3::Zero()});
  EXPECT_NEAR(sut.torques(rest, rest, rest)[0], -(5.5 + 4 * 2) * g, 1e-9);
  sut.hold({});
  EXPECT_NEAR(sut.torques(rest, rest, rest)[0], -5.5 * g, 1e-9);
  EXPECT_EQ(sut.effort()[0], 60);
  Joints back = rest;
  back[0] = -2;
  EXPECT_NEAR(sut.friction(back)[0], -2 * 3 - 0.7, 1e-9);
}

std::string changed(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  return at == std::string::npos ? "there is no " + from : text.replace(at, from.size(), to);
}

TEST(Dynamics, Wrong_masses_are_errors_with_their_line) {
  const std::string good = kPendulum;
  EXPECT_EQ(wrong_with(good), "");
  EXPECT_EQ(wrong_with(changed(good, "value=\"2\"", "value=\"0\"")),
            "robot.urdf:4:3: error: link 'rod': its mass is 0 kg, and has to be above 0; leave <inertial> out of links "
            "that are no bodies");
  EXPECT_EQ(wrong_with(changed(good, "value=\"2\"/><inertia ixx=\"0.1\"", "value=\"2\"/><inertia ixx=\"-0.1\"")),
            "robot.urdf:4:3: error: link 'rod': no body has this inertia, about its principal axes it is -0.1, 0.1 and "
            "0.1 kg m^2, and all three have to be above 0; is there a sign or a number missing?");
  EXPECT_EQ(wrong_with(changed(good, "value=\"2\"/><inertia ixx=\"0.1\"", "value=\"2\"/><inertia ixx=\"0.3\"")),
            "robot.urdf:4:3: error: link 'rod': no body has this inertia, about its principal axes it is 0.1, 0.1 and "
            "0.3 kg m^2, and none can be more than the two others together; it counts about the centre of mass, in "
            "kg m^2");
  EXPECT_EQ(wrong_with(changed(good, "damping=\"3\"", "damping=\"-3\"")),
            "robot.urdf:9:1: error: joint 'swing': damping and friction of <dynamics> cannot be below 0");
}

TEST(Dynamics, Missing_masses_are_reported) {
  const auto notes_of = [](const ArmModel& model) {
    return model.notes.empty() ? "" : base::to_string(model.notes.front());
  };
  EXPECT_EQ(notes_of(model_of(kPendulum)), "");
  const ArmModel cell = model_of(cell_urdf());
  EXPECT_FALSE(cell.dynamics.known());
  EXPECT_EQ(notes_of(cell),
            "robot.urdf:1:1: note: torques are not known and have no limit: there is no <inertial> in the links "
            "'shoulder', 'upper_arm', 'elbow', 'forearm', 'wrist', 'flange'");
  const ArmModel free = model_of(changed(kPendulum, "effort=\"60\"", "effort=\"0\""));
  EXPECT_TRUE(free.dynamics.known());
  EXPECT_FALSE(free.dynamics.limited());
  EXPECT_EQ(
      notes_of(free),
      "robot.urdf:1:1: note: the torque of 'swing' has no limit; give it <limit effort> above 0 (N m, sliding N)");
}

}  // namespace
}  // namespace indurop::robot
