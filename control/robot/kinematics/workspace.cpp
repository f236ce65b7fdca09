// SPDX-License-Identifier: Apache-2.0
#include "control/robot/kinematics/workspace.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace indurop::robot {

namespace {

constexpr double kEdge = 1e-7;  // m: tolerance for rounding

}  // namespace

Workspace Workspace::of(const std::vector<double>& corners) noexcept {
  if (corners.size() != 6) {
    return {};
  }
  return {Vec3(corners[0], corners[1], corners[2]) / 1000, Vec3(corners[3], corners[4], corners[5]) / 1000};
}

bool Workspace::left(const Vec3& from, const Vec3& to, double bulge) const noexcept {
  return known_ && !(outside(to) + bulge <= std::max(outside(from), 0.0) + kEdge);
}

std::string Workspace::text() const {
  std::ostringstream text;
  for (int i = 0; i < 3; ++i) {
    text << "xyz"[i] << " " << 1000 * low_[i] << " to " << 1000 * high_[i] << (i < 2 ? ", " : " mm");
  }
  return text.str();
}

// Between two places a smooth path deviates from the straight line by an eighth of its second difference; twice that is
// safe.
bool WayInside::next(const Vec3& place) noexcept {
  const double bulge = begun_ ? (place - 2 * seen_[0] + seen_[1]).norm() / 4 : 0;
  const bool inside = !box_.left(seen_[0], place, box_.outside(place) < 0 ? bulge : 0);
  begun_ = true;
  seen_[1] = seen_[0];
  seen_[0] = place;
  return inside;
}

}  // namespace indurop::robot
