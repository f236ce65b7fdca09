// SPDX-License-Identifier: Apache-2.0
#include "control/robot/group/ways_ahead.h"

#include <algorithm>

namespace indurop::robot {

static_assert(PathPieces::kMaxSegments == kWaysAhead);

ToolWay* WaysAhead::for_plan(const PlanningDesk& desk, const ToolWay* taken) noexcept {
  const auto leads = [](const PathPieces& path, const ToolWay* way) {
    return std::any_of(path.segments.begin(), path.segments.begin() + path.count,
                       [way](const Segment& segment) { return segment.way_ahead == way; });
  };
  auto* const free = std::find_if(ways_.begin(), ways_.end(), [&](const ToolWay& way) {
    return &way != taken && !desk.uses(&way) && !leads(robot_.follower.path().pieces(), &way) &&
           !leads(robot_.follower.kept_path().pieces, &way) &&
           std::none_of(left_.begin(), left_.end(), [&](const KeptPath& path) { return leads(path.pieces, &way); });
  });
  if (free == ways_.end()) {
    return nullptr;
  }
  made_ = made_ == UINT32_MAX ? 1 : made_ + 1;
  free->number = made_;
  return free;
}

void WaysAhead::report(bool known, Outputs& out) noexcept {
  const PathPieces& path = robot_.follower.path().pieces();
  out.ways = {};
  out.ways_changed = false;
  std::size_t count = 0;
  for (int i = 0; i < path.count && known; ++i) {
    if (path.segments[at(i)].way_ahead == nullptr) {
      break;
    }
    out.ways[count++] = path.segments[at(i)].way_ahead;
  }
  for (std::size_t i = 0; i < reported_.size(); ++i) {
    const std::uint32_t number = out.ways[i] != nullptr ? out.ways[i]->number : 0;
    out.ways_changed = out.ways_changed || number != reported_[i];
    reported_[i] = number;
  }
}

}  // namespace indurop::robot
