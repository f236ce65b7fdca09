// SPDX-License-Identifier: Apache-2.0
#include "tools/solids/around.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>

#include "tools/solids/beyond.h"
#include "tools/solids/cut.h"

namespace indurop::solids {

namespace {

// A part of the surface, and the solid around it.
struct Part {
  Surface surface;
  Solid solid;
  bool whole = false;  // no cut reduces the waste
};

// Returns some of the triangles, to search for a cut; all of them count for the solids around the parts.
Surface some_of(const Surface& surface) {
  constexpr std::size_t kMaxTriangles = 2000;
  const std::size_t step = surface.size() / kMaxTriangles + 1;
  Surface some;
  for (std::size_t i = 0; i < surface.size(); i += step) {
    some.push_back(surface[i]);
  }
  return some;
}

// Returns those points of the sequence of the plastic number's sister (M. Roberts, "The unreasonable effectiveness of
// quasirandom sequences", 2018) that are inside.
Inside inside_places(const Surface& surface) {
  Eigen::AlignedBox3d extent;
  for (const Vec3& corner : corners_of(surface)) {
    extent.extend(corner);
  }
  constexpr int kPlaces = 2500;
  constexpr double kRoot = 1.2207440846057596;  // root of x^4 = x + 1
  const Vec3 step(1 / kRoot, 1 / (kRoot * kRoot), 1 / (kRoot * kRoot * kRoot));
  Inside inside{{}, extent.volume() / kPlaces};
  for (int i = 0; i < kPlaces; ++i) {
    const Vec3 spread = i * step;
    const Vec3 place = extent.min() + Vec3(spread.array() - spread.array().floor()).cwiseProduct(extent.sizes());
    if (inside_of(surface, place)) {
      inside.places.push_back(place);
    }
  }
  return inside;
}

class Cutter {
 public:
  Cutter(const Surface& surface, std::span<const Mat3> frames)
      : frames_(frames.begin(), frames.end()), inside_(inside_places(surface)) {}

  Part part_of(Surface surface) {
    Part part{std::move(surface), {}};
    const std::vector<Vec3> corners = corners_of(part.surface);
    part.solid = rounded(fit(corners, frames_, inside_), corners);
    return part;
  }

  // Returns nothing if no cut reduces the waste.
  std::optional<Parts> cut_well(const Part& part) {
    const Surface some = some_of(part.surface);
    std::vector<Mat3> frames = frames_;
    frames.emplace_back(part.solid.place.orientation.toRotationMatrix());
    std::vector<Vec3> normals;
    for (const Mat3& frame : frames) {
      for (const int axis : {0, 1, 2}) {
        const Vec3 normal = frame.col(axis);
        const auto same = [&](const Vec3& other) { return std::abs(other.dot(normal)) > 1 - 1e-9; };
        if (std::none_of(normals.begin(), normals.end(), same)) {
          normals.push_back(normal);
        }
      }
    }
    Cut best{{}, waste_of(part.solid, inside_)};
    for (const Vec3& normal : normals) {
      try_along(some, normal, frames, best);
    }
    if (!best.plane) {
      return {};
    }
    Parts parts = cut(part.surface, *best.plane);
    return parts.below.empty() || parts.above.empty() ? std::nullopt : std::optional(std::move(parts));
  }

 private:
  struct Cut {
    std::optional<Plane> plane;
    double waste = 0;  // m^3, of both parts
  };

  double waste_after(const Surface& surface, const Plane& plane, std::span<const Mat3> frames) {
    const PartCorners corners = corners_after(surface, plane);
    if (corners.below.empty() || corners.above.empty()) {
      return std::numeric_limits<double>::infinity();
    }
    return waste_of(fit_along(corners.below, frames, inside_), inside_) +
           waste_of(fit_along(corners.above, frames, inside_), inside_);
  }

  // Tries evenly spaced cuts, then closer ones around the best.
  void try_along(const Surface& some, const Vec3& normal, std::span<const Mat3> frames, Cut& best) {
    double low = std::numeric_limits<double>::infinity();
    double high = -low;
    for (const Vec3& corner : corners_of(some)) {
      low = std::min(low, corner.dot(normal));
      high = std::max(high, corner.dot(normal));
    }
    constexpr int kPlaces = 16;
    double step = (high - low) / kPlaces;
    double at_best = low;
    double least = std::numeric_limits<double>::infinity();
    const auto try_at = [&](double at) {
      if (const double waste = waste_after(some, {normal, at}, frames); waste < least) {
        least = waste;
        at_best = at;
      }
    };
    for (int i = 1; i < kPlaces; ++i) {
      try_at(low + i * step);
    }
    for (int closer = 0; closer < 5; ++closer) {
      step /= 2;
      const double middle = at_best;
      try_at(middle - step);
      try_at(middle + step);
    }
    if (least < best.waste) {
      best = {Plane{normal, at_best}, least};
    }
  }

  std::vector<Mat3> frames_;
  Inside inside_;
};

std::vector<Solid> solids_of(const std::vector<Part>& parts) {
  std::vector<Solid> solids;
  for (const Part& part : parts) {
    solids.push_back(part.solid);
  }
  return solids;
}

// Returns the part whose solid extends farthest beyond the surface, if that is too far and the part can be cut.
Part* worst_of(std::vector<Part>& parts, const Surface& surface, double within) {
  const std::vector<double> each = each_beyond(solids_of(parts), surface);
  Part* worst = nullptr;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    if (each[i] > within && !parts[i].whole) {
      within = each[i];
      worst = &parts[i];
    }
  }
  return worst;
}

}  // namespace

std::vector<Solid> solids_around(const Surface& surface, const Closeness& closeness, std::span<const Mat3> frames) {
  Cutter cutter(surface, frames);
  std::vector<Part> parts;
  parts.push_back(cutter.part_of(surface));
  while (parts.size() < static_cast<std::size_t>(closeness.most)) {
    Part* worst = worst_of(parts, surface, closeness.within);
    if (worst == nullptr) {
      break;
    }
    auto two = cutter.cut_well(*worst);
    if (!two) {
      worst->whole = true;
      continue;
    }
    *worst = cutter.part_of(std::move(two->below));
    parts.push_back(cutter.part_of(std::move(two->above)));
  }
  return solids_of(parts);
}

}  // namespace indurop::solids
