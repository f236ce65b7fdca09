// SPDX-License-Identifier: Apache-2.0
#include "doors/ros/arm/trajectory.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "control/robot/path/time_profile.h"

namespace indurop::ros {
namespace {

using robot::TimeProfile;
using Axes = std::vector<AxisNow>;

constexpr double kMargin = 1e-6;  // of limits, above rounding

// The points behind the start that are places of the tables.
using Chosen = std::set<std::size_t>;

robot::ProfileTable table_of(const std::vector<TrajectoryPoint>& points, const Chosen& chosen, std::size_t axis) {
  robot::ProfileTable table;
  for (const std::size_t point : chosen) {
    const auto at = static_cast<std::size_t>(table.points++);
    table.time[at] = points[point].time;
    table.value[at] = points[point].positions[axis];
  }
  return table;
}

std::vector<TimeProfile> curves_of(const std::vector<TrajectoryPoint>& points, const Chosen& chosen, const Axes& axes) {
  std::vector<TimeProfile> curves(axes.size());
  for (std::size_t axis = 0; axis < axes.size(); ++axis) {
    robot::LineState start;
    start.position = axes[axis].command;
    curves[axis].set(table_of(points, chosen, axis), TimeProfile::Of::Position, {}, start);
  }
  return curves;
}

struct Farthest {
  std::size_t point = 0;
  double distance = 0;
};
Farthest farthest_of(const std::vector<TrajectoryPoint>& points, const std::vector<TimeProfile>& curves) {
  Farthest found;
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (std::size_t axis = 0; axis < curves.size(); ++axis) {
      const double distance = std::abs(curves[axis].at(points[i].time).position - points[i].positions[axis]);
      found = distance > found.distance ? Farthest{i, distance} : found;
    }
  }
  return found;
}

// All points, or if those are too many the last one and always the one from which the curves are farthest.
Chosen choose(const std::vector<TrajectoryPoint>& points, const Axes& axes, double deviation) {
  Chosen chosen;
  if (points.size() <= robot::kProfilePoints) {
    for (std::size_t i = 0; i < points.size(); ++i) {
      chosen.insert(i);
    }
    return chosen;
  }
  chosen.insert(points.size() - 1);
  while (chosen.size() < robot::kProfilePoints) {
    const Farthest next = farthest_of(points, curves_of(points, chosen, axes));
    if (next.distance <= deviation || !chosen.insert(next.point).second) {
      break;
    }
  }
  return chosen;
}

std::string fault_of(const std::vector<TrajectoryPoint>& points, const Axes& axes) {
  if (points.empty()) {
    return "it has no points";
  }
  double before = -1;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const TrajectoryPoint& point = points[i];
    if (point.positions.size() != axes.size()) {
      return fmt::format("point {} has {} positions, the arm has {} axes", i, point.positions.size(), axes.size());
    }
    if (!std::isfinite(point.time) || !(point.time > before) || point.time < 0) {
      return fmt::format("the time of point {}, {} s, is not above that of the point before", i, point.time);
    }
    before = point.time;
    for (std::size_t axis = 0; axis < axes.size(); ++axis) {
      const AxisNow& now = axes[axis];
      if (!(point.positions[axis] >= now.lower && point.positions[axis] <= now.upper)) {
        return fmt::format("point {}: {:.3f} is not within the ends of axis {}, {:.3f} to {:.3f} (deg or mm)", i,
                           point.positions[axis], axis + 1, now.lower, now.upper);
      }
    }
  }
  return {};
}

// Removes the points at the start, which the arm has to be at.
std::string take_start(std::vector<TrajectoryPoint>& points, const Axes& axes, double most) {
  constexpr double kLeastTime = 1e-6;  // s
  if (points.front().time >= kLeastTime) {
    return {};
  }
  for (std::size_t axis = 0; axis < axes.size(); ++axis) {
    const double distance = points.front().positions[axis] - axes[axis].command;
    if (std::abs(distance) > most) {
      return fmt::format("it begins {:.3f} deg or mm away from where axis {} is, {} at most are allowed", distance,
                         axis + 1, most);
    }
  }
  points.erase(points.begin());
  return points.empty() ? "it has only the point at its start" : std::string();
}

// Of speeds, accelerations and jerks the one that needs most time.
void stretch_for(const TimeProfile::Ranges& all, const AxisNow& axis, int number, TrajectoryPlan& plan) {
  const double needed =
      std::max({all.velocity.peak() / axis.most_velocity, std::sqrt(all.acceleration.peak() / axis.most_acceleration),
                std::cbrt(all.jerk.peak() / axis.most_jerk)});
  if (!(needed <= plan.stretch)) {
    plan.stretch = needed * (1 + kMargin);
    plan.slowest = number;
  }
}

}  // namespace

Result<TrajectoryPlan, base::Problem> plan_trajectory(const std::vector<TrajectoryPoint>& points,
                                                      const std::vector<AxisNow>& axes,
                                                      const TrajectoryLimits& limits) {
  std::vector<TrajectoryPoint> rest = points;
  std::string wrong = fault_of(rest, axes);
  if (wrong.empty()) {
    wrong = take_start(rest, axes, limits.start);
  }
  if (!wrong.empty()) {
    return base::Problem{wrong};
  }
  const Chosen chosen = choose(rest, axes, limits.deviation);
  const std::vector<TimeProfile> curves = curves_of(rest, chosen, axes);
  TrajectoryPlan plan;
  plan.deviation = farthest_of(rest, curves).distance;
  if (plan.deviation > limits.deviation) {
    return base::Problem{
        fmt::format("its {} points do not fit into a table of {} places: some would be missed by {:.3f}"
                    " deg or mm; divide it",
                    rest.size(), robot::kProfilePoints, plan.deviation)};
  }
  for (std::size_t axis = 0; axis < axes.size(); ++axis) {
    const TimeProfile::Ranges all = curves[axis].ranges();
    const AxisNow& now = axes[axis];
    if (all.position.least < now.lower || all.position.greatest > now.upper) {
      return base::Problem{
          fmt::format("between its points, axis {} would leave its range of {:.3f} to {:.3f} (deg or mm)", axis + 1,
                      now.lower, now.upper)};
    }
    stretch_for(all, now, static_cast<int>(axis), plan);
    plan.tables.push_back(table_of(rest, chosen, axis));
  }
  if (!std::isfinite(plan.stretch)) {
    return base::Problem{"the limits of an axis are not known"};
  }
  plan.duration = rest.back().time * plan.stretch;
  return plan;
}

}  // namespace indurop::ros
