// SPDX-License-Identifier: Apache-2.0
#include "control/robot/space/cell_grid.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace indurop::robot {

namespace {

// Returns the distance of a point from a solid, in m; 0: it is inside.
double distance_from(const PlacedSolid& solid, const Vec3& point) noexcept {
  const Vec3 local = solid.axes.transpose() * (point - solid.middle);
  if (solid.kind == SolidKind::Box) {
    return (local.cwiseAbs() - solid.half).cwiseMax(0).norm();
  }
  if (solid.kind == SolidKind::Ball) {
    return std::max(local.norm() - solid.half.x(), 0.0);
  }
  const double across = std::max(local.head<2>().norm() - solid.half.x(), 0.0);
  return std::hypot(across, std::max(std::abs(local.z()) - solid.half.z(), 0.0));
}

Vec3 corner_of(const std::vector<double>& box, std::size_t first) {
  return Vec3(box[first], box[first + 1], box[first + 2]) / 1000;
}

Pose base_of(const std::vector<double>& numbers) {
  Pose base;
  if (numbers.size() == 6) {
    base.position = Vec3(numbers[0], numbers[1], numbers[2]) / 1000;
    base.orientation = from_rpy({radians(numbers[3]), radians(numbers[4]), radians(numbers[5])});
  }
  return base;
}

std::uint64_t column_of(const SpaceCells& cells, int x, int y) noexcept {
  return cells[static_cast<std::size_t>(x * 32 + y) / 2] >> (y % 2 == 0 ? 0U : 32U) & 0xFFFFFFFFU;
}

}  // namespace

CellGrid::CellGrid(const std::vector<double>& box, const std::vector<double>& base)
    : corner_(corner_of(box, 0).cwiseMin(corner_of(box, 3))),
      edges_((corner_of(box, 0) - corner_of(box, 3)).cwiseAbs().cwiseQuotient(Vec3(kCount[0], kCount[1], kCount[2]))),
      half_diagonal_(edges_.norm() / 2),
      base_(base_of(base)) {}

CellGrid::Range CellGrid::range(const PlacedSolid& body, double more, int axis) const noexcept {
  const double half = body.reach(Vec3::Unit(axis)) + more;
  const double last = kCount[at(axis)] - 1;
  const auto cell = [&](double place) {
    return static_cast<int>(std::clamp(std::floor((place - corner_[axis]) / edges_[axis]), 0.0, last));
  };
  return {cell(body.middle[axis] - half), cell(body.middle[axis] + half)};
}

Vec3 CellGrid::middle_of(int x, int y, int z) const noexcept {
  return corner_ + Vec3(x + 0.5, y + 0.5, z + 0.5).cwiseProduct(edges_);
}

void CellGrid::add(const PlacedSolid& body, double more, SpaceCells& cells) const noexcept {
  PlacedSolid here = body;
  here.middle = base_.position + base_.orientation * body.middle;
  here.axes = base_.orientation.toRotationMatrix() * body.axes;
  const Range xs = range(here, more, 0);
  const Range ys = range(here, more, 1);
  const Range zs = range(here, more, 2);
  const auto inner = [](int i, int axis) { return i > 0 && i < kCount[at(axis)] - 1; };
  for (int x = xs.first; x <= xs.last; ++x) {
    for (int y = ys.first; y <= ys.last; ++y) {
      std::uint64_t column = 0;
      for (int z = zs.first; z <= zs.last; ++z) {
        // A cell at a side has no end there.
        const bool bounded = inner(x, 0) && inner(y, 1) && inner(z, 2);
        if (!bounded || distance_from(here, middle_of(x, y, z)) <= more + half_diagonal_) {
          column |= std::uint64_t{1} << static_cast<unsigned>(z);
        }
      }
      cells[static_cast<std::size_t>(x * kCount[1] + y) / 2] |= column << (y % 2 == 0 ? 0U : 32U);
    }
  }
}

bool meets(const SpaceCells& cells, const SpaceCells& except, const SpaceCells& other) noexcept {
  std::uint64_t met = 0;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    met |= cells[i] & ~except[i] & other[i];
  }
  return met != 0;
}

bool meets(const SpaceCells& cells, const SpaceBox& box) noexcept {
  const unsigned many = box.last[2] - box.first[2] + 1U;
  const std::uint64_t column = (many < 32 ? (std::uint64_t{1} << many) - 1 : 0xFFFFFFFFU) << box.first[2];
  for (int x = box.first[0]; x <= box.last[0]; ++x) {
    for (int y = box.first[1]; y <= box.last[1]; ++y) {
      if ((column_of(cells, x, y) & column) != 0) {
        return true;
      }
    }
  }
  return false;
}

SpaceBox box_around(const SpaceCells& cells) noexcept {
  constexpr int kMost = 31;
  SpaceBox box{{kMost, kMost, kMost}, {0, 0, 0}};
  const auto add = [&box](std::size_t axis, int first, int last) {
    box.first[axis] = std::min(box.first[axis], static_cast<std::uint8_t>(first));
    box.last[axis] = std::max(box.last[axis], static_cast<std::uint8_t>(last));
  };
  for (int x = 0; x <= kMost; ++x) {
    for (int y = 0; y <= kMost; ++y) {
      if (const std::uint64_t column = column_of(cells, x, y); column != 0) {
        add(0, x, x);
        add(1, y, y);
        add(2, std::countr_zero(column), 63 - std::countl_zero(column));
      }
    }
  }
  return box;
}

void join(SpaceCells& to, const SpaceCells& cells) noexcept {
  for (std::size_t i = 0; i < cells.size(); ++i) {
    to[i] |= cells[i];
  }
}

}  // namespace indurop::robot
