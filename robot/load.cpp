// SPDX-License-Identifier: Apache-2.0
// Loading the robot task: settings, files, and everything that is wrong with them at once.

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "base/diagnostic.h"
#include "robot/group.h"
#include "robot/read_files.h"

namespace indurop::robot {

namespace {

using Diagnostics = std::vector<base::Diagnostic>;

base::Diagnostic error(std::string file, base::SourcePlace place, std::string text) {
  return {base::Diagnostic::Severity::Error, std::move(file), place, std::move(text)};
}

void take_over(Diagnostics&& from, Diagnostics& to) {
  std::move(from.begin(), from.end(), std::back_inserter(to));
}

Diagnostics check_settings(const Settings& s) {
  Diagnostics errors;
  const auto positive = [&](const char* name, double value) {
    if (!(std::isfinite(value) && value > 0)) {
      errors.push_back(error(std::string("property ") + name, {}, "it has to be above 0"));
    }
  };
  positive("counts_per_turn", s.counts_per_turn);
  positive("gear", std::abs(s.gear));
  positive("time_to_speed", s.time_to_speed);
  positive("time_to_acceleration", s.time_to_acceleration);
  positive("tool_speed", s.tool_speed);
  positive("tool_turn_speed", s.tool_turn_speed);
  positive("emergency_factor", s.emergency_factor);
  positive("following_limit", s.following_limit);
  positive("regain_distance", s.regain_distance);
  positive("plan_time", s.plan_time);
  positive("counts_per_mm", s.counts_per_mm);
  if (s.emergency_category != StopCategory::Category0 && s.emergency_category != StopCategory::Category1) {
    errors.push_back(
        error("property emergency_category", {}, "it has to be 0 or 1, an emergency stop takes power away"));
  }
  if (s.period <= std::chrono::nanoseconds::zero()) {
    errors.push_back(error("module", {}, "the robot task is periodic, give it a <period>"));
  }
  return errors;
}

// Numbers of which each axis has one.
Diagnostics check_axes(const Settings& s, const Arm& arm) {
  Diagnostics errors;
  const auto each = [&](const char* name, const std::vector<double>& values) {
    const bool sane = std::all_of(values.begin(), values.end(), [](double v) { return std::isfinite(v) && v > 0; });
    const auto count = static_cast<std::size_t>(arm.count());
    if (!values.empty() && (values.size() != count || !sane)) {
      errors.push_back(error(std::string("property ") + name, {},
                             "it has to be " + std::to_string(count) + " numbers above 0, one of each axis"));
    }
  };
  each("acceleration", s.acceleration);
  each("jerk", s.jerk);
  return errors;
}

// Of each axis, from deg or mm.
void take(const std::vector<double>& values, const Arm& arm, Joints& to) {
  for (int i = 0; i < static_cast<int>(values.size()); ++i) {
    to[i] = values[static_cast<std::size_t>(i)] * (arm.axis(i).slides() ? 0.001 : kPi / 180);
  }
}

GroupParts parts_of(const Settings& settings, ReadFiles files) {
  const ArmModel& model = *files.model;
  GroupParts parts{settings, model.arm, {}, {}, std::move(files.book), std::move(files.kind)};
  parts.joints.velocity = model.velocity;
  parts.joints.acceleration = model.velocity / settings.time_to_speed;
  take(settings.acceleration, parts.arm, parts.joints.acceleration);
  parts.joints.jerk = parts.joints.acceleration / settings.time_to_acceleration;
  take(settings.jerk, parts.arm, parts.joints.jerk);
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

std::unique_ptr<Controller> Controller::load(const Settings& settings, std::vector<std::string>& errors) {
  Diagnostics wrong = check_settings(settings);
  ReadFiles files = read_files({settings.urdf, settings.jobs, settings.workspace});
  take_over(std::move(files.errors), wrong);
  if (files.model) {
    take_over(check_axes(settings, files.model->arm), wrong);
  }
  if (wrong.empty()) {
    return std::make_unique<Group>(parts_of(settings, std::move(files)));
  }
  // The header users include knows nothing of ours.
  std::transform(wrong.begin(), wrong.end(), std::back_inserter(errors),
                 [](const base::Diagnostic& one) { return base::to_string(one); });
  return nullptr;
}

}  // namespace indurop::robot
