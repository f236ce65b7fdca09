// SPDX-License-Identifier: Apache-2.0
#include "heavy_arm.h"

#include <fmt/core.h>

#include <kdl/chainidsolver_recursive_newton_euler.hpp>

#include "robot_fixture.h"

namespace indurop::robot {

namespace {

double between(std::mt19937& random, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random);
}

Vec3 spread(std::mt19937& random, double far) {
  return {between(random, -far, far), between(random, -far, far), between(random, -far, far)};
}

struct Joint {
  std::string name;
  bool slides = false;
  bool fixed = false;
  Vec3 place = Vec3::Zero();
  Vec3 rpy = Vec3::Zero();
  Vec3 axis = Vec3::UnitZ();
  Body body;
  std::string limit;
};

std::string of(const Vec3& v) {
  return fmt::format("{:.17g} {:.17g} {:.17g}", v.x(), v.y(), v.z());
}

std::string inertial_of(const Body& body) {
  const Mat3& i = body.inertia;
  return body.mass <= 0
             ? ""
             : fmt::format(
                   "<inertial><origin xyz=\"{}\"/><mass value=\"{:.17g}\"/><inertia ixx=\"{:.17g}\" "
                   "ixy=\"{:.17g}\" ixz=\"{:.17g}\" iyy=\"{:.17g}\" iyz=\"{:.17g}\" izz=\"{:.17g}\"/></inertial>",
                   of(body.centre), body.mass, i(0, 0), i(0, 1), i(0, 2), i(1, 1), i(1, 2), i(2, 2));
}

void append(HeavyArm& arm, const Joint& joint, const std::string& parent) {
  const std::string link = joint.fixed ? "tool0" : "link_" + joint.name;
  arm.urdf += fmt::format("<link name=\"{}\">{}</link>\n", link, inertial_of(joint.body));
  arm.urdf += fmt::format(
      "<joint name=\"{}\" type=\"{}\"><parent link=\"{}\"/><child link=\"{}\"/><origin xyz=\"{}\" rpy=\"{}\"/>"
      "<axis xyz=\"{}\"/>{}</joint>\n",
      joint.name,
      joint.fixed    ? "fixed"
      : joint.slides ? "prismatic"
                     : "revolute",
      parent, link, of(joint.place), of(joint.rpy), of(joint.axis), joint.limit);
  const KDL::Frame frame(KDL::Rotation::RPY(joint.rpy.x(), joint.rpy.y(), joint.rpy.z()),
                         KDL::Vector(joint.place.x(), joint.place.y(), joint.place.z()));
  const KDL::Vector axis(joint.axis.x(), joint.axis.y(), joint.axis.z());
  const KDL::Joint moved = joint.fixed ? KDL::Joint(joint.name, KDL::Joint::None)
                                       : KDL::Joint(joint.name, frame.p, frame.M * axis,
                                                    joint.slides ? KDL::Joint::TransAxis : KDL::Joint::RotAxis);
  arm.chain.addSegment(KDL::Segment(joint.name, moved, frame, kdl_of(joint.body)));
  arm.count += joint.fixed ? 0 : 1;
}

std::string limit_of(double lower, double upper, double velocity, double effort) {
  return fmt::format("<limit lower=\"{}\" upper=\"{}\" velocity=\"{}\" effort=\"{}\"/>", lower, upper, velocity,
                     effort);
}

Body cylinder(double mass, const Vec3& from, const Vec3& to, double radius) {
  const Vec3 along = to - from;
  const double round = mass * radius * radius / 2;
  const double across = round / 2 + mass * along.squaredNorm() / 12;
  const Vec3 axis = along.normalized();
  return {mass, (from + to) / 2, across * Mat3::Identity() + (round - across) * axis * axis.transpose()};
}

}  // namespace

Body random_body(std::mt19937& random, double most) {
  Body body;
  body.mass = between(random, 0.1, 1) * most;
  body.centre = spread(random, 0.2);
  const Vec3 squares = spread(random, 0.2).cwiseAbs2() + Vec3::Constant(1e-4);
  const Mat3 turn = from_rpy(spread(random, kPi)).toRotationMatrix();
  body.inertia = body.mass * turn * (squares.sum() * Mat3::Identity() - Mat3(squares.asDiagonal())) * turn.transpose();
  return body;
}

KDL::RigidBodyInertia kdl_of(const Body& body) {
  const Mat3& i = body.inertia;
  return body.mass <= 0
             ? KDL::RigidBodyInertia::Zero()
             : KDL::RigidBodyInertia(body.mass, KDL::Vector(body.centre.x(), body.centre.y(), body.centre.z()),
                                     KDL::RotationalInertia(i(0, 0), i(1, 1), i(2, 2), i(0, 1), i(0, 2), i(1, 2)));
}

