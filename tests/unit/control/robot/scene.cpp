// SPDX-License-Identifier: Apache-2.0
#include "scene.h"

#include <fcl/geometry/shape/box.h>
#include <fcl/geometry/shape/cylinder.h>
#include <fcl/geometry/shape/sphere.h>
#include <fcl/narrowphase/collision.h>
#include <fcl/narrowphase/distance.h>
#include <fmt/format.h>

#include <algorithm>
#include <exception>
#include <stdexcept>

namespace indurop::robot {

namespace {

double within(std::mt19937& random, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random);
}

std::shared_ptr<fcl::CollisionGeometryd> shape_of(const ReferenceSolid& solid) {
  const Vec3& size = solid.size;
  switch (solid.kind) {
    case ReferenceSolid::Kind::Box:
      return std::make_shared<fcl::Boxd>(size[0], size[1], size[2]);
    case ReferenceSolid::Kind::Cylinder:
      return std::make_shared<fcl::Cylinderd>(size[0], size[1]);
    case ReferenceSolid::Kind::Ball:
      break;
  }
  return std::make_shared<fcl::Sphered>(size[0]);
}

std::unique_ptr<fcl::CollisionObjectd> object_of(std::shared_ptr<fcl::CollisionGeometryd> shape, const Vec3& at) {
  auto object = std::make_unique<fcl::CollisionObjectd>(std::move(shape));
  object->setTranslation(at);
  object->computeAABB();
  return object;
}

}  // namespace

Scene::Scene(unsigned seed) {
  std::mt19937 random(seed);
  for (const ReferenceSolid& solid : arm_.solids) {
    links_.push_back(std::make_unique<fcl::CollisionObjectd>(shape_of(solid)));
  }
  place(Joints::Zero());
  for (std::size_t i = 0; i < links_.size(); ++i) {
    for (std::size_t k = i + 2; k < links_.size(); ++k) {
      if (distance(*links_[i], *links_[k], 1) > 1.2 * kMargin) {
        pairs_.emplace_back(i, k);
      }
    }
  }
  const int zones = 5 + static_cast<int>(random() % 8);
  for (int i = 0; i < zones; ++i) {
    add_zone(random, i);
  }
  // Ways that are not clear at once, if there are some.
  for (int tries = 0; tries < 10 && (tries == 0 || is_straight_clear()); ++tries) {
    start = clear_place(random);
    goal = clear_place(random);
  }
  const auto point = [&](const char* name, const Joints& q) {
    std::string text = fmt::format("POINT {} = JOINT", name);
    for (int i = 0; i < axes(); ++i) {
      text += fmt::format(" {:.9f}", degrees(q[i]));
    }
    return text + "\n";
  };
  job_ += point("S", start) + point("G", goal);
}

// Somewhere around the arm, and not where it stands.
void Scene::add_zone(std::mt19937& random, int number) {
  const double turn = within(random, -kPi, kPi);
  const double far = within(random, 0.4, 0.95);
  const Vec3 at(far * std::cos(turn), far * std::sin(turn), within(random, 0, 1.1));
  const Vec3 size(within(random, 0.04, 0.3), within(random, 0.04, 0.3), within(random, 0.04, 0.5));
  if (number % 3 == 0) {
    zones_.push_back(object_of(std::make_shared<fcl::Boxd>(size[0], size[1], size[2]), at));
    const Vec3 low = 1000 * (at - size / 2);
    const Vec3 high = 1000 * (at + size / 2);
    job_ +=
        fmt::format("KEEPOUT z{} = BOX {} {} {} {} {} {}\n", number, low[0], low[1], low[2], high[0], high[1], high[2]);
  } else if (number % 3 == 1) {
    zones_.push_back(object_of(std::make_shared<fcl::Cylinderd>(size[0] / 2, 2 * size[2]), at));
    const Vec3 p = 1000 * at;
    const double half = 1000 * size[2];
    job_ += fmt::format("KEEPOUT z{} = CYLINDER {} {} {} {} {} {} RADIUS {}\n", number, p[0], p[1], p[2] - half, p[0],
                        p[1], p[2] + half, 500 * size[0]);
  } else {
    zones_.push_back(object_of(std::make_shared<fcl::Sphered>(size[0] / 2), at));
    job_ += fmt::format("KEEPOUT z{} = BALL {} {} {} RADIUS {}\n", number, 1000 * at[0], 1000 * at[1], 1000 * at[2],
                        500 * size[0]);
  }
}

Joints Scene::anywhere(std::mt19937& random) const {
  Joints q = Joints::Zero();
  for (int i = 0; i < axes(); ++i) {
    const ReferenceArm::Joint& joint = arm_.joints[static_cast<std::size_t>(i)];
    q[i] = within(random, joint.lower + 0.02, joint.upper - 0.02);
  }
  return q;
}

Joints Scene::clear_place(std::mt19937& random) const {
  constexpr double kClear = 0.012;  // m
  for (int i = 0; i < 100000; ++i) {
    const Joints q = anywhere(random);
    if (room(q, 2 * kClear) > kClear) {
      return q;
    }
  }
  throw std::runtime_error("the arm is clear nowhere");
}

void Scene::place(const Joints& q) const {
  const std::vector<ReferencePlace> places = arm_.places(q);
  for (std::size_t i = 0; i < links_.size(); ++i) {
    links_[i]->setTransform(places[i].frame);
    links_[i]->computeAABB();
  }
}

double Scene::distance(const fcl::CollisionObjectd& a, const fcl::CollisionObjectd& b, double most) {
  if (a.getAABB().distance(b.getAABB()) >= most) {
    return most;
  }
  const fcl::DistanceRequestd request;
  fcl::DistanceResultd result;
  try {
    return std::min(most, fcl::distance(&a, &b, request, result));
  } catch (const std::exception&) {  // it finds no answer; whether they meet is another algorithm
    const fcl::CollisionRequestd meet;
    fcl::CollisionResultd met;
    return fcl::collide(&a, &b, meet, met) > 0 ? -1 : most;
  }
}

double Scene::room(const Joints& q, double most) const {
  place(q);
  for (const auto& [a, b] : pairs_) {
    most = distance(*links_[a], *links_[b], most);
  }
  for (std::size_t i = 1; i < links_.size(); ++i) {
    for (const Object& zone : zones_) {
      most = distance(*links_[i], *zone, most);
    }
  }
  return most;
}

bool Scene::is_straight_clear() const {
  constexpr int kParts = 200;
  for (int i = 0; i <= kParts; ++i) {
    if (room(start + (goal - start) * i / kParts, 2 * kMargin) < kMargin) {
      return false;
    }
  }
  return true;
}

}  // namespace indurop::robot
