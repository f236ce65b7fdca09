// SPDX-License-Identifier: Apache-2.0
#include "solid_reference.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace indurop::robot {

namespace {

using Frame = Eigen::Isometry3d;

Frame frame_of(const Vec3& origin, const Vec3& rpy) {
  Frame frame = Frame::Identity();
  frame.translate(origin);
  frame.rotate(Eigen::AngleAxisd(rpy[2], Vec3::UnitZ()) * Eigen::AngleAxisd(rpy[1], Vec3::UnitY()) *
               Eigen::AngleAxisd(rpy[0], Vec3::UnitX()));
  return frame;
}

std::string text(const Vec3& v) {
  std::ostringstream out;
  out.precision(17);
  out << v[0] << " " << v[1] << " " << v[2];
  return out.str();
}

Vec3 nearest_on(const ReferencePlace& place, const Vec3& point) {
  return place.frame * place.solid->nearest(place.frame.inverse() * point);
}

Frame moved(const ReferenceArm::Joint& joint, double at) {
  const Frame link = frame_of(joint.origin, joint.rpy);
  return joint.slides ? Frame(link * Eigen::Translation3d(at * joint.axis.normalized()))
                      : Frame(link * Eigen::AngleAxisd(at, joint.axis.normalized()));
}

double within(std::mt19937& random, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random);
}

Vec3 any_vector(std::mt19937& random, double most) {
  return {within(random, -most, most), within(random, -most, most), within(random, -most, most)};
}

}  // namespace

Vec3 ReferenceSolid::nearest(const Vec3& point) const {
  if (kind == Kind::Box) {
    return point.cwiseMax(-size / 2).cwiseMin(size / 2);
  }
  if (kind == Kind::Ball) {
    return point.norm() > size[0] ? Vec3(point.normalized() * size[0]) : point;
  }
  Vec3 result = point;
  const double across = std::hypot(point[0], point[1]);
  if (across > size[0]) {
    result[0] *= size[0] / across;
    result[1] *= size[0] / across;
  }
  result[2] = std::clamp(point[2], -size[1] / 2, size[1] / 2);
  return result;
}

std::string ReferenceSolid::xml() const {
  std::ostringstream out;
  out.precision(17);
  out << "<collision><origin xyz='" << text(origin) << "' rpy='" << text(rpy) << "'/><geometry>";
  if (kind == Kind::Box) {
    out << "<box size='" << text(size) << "'/>";
  } else if (kind == Kind::Cylinder) {
    out << "<cylinder radius='" << size[0] << "' length='" << size[1] << "'/>";
  } else {
    out << "<sphere radius='" << size[0] << "'/>";
  }
  out << "</geometry></collision>";
  return out.str();
}

// To and fro between convex bodies ends at the nearest points of both; each step comes nearer.
double reference_distance(const ReferencePlace& a, const ReferencePlace& b) {
  constexpr int kMaxSteps = 3000;
  Vec3 on_a = a.frame.translation();
  Vec3 on_b = nearest_on(b, on_a);
  double distance = (on_a - on_b).norm();
  for (int i = 0; i < kMaxSteps; ++i) {
    on_a = nearest_on(a, on_b);
    on_b = nearest_on(b, on_a);
    const double now = (on_a - on_b).norm();
    if (now < 1e-12 || (i > 30 && distance - now < 1e-13)) {
      return now;
    }
    distance = now;
  }
  return distance;
}

ReferenceSolid any_solid(std::mt19937& random, double most) {
  ReferenceSolid solid;
  solid.kind = static_cast<ReferenceSolid::Kind>(random() % 3);
  for (int i = 0; i < 3; ++i) {
    solid.size[i] = within(random, 0.2 * most, most);
  }
  solid.origin = any_vector(random, most / 2);
  solid.rpy = any_vector(random, 3);
  return solid;
}

ReferenceArm ReferenceArm::usual() {
  using Kind = ReferenceSolid::Kind;
  ReferenceArm arm;
  arm.joints = {{{0, 0, 0.3}, {0, 0, 0}, {0, 0, 1}, false, -2.967, 2.967},
                {{0.07, 0, 0.1}, {0, 0, 0}, {0, 1, 0}, false, -1.745, 2.356},
                {{0, 0, 0.47}, {0, 0, 0}, {0, 1, 0}, false, -3.491, 1.222},
                {{0.25, 0, 0.05}, {0, 0, 0}, {1, 0, 0}, false, -3.229, 3.229},
                {{0.22, 0, 0}, {0, 0, 0}, {0, 1, 0}, false, -2.094, 2.094},
                {{0.09, 0, 0}, {0, 0, 0}, {1, 0, 0}, false, -6.283, 6.283}};
  arm.solids = {{Kind::Cylinder, {0.12, 0.28, 0}, {0, 0, 0.14}, {0, 0, 0}},
                {Kind::Box, {0.26, 0.2, 0.2}, {0.03, 0, 0.06}, {0, 0, 0}},
                {Kind::Box, {0.14, 0.16, 0.56}, {0, 0, 0.235}, {0, 0, 0}},
                {Kind::Box, {0.3, 0.13, 0.13}, {0.09, 0, 0.05}, {0, 0, 0}},
                {Kind::Cylinder, {0.055, 0.18, 0}, {0.09, 0, 0}, {0, 1.5708, 0}},
                {Kind::Box, {0.1, 0.09, 0.09}, {0.02, 0, 0}, {0, 0, 0}},
                {Kind::Ball, {0.09, 0, 0}, {0.12, 0, 0}, {0, 0, 0}}};
  arm.tool = {0.14, 0, 0};
  return arm;
}

