// SPDX-License-Identifier: Apache-2.0
#include "control/robot/collision/body_distance.h"

#include <fcl/geometry/shape/box.h>
#include <fcl/geometry/shape/cylinder.h>
#include <fcl/geometry/shape/sphere.h>
#include <fcl/narrowphase/distance.h>

#include <algorithm>
#include <exception>

namespace indurop::robot {

namespace {

std::shared_ptr<fcl::CollisionGeometryd> shape_of(const Solid& solid) {
  const Vec3& half = solid.half;
  switch (solid.kind) {
    case SolidKind::Box:
      return std::make_shared<fcl::Boxd>(2 * half.x(), 2 * half.y(), 2 * half.z());
    case SolidKind::Cylinder:
      return std::make_shared<fcl::Cylinderd>(half.x(), 2 * half.z());
    case SolidKind::Ball:
      break;
  }
  return std::make_shared<fcl::Sphered>(half.x());
}

}  // namespace

struct Nearest::Objects {
  std::vector<fcl::CollisionObjectd> list;
  fcl::DistanceRequestd request{true};  // with the nearest points
  fcl::DistanceResultd result;
};

Nearest::Nearest(const std::vector<Solid>& parts) : objects_(std::make_unique<Objects>()) {
  std::transform(parts.begin(), parts.end(), std::back_inserter(objects_->list),
                 [](const Solid& part) { return fcl::CollisionObjectd(shape_of(part)); });
}

Nearest::~Nearest() = default;

double Nearest::distance(int a, int b, const PlacedSolid& at_a, const PlacedSolid& at_b) noexcept {
  const double least = least_distance(at_a, at_b);
  try {
    fcl::CollisionObjectd& first = objects_->list[static_cast<std::size_t>(a)];
    fcl::CollisionObjectd& second = objects_->list[static_cast<std::size_t>(b)];
    first.setTransform(at_a.axes, at_a.middle);
    second.setTransform(at_b.axes, at_b.middle);
    objects_->result.clear();
    if (!(fcl::distance(&first, &second, objects_->request, objects_->result) > 0)) {
      return least;
    }
  } catch (const std::exception&) {  // if FCL finds no answer
    return least;
  }
  const Vec3 line = objects_->result.nearest_points[1] - objects_->result.nearest_points[0];
  const double length = line.norm();
  return length > 0 ? std::max(least, gap(at_a, at_b, line / length)) : least;
}

}  // namespace indurop::robot
