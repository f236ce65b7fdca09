// SPDX-License-Identifier: Apache-2.0
// Loading the robot task: files, settings, and everything that is wrong with them at once.

#include <cmath>
#include <optional>
#include <sstream>
#include <utility>

#include "base/read_file.h"
#include "robot/group.h"
#include "robot/urdf.h"

namespace indurop::robot {

namespace {

constexpr std::size_t kMostBytes = 4U << 20U;

std::optional<std::string> text_of(const std::string& path, const char* what, std::vector<std::string>& errors) {
  auto text = base::read_file(path, kMostBytes);
  if (text) {
    return std::move(*text);
  }
  using Kind = base::FileProblem::Kind;
  const base::FileProblem& problem = text.error();
  errors.push_back(path + ":1:1: error: this " + what +
                   (problem.kind == Kind::TooLarge ? " has more than 4 MiB"
                    : problem.kind == Kind::System
                        ? " cannot be read; names begin at the folder of the module.xml"
                        : " cannot be read: " + problem.text + "; names begin at the folder of the module.xml"));
  return std::nullopt;
}

void check_settings(const Settings& s, std::vector<std::string>& errors) {
  const auto positive = [&](const char* name, double value) {
    if (!(std::isfinite(value) && value > 0)) {
      errors.push_back(std::string("property ") + name + ": error: it has to be above 0");
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
  if (s.period <= std::chrono::nanoseconds::zero()) {
    errors.emplace_back("module: error: the robot task is periodic, give it a <period>");
  }
}

std::vector<JobFile> read_jobs(const Settings& settings, std::vector<std::string>& errors) {
  std::vector<JobFile> files;
  for (const std::string& path : settings.jobs) {
    if (const auto text = text_of(path, "job", errors)) {
      files.push_back({path, *text});
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
void check_points(const JobBook& book, const Arm& arm, std::vector<std::string>& errors) {
  for (const Point& point : book.points) {
    const int axis = point.target.is_pose ? -1 : arm.beyond_limits(point.target.joints);
    if (axis >= 0) {
      std::ostringstream text;
      text << point.place << ": error: point '" << point.name << "': joint " << axis + 1 << " is at "
           << degrees(point.target.joints[axis]) << " degrees, its limits are " << degrees(arm.axis(axis).lower)
           << " to " << degrees(arm.axis(axis).upper);
      errors.push_back(text.str());
    }
  }
}

}  // namespace

std::unique_ptr<Controller> Controller::load(const Settings& settings, std::vector<std::string>& errors) {
  const std::size_t before = errors.size();
  check_settings(settings, errors);
  std::optional<ArmModel> model;
  if (const auto text = text_of(settings.urdf, "robot description (property urdf)", errors)) {
    model = arm_from_urdf(settings.urdf, *text, errors);
  }
  JobBook book = parse_jobs(read_jobs(settings, errors), errors);
  if (model) {
    check_points(book, model->arm, errors);
  }
  if (errors.size() != before) {
    return nullptr;
  }
  return std::make_unique<Group>(parts_of(settings, std::move(*model), std::move(book)));
}

}  // namespace indurop::robot
