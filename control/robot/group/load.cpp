// SPDX-License-Identifier: Apache-2.0
// Loads the robot task: settings, files, and all errors in them at once.

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "control/robot/files/read_files.h"
#include "control/robot/group/group.h"
#include "control/robot/kinematics/settings.h"
#include "core/base/diagnostic.h"

namespace indurop::robot {

namespace {

using Diagnostics = std::vector<base::Diagnostic>;

base::Diagnostic error(std::string file, base::SourcePlace place, std::string text) {
  return {base::Diagnostic::Severity::Error, std::move(file), place, std::move(text)};
}

void take_over(Diagnostics&& from, Diagnostics& to) {
  std::move(from.begin(), from.end(), std::back_inserter(to));
}

void take_over(const std::vector<WrongSetting>& from, Diagnostics& to) {
  for (const WrongSetting& one : from) {
    to.push_back(error("property " + one.property, {}, one.text));
  }
}

// Converts one value per axis, those of the arm and then the single ones, from deg or mm.
void take(const std::vector<double>& values, const GroupParts& parts, Joints& arm, Joints& singles) {
  const auto count = static_cast<std::size_t>(parts.arm.count());
  for (std::size_t i = 0; i < values.size(); ++i) {
    const bool own = i < count;
    const Axis& axis = own ? parts.arm.axis(static_cast<int>(i)) : parts.singles[i - count];
    const auto to = static_cast<Eigen::Index>(own ? i : i - count);
    (own ? arm : singles)[to] = values[i] * (axis.slides() ? 0.001 : kPi / 180);
  }
}

GroupParts parts_of(const Settings& settings, ReadFiles files) {
  const ArmModel& model = *files.model;
  GroupParts parts{settings,
                   model.arm,
                   {},
                   {},
                   std::move(files.book),
                   std::move(files.kind),
                   model.dynamics,
                   std::move(files.clearance),
                   std::move(files.urdf),
                   files.mark,
                   model.singles};
  parts.dynamics.turn_rotors(of_axes(settings.rotor_inertia));
  parts.joints.velocity = model.velocity;
  parts.joints.acceleration = model.velocity / settings.time_to_speed;
  parts.single_limits.velocity = model.single_velocity;
  parts.single_limits.acceleration = model.single_velocity / settings.time_to_speed;
  take(settings.acceleration, parts, parts.joints.acceleration, parts.single_limits.acceleration);
  parts.joints.jerk = parts.joints.acceleration / settings.time_to_acceleration;
  parts.single_limits.jerk = parts.single_limits.acceleration / settings.time_to_acceleration;
  take(settings.jerk, parts, parts.joints.jerk, parts.single_limits.jerk);
  ToolLimits& tool = parts.tool;
  tool.velocity = settings.tool_speed / 1000;
  tool.acceleration = tool.velocity / settings.time_to_speed;
  tool.jerk = tool.acceleration / settings.time_to_acceleration;
  tool.turn_velocity = radians(settings.tool_turn_speed);
  tool.turn_acceleration = tool.turn_velocity / settings.time_to_speed;
  tool.turn_jerk = tool.turn_acceleration / settings.time_to_acceleration;
  return parts;
}

}  // namespace

void take_properties(const std::function<std::string(const char*)>& property, Settings& settings,
                     std::vector<std::string>& errors) {
  for (const WrongSetting& one : take_properties(property, settings)) {
    errors.push_back(base::to_string(error("property " + one.property, {}, one.text)));
  }
}

std::unique_ptr<Controller> Controller::load(const Settings& settings, std::vector<std::string>& errors) {
  Diagnostics wrong;
  take_over(check_settings(settings), wrong);
  if (settings.period <= std::chrono::nanoseconds::zero()) {
    wrong.push_back(error("module", {}, "the robot task is periodic, give it a <period>"));
  }
  ReadFiles files = read_files(names_of(settings));
  take_over(std::move(files.errors), wrong);
  if (files.model) {
    take_over(check_axes(settings, files.model->arm, files.model->dynamics.known(), files.model->singles.size()),
              wrong);
  }
  if (wrong.empty()) {
    return std::make_unique<Group>(parts_of(settings, std::move(files)));
  }
  // The header that users include does not contain our types.
  std::transform(wrong.begin(), wrong.end(), std::back_inserter(errors),
                 [](const base::Diagnostic& one) { return base::to_string(one); });
  return nullptr;
}

}  // namespace indurop::robot
