// SPDX-License-Identifier: Apache-2.0
#include "control/robot/files/read_files.h"

#include <indurop/detail/abi.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <sstream>
#include <utility>

#include "control/robot/files/check_calls.h"
#include "control/robot/files/check_pushes.h"
#include "control/robot/files/check_slow_axes.h"
#include "control/robot/files/check_splines.h"
#include "control/robot/files/check_workpiece.h"
#include "control/robot/files/read_bodies.h"
#include "control/robot/files/solve_points.h"
#include "control/robot/kinematics/abilities.h"
#include "control/robot/kinematics/workspace.h"
#include "core/base/read_file.h"

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

std::uint64_t mark_of(const std::string& urdf, const std::vector<JobFile>& jobs) {
  std::uint64_t mark = abi::fnv1a64(urdf.data(), urdf.size());
  for (const JobFile& job : jobs) {
    mark = mark * 31 + abi::fnv1a64(job.text.data(), job.text.size());
  }
  return mark;
}

Diagnostics check_workspace(const FileNames& names, const JobBook& book, const Arm& arm, bool placed) {
  const std::vector<double>& corners = names.workspace;
  bool sane = corners.empty() || corners.size() == 6;
  for (std::size_t i = 0; sane && i < corners.size(); ++i) {
    sane = std::isfinite(corners[i]) && corners[i] != corners[(i + 3) % 6];
  }
  if (!sane) {
    return {error("property workspace", {}, "it has to be two opposite corners of a box, x y z x y z in mm")};
  }
  Diagnostics errors;
  const Workspace box = Workspace::of(corners);
  for (const Point& point : book.points) {
    const Target& target = point.target;
    if (!is_known(point, book, placed) || (!target.is_pose && book.tools.size() > 1)) {
      continue;  // the tip position depends on the tool
    }
    const Vec3 place = target.is_pose ? target.pose.position : arm.forward(target.joints).position;
    if (box.outside(place) > 0) {
      std::ostringstream text;
      text << "point '" << point.name << "': the tool is at " << (1000 * place).transpose()
           << " mm, outside of the workspace (" << box.text() << ")";
      errors.push_back(error(point.file, point.place, text.str()));
      const bool may_move = book.is_computed(point);
      errors.back().severity = may_move ? base::Diagnostic::Severity::Warning : base::Diagnostic::Severity::Error;
    }
  }
  return errors;
}

// Robots that share their space need bodies, and jobs that begin motions together need such robots.
Diagnostics check_space(const FileNames& names, const JobBook& book, const Arm& arm, const Clearance& clearance) {
  Diagnostics errors;
  if (names.shares.value_or(false) &&
      std::none_of(clearance.parts().begin(), clearance.parts().end(),
                   [&arm](const Clearance::Part& part) { return part.joint > arm.world_joint() && part.tool == 0; })) {
    errors.push_back(error(names.urdf, {1, 1}, "robots that share their space need bodies; give links <collision>"));
  }
  for (const NamedVariable& sync : book.syncs) {
    if (!names.shares.value_or(true)) {
      errors.push_back(error(sync.file, sync.place,
                             "SYNC begins a motion together with those of other robots; name these in the property "
                             "other_robots"));
    }
  }
  return errors;
}

// Speeds above the limit are no danger: lines then run at full speed.
Diagnostics check_speeds(const JobBook& book, double most) {
  Diagnostics warnings;
  for (const Job& job : book.jobs) {
    const auto check = [&](const Step& step) {
      if (const double asked = 1000 * step.value;
          step.op == Op::Speed && step.formula < 0 && step.index == 1 && most > 0 && asked > most) {
        std::ostringstream text;
        text << "SPEED " << asked << " mm/s is beyond full speed, " << most
             << " mm/s (property tool_speed): lines run at that";
        warnings.push_back(error(job.file, {static_cast<int>(step.line), static_cast<int>(step.column)}, text.str()));
        warnings.back().severity = base::Diagnostic::Severity::Warning;
      }
    };
    for (const Step& step : job.steps) {
      check(step);
      if (const MotionExtras* const extras = step.op == Op::Move ? book.extras_of(step) : nullptr; extras != nullptr) {
        std::for_each(extras->settings.begin(), extras->settings.end(), check);
      }
    }
  }
  return warnings;
}

// Loads affect torques only.
Diagnostics check_loads(const JobBook& book, const Dynamics& dynamics) {
  Diagnostics warnings;
  const auto warn = [&](const std::string& file, base::SourcePlace place, const std::string& what) {
    warnings.push_back(error(file, place, what + " counts for nothing: the URDF does not say what the arm weighs"));
    warnings.back().severity = base::Diagnostic::Severity::Warning;
  };
  if (dynamics.known()) {
    return warnings;
  }
  for (const Tool& tool : book.tools) {
    if (tool.body.mass > 0) {
      warn(tool.file, tool.place, "MASS");
    }
  }
  for (const Job& job : book.jobs) {
    for (const Step& step : job.steps) {
      const bool loads = step.op == Op::Load;
      if (loads && step.index > 0) {
        warn(job.file, {static_cast<int>(step.line), 1}, "LOAD");
      }
    }
  }
  return warnings;
}

void sort_out(Diagnostics said, ReadFiles& read) {
  for (base::Diagnostic& one : said) {
    (one.severity == base::Diagnostic::Severity::Error ? read.errors : read.notes).push_back(std::move(one));
  }
}

}  // namespace

