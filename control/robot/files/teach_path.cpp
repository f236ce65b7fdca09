// SPDX-License-Identifier: Apache-2.0
// Writes a job of a path along which the robot was guided.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <system_error>
#include <utility>

#include "control/robot/files/change_files.h"
#include "control/robot/files/read_files.h"
#include "control/robot/files/teach.h"
#include "control/robot/job/near_name.h"
#include "control/robot/job/point_lines.h"
#include "control/robot/kinematics/tool_set.h"
#include "control/robot/plan/path_fit.h"
#include "core/base/read_file.h"
#include "core/base/replace_file.h"

namespace indurop::robot {
namespace {

constexpr const char* kFirstWords = "# Guided by hand along ";
constexpr double kPart = 0.8;       // of the tolerance; the rest is for what drives deviate
constexpr double kSameWay = 5e-5;   // m; nearer places are one, as of a hand that rests
constexpr double kSameTurn = 1e-4;  // rad

// A thousandth of a degree or mm, as the job has it.
Joints rounded_joints(const Arm& arm, const std::vector<double>& users) {
  std::vector<double> rounded(users);
  for (double& value : rounded) {
    value = std::round(value * 1000) / 1000;
  }
  return joints_of_values(arm, rounded);
}

bool is_same(const FitPlace& a, const FitPlace& b) {
  return (a.tip.position - b.tip.position).norm() < kSameWay &&
         rotation_between(a.tip.orientation, b.tip.orientation).norm() < kSameTurn;
}

// The places without those where the hand rested. A mark that follows one of them stays with it.
std::vector<FitPlace> moving_places(const Arm& arm, const std::vector<GuidedPlace>& path) {
  std::vector<FitPlace> places;
  for (const GuidedPlace& one : path) {
    FitPlace place;
    place.q = rounded_joints(arm, one.joints);
    place.tip = arm.forward(place.q);
    place.marked = one.marked;
    if (places.empty() || !is_same(places.back(), place)) {
      places.push_back(place);
    } else if (one.marked) {
      places.back().marked = true;
    }
  }
  return places;
}

bool is_job_name(const std::string& name) {
  const auto usual = [](unsigned char c) { return std::isalnum(c) != 0 || c == '_'; };
  return !name.empty() && std::isalpha(static_cast<unsigned char>(name[0])) != 0 &&
         std::all_of(name.begin(), name.end(), usual);
}

const char* motion_word(FitKind kind) {
  return kind == FitKind::Line ? "MOVL " : kind == FitKind::Axes ? "MOVJ " : "MOVS ";
}

std::string job_text(const PathOrder& order, const Arm& arm, const std::vector<FitPlace>& places,
                     const FittedPath& fitted, TaughtPath& out) {
  std::string points;
  std::string motions;
  const auto point = [&](std::size_t place) {
    std::string name = order.job + '_' + std::to_string(++out.points);
    points += "POINT " + name + " = " + joint_text(arm, places[place].q) + '\n';
    return name;
  };
  motions += order.tool.empty() ? "" : "TOOL " + order.tool + '\n';
  motions += "SPEED " + decimal_text(order.speed) + " mm/s\nMOVJ " + point(0) + '\n';
  for (const FittedMotion& motion : fitted.motions) {
    motions += motion_word(motion.kind);
    for (std::size_t i = 0; i < motion.through.size(); ++i) {
      motions += (i == 0 ? "" : " ") + point(motion.through[i]);
    }
    motions += motion.kind == FitKind::Axes ? " STRAIGHT\n" : "\n";
  }
  return kFirstWords + decimal_text(out.length) + " mm; within " + decimal_text(out.deviation) + " mm and " +
         decimal_text(out.turn_deviation) + " deg of it.\n" + points + motions;
}

// The tool of that name; -1: there is none.
int tool_number(const JobBook& book, const std::string& name) {
  for (std::size_t i = 1; i < book.tools.size(); ++i) {
    if (book.tools[i].name == name) {
      return static_cast<int>(i);
    }
  }
  return name.empty() ? 0 : -1;
}

bool names_file(const FileNames& names, const std::string& file) {
  return std::any_of(names.jobs.begin(), names.jobs.end(), [&](const std::string& one) {
    std::error_code error;
    return one == file || std::filesystem::equivalent(one, file, error);
  });
}

// The names without the file, whose points the new job declares again.
FileNames without_file(FileNames names, const std::string& file) {
  std::erase_if(names.jobs, [&](const std::string& one) {
    std::error_code error;
    return one == file || std::filesystem::equivalent(one, file, error);
  });
  return names;
}

// Whether the file has a job that a person wrote, which is not to be lost.
bool was_not_guided(const std::string& file) {
  const auto text = base::read_file(file);
  return text.ok() && !text->empty() && !text->starts_with(kFirstWords);
}

void write_job(FileNames others, const Arm& arm, TaughtPath& out) {
  if (out.is_read && was_not_guided(out.file)) {
    out.problem = out.file + ": it was not written by guiding, and is kept; choose another name";
    return;
  }
  others.jobs.push_back(out.file);
  out.errors = problems_with(others, out.file, out.text, arm);
  if (!out.errors.empty()) {
    return;
  }
  const auto done = out.is_read ? base::replace_file(out.file, out.text, base::Durable::Yes)
                                : base::create_file(out.file, out.text, base::kUsualMode);
  if (!done) {
    out.problem = out.file + ": " + done.error().text +
                  (out.is_read ? "" : "; choose another name, or a file that the property jobs names");
  }
}

std::string wrong_order(const PathOrder& order, const JobBook& book, const Arm& arm,
                        const std::vector<GuidedPlace>& path) {
  const auto sane = [](double value) { return std::isfinite(value) && value > 0; };
  if (!is_job_name(order.job)) {
    return "'" + order.job + "' is no name of a job: a letter, then letters, digits and _";
  }
  if (!sane(order.tolerance) || !sane(order.turn_tolerance) || !sane(order.speed)) {
    return "tolerances and speed have to be above 0";
  }
  if (tool_number(book, order.tool) < 0) {
    return "there is no tool '" + order.tool + "' in the files of the robot" + meant(order.tool, names_of(book.tools));
  }
  for (const GuidedPlace& one : path) {
    if (one.joints.size() < static_cast<std::size_t>(arm.count()) ||
        !std::all_of(one.joints.begin(), one.joints.end(), [](double q) { return std::isfinite(q); })) {
      return "the path has places without " + std::to_string(arm.count()) + " joint values";
    }
  }
  return "";
}

}  // namespace

TaughtPath teach_path(const FileNames& names, const PathOrder& order, const std::vector<GuidedPlace>& path) {
  TaughtPath out;
  const std::string folder = names.jobs.empty() ? "" : std::filesystem::path(names.jobs.front()).parent_path().string();
  out.file = !order.file.empty() ? order.file : (std::filesystem::path(folder) / (order.job + ".job")).string();
  out.is_read = names_file(names, out.file);
  const FileNames others = without_file(names, out.file);
  ReadFiles read = read_files(names);
  out.errors = std::move(read.errors);
  if (!out.errors.empty() || !read.model) {
    return out;
  }
  out.problem = wrong_order(order, read.book, read.model->arm, path);
  if (!out.problem.empty()) {
    return out;
  }
  const ToolSet tools(read.model->arm, read.book.tips());
  const Arm& arm = tools.arm(tool_number(read.book, order.tool));
  const std::vector<FitPlace> places = moving_places(arm, path);
  if (places.size() < 2) {
    out.problem = "the arm was not moved: nothing was written";
    return out;
  }
  ToolLimits tool;
  tool.velocity = names.tool_speed > 0 ? names.tool_speed / 1000 : 1;
  tool.turn_velocity = radians(names.tool_turn_speed);
  const FittedPath fitted =
      fit_path(places, {kPart * order.tolerance / 1000, kPart * radians(order.turn_tolerance)}, arm, tool);
  for (std::size_t i = 1; i < places.size(); ++i) {
    out.length += 1000 * (places[i].tip.position - places[i - 1].tip.position).norm();
  }
  out.deviation = 1000 * fitted.off.way;
  out.turn_deviation = degrees(fitted.off.turn);
  out.text = job_text(order, arm, places, fitted, out);
  write_job(others, arm, out);
  return out;
}

}  // namespace indurop::robot
