// SPDX-License-Identifier: Apache-2.0
// Closed surfaces of known bodies, and random places.

#pragma once

#include <cmath>
#include <random>
#include <vector>

#include "control/robot/kinematics/geometry.h"
#include "tools/solids/mesh.h"

namespace indurop::solids {

using robot::Pose;
using Chance = std::mt19937;

inline double between(Chance& chance, double least, double most) {
  return std::uniform_real_distribution<double>(least, most)(chance);
}

inline Vec3 vector_between(Chance& chance, double least, double most) {
  const double x = between(chance, least, most);
  const double y = between(chance, least, most);
  return {x, y, between(chance, least, most)};
}

inline Pose pose_within(Chance& chance, double reach) {
  const Vec3 place = vector_between(chance, -reach, reach);
  return {place, robot::from_rpy(vector_between(chance, -3, 3))};
}

// Between two rings of as many points, the first below the second; rings of one point are tips.
inline void add_band(Surface& to, const std::vector<Vec3>& low, const std::vector<Vec3>& high) {
  const std::size_t count = std::max(low.size(), high.size());
  for (std::size_t i = 0; i < count; ++i) {
    const auto at = [&](const std::vector<Vec3>& ring, std::size_t k) { return ring[k % ring.size()]; };
    if (low.size() > 1) {
      to.push_back({at(low, i), at(low, i + 1), at(high, i)});
    }
    if (high.size() > 1) {
      to.push_back({at(low, i + 1), at(high, i + 1), at(high, i)});
    }
  }
}

inline std::vector<Vec3> ring(double radius, double z, int count) {
  std::vector<Vec3> points;
  for (int i = 0; i < count; ++i) {
    const double angle = 2 * robot::kPi * i / count;
    points.emplace_back(radius * std::cos(angle), radius * std::sin(angle), z);
  }
  return points;
}

inline Surface placed(Surface surface, const Pose& pose) {
  for (Triangle& triangle : surface) {
    for (Vec3& corner : triangle) {
      corner = pose.position + pose.orientation * corner;
    }
  }
  return surface;
}

// Around the origin; a cylinder's corners are on its rims.
inline Surface cylinder_surface(double radius, double height, int corners = 64) {
  Surface surface;
  const std::vector<std::vector<Vec3>> rings = {{{0, 0, -height / 2}},
                                                ring(radius, -height / 2, corners),
                                                ring(radius, height / 2, corners),
                                                {{0, 0, height / 2}}};
  for (std::size_t i = 1; i < rings.size(); ++i) {
    add_band(surface, rings[i - 1], rings[i]);
  }
  return surface;
}

inline Surface box_surface(const Vec3& edges) {
  Surface surface = cylinder_surface(std::sqrt(0.5), 1, 4);
  for (Triangle& triangle : surface) {
    for (Vec3& corner : triangle) {
      corner = (Eigen::AngleAxisd(robot::kPi / 4, Vec3::UnitZ()) * corner).cwiseProduct(edges);
    }
  }
  return surface;
}

inline Surface ball_surface(double radius, int rings = 16) {
  Surface surface;
  std::vector<Vec3> before = {{0, 0, -radius}};
  for (int i = 1; i <= rings; ++i) {
    const double angle = robot::kPi * i / rings;
    const std::vector<Vec3> next = i == rings ? std::vector<Vec3>{{0, 0, radius}}
                                              : ring(radius * std::sin(angle), -radius * std::cos(angle), 2 * rings);
    add_band(surface, before, next);
    before = next;
  }
  return surface;
}

inline void add(Surface& to, const Surface& more) {
  to.insert(to.end(), more.begin(), more.end());
}

inline Vec3 on_surface(Chance& chance, const Surface& surface) {
  const Triangle& triangle = surface[std::uniform_int_distribution<std::size_t>(0, surface.size() - 1)(chance)];
  const double a = between(chance, 0, 1);
  const double b = between(chance, 0, 1 - a);
  return (1 - a - b) * triangle[0] + a * triangle[1] + b * triangle[2];
}

}  // namespace indurop::solids
