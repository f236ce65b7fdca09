// SPDX-License-Identifier: Apache-2.0
#include "control/robot/files/solve_points.h"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <memory>
#include <optional>
#include <sstream>
#include <string>

#include "control/robot/kinematics/tool_set.h"

namespace indurop::robot {

namespace {

using Diagnostics = std::vector<base::Diagnostic>;

base::Diagnostic point_error(const std::string& file, base::SourcePlace place, const std::string& text) {
  return {base::Diagnostic::Severity::Error, file, place, text};
}

std::string ways_of(const Solutions& found) {
  std::string ways;
  for (int i = 0; i < found.count; ++i) {
    const std::string one = std::to_string(found.list[static_cast<std::size_t>(i)].posture);
    ways += ways.find(one) != std::string::npos ? "" : (ways.empty() ? "" : ", ") + one;
  }
  return ways;
}

// Returns "RPY 180 0 12.5", the reachable orientation closest to that of a pose, if only the orientation prevents it;
// else nothing.
std::string nearest_turn(const Arm& arm, const Inverse& inverse, const Pose& pose) {
  const Solutions found = inverse.search(pose, Joints::Zero(), {64, 64, HUGE_VAL, 0});
  double least = HUGE_VAL;
  std::ostringstream text;
  for (int i = 0; i < found.count; ++i) {
    const Quat turn = arm.forward(found.list[static_cast<std::size_t>(i)].q).orientation;
    const double away = rotation_between(turn, pose.orientation).norm();
    if (away < least - 1e-6) {
      const Vec3 rpy = to_rpy(turn);
      least = away;
      text.str("");
      text << std::fixed << std::setprecision(2) << "RPY " << degrees(rpy[0]) << " " << degrees(rpy[1]) << " "
           << degrees(rpy[2]);
    }
  }
  return text.str();
}

// Returns "200 degrees" or "35 mm".
std::string with_unit(const Axis& axis, double value) {
  std::ostringstream text;
  text << (axis.slides() ? 1000 * value : degrees(value)) << (axis.slides() ? " mm" : " degrees");
  return text.str();
}

// Returns " with AXIS 7 at 90 degrees": a pose may be in reach only where these axes are elsewhere.
std::string where_held(const Arm& arm, const Target& target) {
  std::string text;
  for (int i = 0; i < arm.count(); ++i) {
    const std::string axis = "AXIS " + std::to_string(i + 1);
    if (holds(target.held, i)) {
      text += (text.empty() ? " with " : " and ") + axis + " at " + with_unit(arm.axis(i), target.joints[i]);
    } else if (arm.moves_workpiece(i)) {
      text += (text.empty() ? " with " : " and ") + axis + " anywhere";
    }
  }
  return text;
}

std::string out_of_reach(const Arm& arm, const Inverse& inverse, const Target& target, Reach reach) {
  const std::string turn = arm.count() < 6 ? nearest_turn(arm, inverse, target.pose) : "";
  if (!turn.empty()) {
    return "an arm of " + std::to_string(arm.count()) + " axes cannot hold its tool like that there; the nearest is " +
           turn;
  }
  return "the arm cannot hold its tool like that there" + where_held(arm, target) +
         (reach == Reach::JointLimit ? " within the limits of its joints" : "") +
         "; give it a nearer position or another orientation";
}

// Returns "is at 200 degrees, its limits are -170 to 170".
std::string value_and_limits(const Axis& axis, double value) {
  const double unit = axis.slides() ? 0.001 : kPi / 180;
  std::ostringstream text;
  text << "is at " << with_unit(axis, value);
  text << (axis.endless ? "; its drive counts from " : ", its limits are ") << axis.lowest() / unit << " to "
       << axis.highest() / unit << (axis.endless ? " (counts_per_turn)" : "");
  return text.str();
}

// Returns what is wrong with AXIS of a point or a motion, which may give the value only of an axis that a pose leaves
// undetermined; nothing if it is good, or `value` is not known.
std::string wrong_axis(const Arm& arm, int axis, std::optional<double> value) {
  const std::string name = "AXIS " + std::to_string(axis + 1) + " ";
  if (!holds(redundant_axes(arm), axis)) {
    return name + "follows from the pose; leave it out, or use JOINT";
  }
  const Axis& a = arm.axis(axis);
  const bool beyond = value && !(*value >= a.lowest() && *value <= a.highest());
  return beyond ? name + value_and_limits(a, *value) : "";
}

// Adds what is wrong with AXIS of a point. Returns whether it is good.
bool check_axes(const Point& point, const Arm& arm, Diagnostics& errors) {
  for (int i = 0; i < arm.count(); ++i) {
    const std::string wrong = holds(point.target.held, i) ? wrong_axis(arm, i, point.target.joints[i]) : "";
    if (!wrong.empty()) {
      const base::SourcePlace word{point.place.line, point.axis_columns[at(i)]};
      errors.push_back(
          point_error(point.file, word.column > 0 ? word : point.place, "point '" + point.name + "': " + wrong));
      return false;
    }
  }
  return true;
}

std::string wrong_pose(const Arm& arm, const Inverse& inverse, const Target& target, const Solutions& found) {
  if (found.count == 0) {
    return out_of_reach(arm, inverse, target, found.reach);
  }
  if (target.posture && !inverse.has_postures()) {
    return "this arm has no postures; leave POSTURE out, or use JOINT";
  }
  if (target.posture && found.nearest(Joints::Zero(), target.posture) == nullptr) {
    return "not possible in posture " + std::to_string(*target.posture) + ", but in " + ways_of(found);
  }
  return "";
}

}  // namespace

// Taught tools and points in frames have no known positions while there are other errors: no messages about them then.
bool is_known(const Point& point, const JobBook& book, bool placed) {
  const auto taught = [](const Tool& tool) { return tool.is_taught; };
  return placed || (point.frame < 0 && std::none_of(book.tools.begin(), book.tools.end(), taught));
}

Diagnostics check_points(const JobBook& book, const Arm& arm) {
  Diagnostics errors;
  for (const Point& point : book.points) {
    const int axis = point.target.is_pose ? -1 : arm.beyond_limits(point.target.joints);
    if (axis >= 0) {
      errors.push_back(point_error(point.file, point.place,
                                   "point '" + point.name + "': joint " + std::to_string(axis + 1) + " " +
                                       value_and_limits(arm.axis(axis), point.target.joints[axis])));
    }
  }
  return errors;
}

// The tool at a point is known only when the job runs; points that no tool reaches are reported now. The posture of an
// arm without a closed form at poses has to be searched for, which is done here, before anything moves: a pose without
// solution is an error there.
Diagnostics solve_points(JobBook& book, const Arm& arm, bool placed) {
  Diagnostics errors;
  const ToolSet tools(arm, book.tips());
  for (Point& point : book.points) {
    const Target& target = point.target;
    if (!target.is_pose || !is_known(point, book, placed)) {
      continue;
    }
    if (!check_axes(point, arm, errors)) {
      continue;
    }
    const bool open = tools.inverse(0).leaves_workpiece_open(target.held);
    const bool closed =
        tools.inverse(0).closed_form() && (target.held & ~workpiece_axes(arm)) == 0;  // the solutions need not be kept
    Search how;
    how.held = target.held;
    std::string wrong;
    bool possible = false;
    for (int i = 0; i < tools.count(); ++i) {
      const Inverse& inverse = tools.inverse(i);
      const auto found = std::make_shared<const Solutions>(
          closed && !open ? inverse.all(target.pose, target.joints) : inverse.search(target.pose, target.joints, how));
      const std::string text = wrong_pose(tools.arm(i), inverse, target, *found);
      wrong = i == 0 ? text : wrong;
      possible = possible || text.empty();
      if (!closed && !open) {  // where the workpiece stands is known only when the job runs
        book.known.push_back(found);
        point.known.push_back(found.get());
      }
    }
    if (!possible) {
      errors.push_back(point_error(point.file, point.place, "point '" + point.name + "': " + wrong));
      const bool may_move = closed || book.is_computed(point);
      errors.back().severity = may_move ? base::Diagnostic::Severity::Warning : base::Diagnostic::Severity::Error;
    }
  }
  return errors;
}

// The axes of lines and circles.
Diagnostics check_axes_of_motions(const JobBook& book, const Arm& arm) {
  Diagnostics errors;
  for (const Job& job : book.jobs) {
    for (const Step& step : job.steps) {
      const MotionExtras* const extras = step.op == Op::Move ? book.extras_of(step) : nullptr;
      for (std::size_t i = 0; extras != nullptr && i < extras->settings.size(); ++i) {
        const Step& each = extras->settings[i];
        if (each.op != Op::Axis) {
          continue;
        }
        const std::string wrong =
            wrong_axis(arm, each.index, each.formula < 0 ? std::optional(each.value) : std::nullopt);
        if (!wrong.empty()) {
          errors.push_back(point_error(job.file, {static_cast<int>(each.line), static_cast<int>(each.column)}, wrong));
        }
      }
    }
  }
  return errors;
}

}  // namespace indurop::robot
