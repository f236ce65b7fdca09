// SPDX-License-Identifier: Apache-2.0
// Loading the robot task: files, settings, and everything that is wrong with them at once.

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <sstream>
#include <utility>

#include "base/diagnostic.h"
#include "base/read_file.h"
#include "robot/group.h"
#include "robot/urdf.h"

namespace indurop::robot {

namespace {

constexpr std::size_t kMostBytes = 4U << 20U;

using Diagnostics = std::vector<base::Diagnostic>;

base::Diagnostic error(std::string file, base::SourcePlace place, std::string text) {
  return {base::Diagnostic::Severity::Error, std::move(file), place, std::move(text)};
}

void take_over(Diagnostics&& from, Diagnostics& to) {
  std::move(from.begin(), from.end(), std::back_inserter(to));
}

Result<std::string, base::Diagnostic> text_of(const std::string& path, const char* what) {
  auto text = base::read_file(path, kMostBytes);
  if (text) {
    return std::move(*text);
  }
  using Kind = base::FileProblem::Kind;
  const base::FileProblem& problem = text.error();
  return error(path, {1, 1},
               std::string("this ") + what +
                   (problem.kind == Kind::TooLarge ? " has more than 4 MiB"
                    : problem.kind == Kind::System
                        ? " cannot be read; names begin at the folder of the module.xml"
                        : " cannot be read: " + problem.text + "; names begin at the folder of the module.xml"));
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
  if (s.emergency_category != StopCategory::Category0 && s.emergency_category != StopCategory::Category1) {
    errors.push_back(
        error("property emergency_category", {}, "it has to be 0 or 1, an emergency stop takes power away"));
  }
  if (s.period <= std::chrono::nanoseconds::zero()) {
    errors.push_back(error("module", {}, "the robot task is periodic, give it a <period>"));
  }
  return errors;
}

std::vector<JobFile> read_jobs(const Settings& settings, Diagnostics& errors) {
  std::vector<JobFile> files;
  for (const std::string& path : settings.jobs) {
    if (auto text = text_of(path, "job")) {
      files.push_back({path, std::move(text).value()});
    } else {
      errors.push_back(std::move(text).error());
    }
  }
  return files;
}

GroupParts parts_of(const Settings& settings, ArmModel model, JobBook book) {
  GroupParts parts{settings, std::move(model.arm), {}, {}, std::move(book)};
  parts.joints.velocity = model.velocity;
  parts.joints.acceleration = model.velocity / settings.time_to_speed;
  parts.joints.jerk = parts.joints.acceleration / settings.time_to_acceleration;
  ToolLimits& tool = parts.tool;
  tool.velocity = settings.tool_speed / 1000;
  tool.acceleration = tool.velocity / settings.time_to_speed;
  tool.jerk = tool.acceleration / settings.time_to_acceleration;
  tool.turn_velocity = radians(settings.tool_turn_speed);
  tool.turn_acceleration = tool.turn_velocity / settings.time_to_speed;
  tool.turn_jerk = tool.turn_acceleration / settings.time_to_acceleration;
  return parts;
}

// Points given as joint angles can be checked against the arm right away.
Diagnostics check_points(const JobBook& book, const Arm& arm) {
  Diagnostics errors;
  for (const Point& point : book.points) {
    const int axis = point.target.is_pose ? -1 : arm.beyond_limits(point.target.joints);
    if (axis >= 0) {
      std::ostringstream text;
      text << "point '" << point.name << "': joint " << axis + 1 << " is at " << degrees(point.target.joints[axis])
           << " degrees, its limits are " << degrees(arm.axis(axis).lower) << " to " << degrees(arm.axis(axis).upper);
      errors.push_back(error(point.file, point.place, text.str()));
    }
  }
  return errors;
}

}  // namespace

std::unique_ptr<Controller> Controller::load(const Settings& settings, std::vector<std::string>& errors) {
  Diagnostics wrong = check_settings(settings);
  std::optional<ArmModel> model;
  if (auto text = text_of(settings.urdf, "robot description (property urdf)"); !text) {
    wrong.push_back(std::move(text).error());
  } else if (auto arm = arm_from_urdf(settings.urdf, *text)) {
    model = std::move(arm).value();
  } else {
    take_over(std::move(arm).error(), wrong);
  }
  ReadJobs jobs = parse_jobs(read_jobs(settings, wrong));
  take_over(std::move(jobs.diagnostics), wrong);
  if (model) {
    take_over(check_points(jobs.book, model->arm), wrong);
  }
  if (wrong.empty()) {
    return std::make_unique<Group>(parts_of(settings, std::move(*model), std::move(jobs.book)));
  }
  // The header users include knows nothing of ours.
  std::transform(wrong.begin(), wrong.end(), std::back_inserter(errors),
                 [](const base::Diagnostic& one) { return base::to_string(one); });
  return nullptr;
}

}  // namespace indurop::robot