ArmShape shape_of(const Arm& arm) {
  ArmShape shape{arm.count(), {}};
  for (int i = 0; i < arm.count(); ++i) {
    shape.slides[static_cast<std::size_t>(i)] = arm.axis(i).slides();
  }
  return shape;
}

namespace {

// Returns how far a drive counts in either direction, in rad: beyond that, its set points would stand still.
double counted(const FileNames& names, std::size_t drive) {
  constexpr double kMostCounts = std::numeric_limits<std::int32_t>::max();
  const auto own = [drive](const std::vector<double>& values, double otherwise) {
    const std::size_t k = values.size() > 1 ? drive : 0;
    return k < values.size() ? values[k] : otherwise;
  };
  const double counts = std::abs(own(names.counts_per_turn, 0)) * std::max(1.0, std::abs(own(names.gear, 1)));
  return counts > 0 ? std::max(0.0, 2 * kPi * kMostCounts / counts - std::abs(radians(own(names.zero, 0)))) : HUGE_VAL;
}

// An endless axis ends where its drive cannot count any further.
void bound_endless(const FileNames& names, ArmModel& model) {
  for (int i = 0; i < model.arm.count(); ++i) {
    model.arm.end_at(i, counted(names, at(i)));
  }
  for (std::size_t i = 0; i < model.singles.size(); ++i) {
    model.singles[i].farthest = counted(names, at(model.arm.count()) + i);
  }
}

}  // namespace

ReadFiles read_files(const FileNames& names) {
  ReadFiles read;
  if (auto text = text_of(names.urdf, "robot description (property urdf)"); !text) {
    read.errors.push_back(std::move(text).error());
  } else if (auto arm = arm_from_urdf(names.urdf, *text)) {
    read.model = std::move(arm).value();
    bound_endless(names, *read.model);
    read.notes = read.model->notes;
    read.urdf = std::move(*text);
  } else {
    take_over(std::move(arm).error(), read.errors);
  }
  const std::vector<JobFile> texts = read_jobs(names, read.errors);
  read.mark = mark_of(read.urdf, texts);
  ReadJobs jobs = parse_jobs(texts, read.model ? shape_of(read.model->arm) : ArmShape{});
  take_over(std::move(jobs.diagnostics), read.errors);
  read.book = std::move(jobs.book);
  if (read.model) {
    const Inverse inverse(read.model->arm);
    if (read.errors.empty()) {
      sort_out(place_tools(read.book, read.model->arm), read);
      sort_out(place_frames(read.book, read.model->arm), read);
    }
    const bool placed = read.errors.empty();
    take_over(check_points(read.book, read.model->arm), read.errors);
    sort_out(solve_points(read.book, read.model->arm, placed), read);
    take_over(check_axes_of_motions(read.book, read.model->arm), read.errors);
    take_over(check_workpiece(read.book, read.model->arm, names.workspace), read.errors);
    sort_out(check_calls(read.book), read);
    take_over(check_pushes(read.book, *read.model, names.rated_torque), read.errors);
    sort_out(check_loads(read.book, read.model->dynamics), read);
    sort_out(check_speeds(read.book, names.tool_speed), read);
    sort_out(check_slow_axes(read.book, *read.model, names.tool_speed), read);
    if (read.errors.empty()) {
      ReadBodies bodies = read_bodies(*read.model, read.book, names.urdf, names.ignored, names.clearance);
      read.clearance = std::move(bodies.clearance);
      sort_out(std::move(bodies.found), read);
      sort_out(check_clear(read.book, read.model->arm, read.clearance), read);
      sort_out(check_space(names, read.book, read.model->arm, read.clearance), read);
    }
    sort_out(check_workspace(names, read.book, read.model->arm, placed), read);
    if (read.book.tools.size() == 1) {
      take_over(check_splines(read.book, inverse), read.errors);
    }
    read.kind = abilities(read.model->arm, inverse);
    for (std::size_t i = 0; i < read.model->singles.size(); ++i) {
      const std::string number = std::to_string(static_cast<std::size_t>(read.model->arm.count()) + i + 1);
      read.kind += "; axis " + number + " (" + read.model->singles[i].name + ") belongs to no group";
    }
  }
  return read;
}

FileNames names_of(const Settings& settings) {
  return {settings.urdf,
          settings.jobs,
          settings.workspace,
          settings.tool_speed,
          settings.clearance,
          settings.ignore_collisions,
          {},
          !settings.other_robots.empty(),
          settings.tool_turn_speed,
          settings.counts_per_turn,
          settings.gear,
          settings.zero,
          settings.rated_torque};
}

Findings check_module(FileNames names, const PropertyText& property) {
  Settings settings;
  Findings found;
  const auto add = [&](std::vector<WrongSetting>&& wrong) {
    std::move(wrong.begin(), wrong.end(), std::back_inserter(found.properties));
  };
  add(take_properties(property, settings));
  add(check_settings(settings));
  settings.urdf = names.urdf;
  settings.jobs = std::move(names.jobs);
  names = names_of(settings);
  ReadFiles read = read_files(names);
  if (read.model) {
    add(check_axes(settings, read.model->arm, read.model->dynamics.known(), read.model->singles.size()));
    take_over(check_room(read.model->arm, read.clearance, names.urdf), read.errors);
  }
  take_over(std::move(read.notes), read.errors);
  if (!read.kind.empty()) {
    read.errors.push_back({base::Diagnostic::Severity::Note, names.urdf, {1, 1}, "the arm: " + read.kind});
  }
  found.files = std::move(read.errors);
  found.variables = std::move(read.book.named);
  return found;
}

}  // namespace indurop::robot