HeavyArm heavy_arm(std::mt19937& random, const HeavySetup& setup) {
  HeavyArm arm;
  arm.urdf = "<robot name=\"heavy\">\n<link name=\"base\"/>\n";
  std::string parent = "base";
  for (int i = 0; i < setup.axes; ++i) {
    Joint joint;
    joint.name = fmt::format("j{}", i + 1);
    joint.slides = setup.sliding && random() % 4 == 0;
    joint.place = spread(random, 0.4);
    joint.rpy = spread(random, 3);
    joint.axis = (spread(random, 1) + Vec3(0, 0, 1.5)).normalized();
    joint.body = random_body(random, 12);
    joint.limit = limit_of(joint.slides ? -0.5 : -2.5, joint.slides ? 0.5 : 2.5, 3, setup.effort);
    append(arm, joint, parent);
    parent = "link_" + joint.name;
  }
  Joint tool;
  tool.name = "tool";
  tool.fixed = true;
  tool.place = spread(random, 0.2);
  tool.rpy = spread(random, 3);
  tool.body = random() % 2 == 0 ? random_body(random, 2) : Body{};
  append(arm, tool, parent);
  arm.urdf += "</robot>\n";
  return arm;
}

HeavyArm heavy_cell_arm(const Joints& effort) {
  struct Given {
    Vec3 place, axis, end;
    double lower, upper, velocity, mass, radius;
  };
  const Vec3 x = Vec3::UnitX();
  const Vec3 y = Vec3::UnitY();
  const Given given[] = {
      {{0, 0, 0.3}, Vec3::UnitZ(), {0.07, 0, 0.1}, -2.967, 2.967, 3.49, 9, 0.09},
      {{0.07, 0, 0.1}, y, {0, 0, 0.47}, -1.745, 2.356, 3.49, 12, 0.07},
      {{0, 0, 0.47}, y, {0.25, 0, 0.05}, -3.491, 1.222, 3.49, 7, 0.06},
      {{0.25, 0, 0.05}, x, {0.22, 0, 0}, -3.229, 3.229, 6.98, 4, 0.05},
      {{0.22, 0, 0}, y, {0.09, 0, 0}, -2.094, 2.094, 6.98, 2, 0.04},
      {{0.09, 0, 0}, x, {0.1, 0, 0}, -6.283, 6.283, 8.72, 0.8, 0.04},
  };
  HeavyArm arm;
  arm.urdf = "<robot name=\"heavy_cell\">\n<link name=\"base\"/>\n";
  std::string parent = "base";
  for (const Given& one : given) {
    Joint joint;
    joint.name = fmt::format("j{}", arm.count + 1);
    joint.place = one.place;
    joint.axis = one.axis;
    joint.body = cylinder(one.mass, Vec3::Zero(), one.end, one.radius);
    joint.limit = limit_of(one.lower, one.upper, one.velocity, effort[arm.count]);
    append(arm, joint, parent);
    parent = "link_" + joint.name;
  }
  Joint tool;
  tool.name = "tool";
  tool.fixed = true;
  tool.place = {0.14, 0, 0};
  tool.rpy = {0, kPi / 2, 0};
  append(arm, tool, parent);
  arm.urdf += "</robot>\n";
  return arm;
}

Joints kdl_torques(const HeavyArm& arm, const Body& held, const Joints& q, const Joints& velocity,
                   const Joints& acceleration) {
  KDL::Chain chain = arm.chain;
  chain.addSegment(KDL::Segment("held", KDL::Joint("held", KDL::Joint::None), KDL::Frame::Identity(), kdl_of(held)));
  KDL::ChainIdSolver_RNE solver(chain, KDL::Vector(0, 0, -9.80665));
  const auto n = static_cast<unsigned>(arm.count);
  KDL::JntArray place(n);
  KDL::JntArray speed(n);
  KDL::JntArray change(n);
  KDL::JntArray torque(n);
  for (unsigned i = 0; i < n; ++i) {
    const auto k = static_cast<int>(i);
    place(i) = q[k];
    speed(i) = velocity[k];
    change(i) = acceleration[k];
  }
  const KDL::Wrenches none(chain.getNrOfSegments(), KDL::Wrench::Zero());
  if (solver.CartToJnt(place, speed, change, none, torque) < 0) {
    torque.data.setConstant(std::numeric_limits<double>::quiet_NaN());
  }
  Joints result = Joints::Zero();
  result.head(arm.count) = torque.data;
  return result;
}

}  // namespace indurop::robot
