// SPDX-License-Identifier: Apache-2.0
// The differences for a path that consists of many pieces: a chain of lines, or a spline.

#include <algorithm>
#include <cmath>

#include "control/robot/plan/planner.h"

namespace indurop::robot {

namespace {

constexpr double kSpacing = 0.005;  // m between checked places

}  // namespace

Fault Planner::begin(const ToolPath& chain, const Joints& from, double acceleration) noexcept {
  begin(from, acceleration);
  Segment& s = segment_;
  s.move = Move::Line;
  s.chain = &chain;
  s.end = chain.end();
  s.way = chain.way();
  s.length = chain.length();
  s.source = chain.source_at(0);
  if (!from.allFinite() || !std::isfinite(s.length) || s.length <= 0) {
    return {ErrorCode::Value};
  }
  s.limits = chain.limits_at(0);
  begin_look(kSpacing, kMost);
  return {};
}

// Applies the tool's limits between this place of a chain and the one before.
void Planner::bound_tool(int place) noexcept {
  const double part = 1.0 / count_;
  const int last = static_cast<int>(part * place * PathBounds::kParts);
  for (int i = static_cast<int>(part * (place - 1) * PathBounds::kParts); i < last; ++i) {
    const LineLimits most = segment_.chain->limits_at(segment_.length * (i + 0.5) / PathBounds::kParts);
    bounds_.speed[static_cast<std::size_t>(i)] = most.velocity;
    bounds_.acceleration[static_cast<std::size_t>(i)] = most.acceleration;
    LineLimits& all = segment_.limits;
    all = {std::min(all.velocity, most.velocity), std::min(all.acceleration, most.acceleration),
           std::min(all.jerk, most.jerk)};
    wanted_ = std::min(wanted_, all.velocity);
  }
}

}  // namespace indurop::robot