ReferenceArm ReferenceArm::with_table(int axes) {
  using Kind = ReferenceSolid::Kind;
  ReferenceArm arm = usual();
  if (axes == 2) {
    arm.table.push_back({{0.6, 0.1, 0.2}, {0, 0, 0.4}, {0, 1, 0}, false, -0.8, 0.8});
    arm.on_table.push_back({Kind::Box, {0.2, 0.3, 0.05}, {0, 0, -0.03}, {0, 0, 0}});
  }
  arm.table.push_back({axes == 2 ? Vec3(0, 0, 0.04) : Vec3(0.6, 0.1, 0.24), {0, 0, 0.3}, {0, 0, 1}, false, -3, 3});
  arm.on_table.push_back({Kind::Box, {0.5, 0.12, 0.06}, {0.05, 0, 0.03}, {0, 0, 0.2}});
  return arm;
}

ReferenceArm ReferenceArm::any(std::mt19937& random) {
  ReferenceArm arm;
  const std::size_t axes = 3 + random() % 5;
  arm.solids.push_back(any_solid(random, 0.3));
  for (std::size_t i = 0; i < axes; ++i) {
    Joint joint;
    joint.origin = any_vector(random, 0.4);
    joint.rpy = any_vector(random, 2);
    joint.axis = any_vector(random, 1) + Vec3(0, 0, 0.1);
    joint.slides = random() % 5 == 0;
    joint.lower = joint.slides ? -0.4 : -3;
    joint.upper = joint.slides ? 0.3 : 3;
    arm.joints.push_back(joint);
    arm.solids.push_back(any_solid(random, 0.25));
  }
  return arm;
}

std::string ReferenceArm::urdf() const {
  std::ostringstream out;
  out.precision(17);
  out << "<robot name='reference'>\n";
  for (std::size_t i = 0; i < solids.size(); ++i) {
    out << "<link name='link" << i << "'>" << solids[i].xml() << "</link>\n";
  }
  out << "<link name='tool0'/>\n";
  for (std::size_t i = 0; i < joints.size(); ++i) {
    const Joint& joint = joints[i];
    out << "<joint name='joint" << i + 1 << "' type='" << (joint.slides ? "prismatic" : "revolute")
        << "'><parent link='link" << i << "'/><child link='link" << i + 1 << "'/><origin xyz='" << text(joint.origin)
        << "' rpy='" << text(joint.rpy) << "'/><axis xyz='" << text(joint.axis) << "'/><limit lower='" << joint.lower
        << "' upper='" << joint.upper << "' velocity='3' effort='1'/></joint>\n";
  }
  out << "<joint name='end' type='fixed'><parent link='link" << joints.size() << "'/><child link='tool0'/><origin xyz='"
      << text(tool) << "' rpy='0 1.5707963267948966 0'/></joint>\n";
  for (std::size_t i = 0; i < table.size(); ++i) {
    const Joint& joint = table[i];
    const std::string below = i == 0 ? "link0" : "table" + std::to_string(i);
    out << "<link name='table" << i + 1 << "'>" << on_table[i].xml() << "</link>\n<joint name='turn" << i + 1
        << "' type='revolute'><parent link='" << below << "'/><child link='table" << i + 1 << "'/><origin xyz='"
        << text(joint.origin) << "' rpy='" << text(joint.rpy) << "'/><axis xyz='" << text(joint.axis)
        << "'/><limit lower='" << joint.lower << "' upper='" << joint.upper
        << "' velocity='1.5' effort='1'/></joint>\n";
  }
  out << (table.empty() ? "" : "<workpiece link='table" + std::to_string(table.size()) + "'/>\n") << "</robot>\n";
  return out.str();
}

std::vector<ReferencePlace> ReferenceArm::places(const Joints& q) const {
  std::vector<ReferencePlace> places;
  Frame link = Frame::Identity();
  for (std::size_t i = 0; i < solids.size(); ++i) {
    link = i > 0 ? link * moved(joints[i - 1], q[static_cast<Eigen::Index>(i) - 1]) : link;
    places.push_back({&solids[i], link * frame_of(solids[i].origin, solids[i].rpy)});
  }
  link = Frame::Identity();
  for (std::size_t i = 0; i < table.size(); ++i) {
    link = link * moved(table[i], q[static_cast<Eigen::Index>(joints.size() + i)]);
    places.push_back({&on_table[i], link * frame_of(on_table[i].origin, on_table[i].rpy)});
  }
  return places;
}

Eigen::Isometry3d ReferenceArm::workpiece() const {
  Frame link = Frame::Identity();
  for (const Joint& joint : table) {
    link = link * moved(joint, 0);
  }
  return link;
}

double ReferenceArm::clearance(const Joints& q, const std::vector<ReferencePlace>& zones) const {
  const std::vector<ReferencePlace> now = places(q);
  const std::vector<ReferencePlace> zero = places(Joints::Zero());
  constexpr double kTouching = 0.006;  // m, a little more than the property's default
  double least = HUGE_VAL;
  const auto size = [](const ReferencePlace& one) { return 2 * one.solid->size.norm(); };
  const auto look = [&](const ReferencePlace& a, const ReferencePlace& b) {
    if ((a.frame.translation() - b.frame.translation()).norm() - size(a) - size(b) < least) {
      least = std::min(least, reference_distance(a, b));
    }
  };
  for (std::size_t i = 0; i < now.size(); ++i) {
    for (std::size_t k = i + 2; k < now.size(); ++k) {
      if (reference_distance(zero[i], zero[k]) > kTouching) {
        look(now[i], now[k]);
      }
    }
    for (const ReferencePlace& zone : zones) {
      if (i > 0) {
        look(now[i], zone);
      }
    }
  }
  return least;
}

}  // namespace indurop::robot
