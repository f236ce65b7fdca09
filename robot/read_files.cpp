// SPDX-License-Identifier: Apache-2.0
#include "robot/read_files.h"

#include <iterator>
#include <sstream>
#include <utility>

#include "base/read_file.h"

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

std::vector<JobFile> read_jobs(const FileNames& names, Diagnostics& errors) {
  std::vector<JobFile> files;
  for (const std::string& path : names.jobs) {
    if (auto text = text_of(path, "job")) {
      files.push_back({path, std::move(text).value()});
    } else {
      errors.push_back(std::move(text).error());
    }
  }
  return files;
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

std::string ways_of(const Solutions& found) {
  std::string ways;
  for (int i = 0; i < found.count; ++i) {
    const std::string one = std::to_string(found.list[static_cast<std::size_t>(i)].posture);
    ways += ways.find(one) != std::string::npos ? "" : (ways.empty() ? "" : ", ") + one;
  }
  return ways;
}

// How an arm without a closed form is held at poses takes a search, which is made here, before anything moves.
Diagnostics solve_points(JobBook& book, const Inverse& inverse) {
  Diagnostics errors;
  for (Point& point : book.points) {
    if (!point.target.is_pose || inverse.closed_form()) {
      continue;
    }
    const auto found = std::make_shared<const Solutions>(inverse.search(point.target.pose, Joints::Zero()));
    const std::string name = "point '" + point.name + "': ";
    if (found->count == 0) {
      errors.push_back(error(point.file, point.place,
                             name + "the arm cannot hold its tool like that there" +
                                 (found->reach == Reach::JointLimit ? " within the limits of its joints" : "") +
                                 "; give it a nearer position or another orientation"));
    } else if (point.target.posture && !inverse.has_postures()) {
      errors.push_back(
          error(point.file, point.place, name + "this arm has no postures; leave POSTURE out, or use JOINT"));
    } else if (point.target.posture && found->nearest(Joints::Zero(), point.target.posture) == nullptr) {
      errors.push_back(error(
          point.file, point.place,
          name + "not possible in posture " + std::to_string(*point.target.posture) + ", but in " + ways_of(*found)));
    }
    book.known.push_back(found);
    point.target.known = found.get();
  }
  return errors;
}

}  // namespace

ReadFiles read_files(const FileNames& names) {
  ReadFiles read;
  if (auto text = text_of(names.urdf, "robot description (property urdf)"); !text) {
    read.errors.push_back(std::move(text).error());
  } else if (auto arm = arm_from_urdf(names.urdf, *text)) {
    read.model = std::move(arm).value();
  } else {
    take_over(std::move(arm).error(), read.errors);
  }
  ReadJobs jobs = parse_jobs(read_jobs(names, read.errors));
  take_over(std::move(jobs.diagnostics), read.errors);
  read.book = std::move(jobs.book);
  if (read.model) {
    const Inverse inverse(read.model->arm);
    take_over(check_points(read.book, read.model->arm), read.errors);
    take_over(solve_points(read.book, inverse), read.errors);
    read.kind = inverse.kind();
  }
  return read;
}

Diagnostics check_files(const FileNames& names) {
  ReadFiles read = read_files(names);
  if (!read.kind.empty()) {
    read.errors.push_back({base::Diagnostic::Severity::Note, names.urdf, {1, 1}, "the arm: " + read.kind});
  }
  return std::move(read.errors);
}

}  // namespace indurop::robot
