// SPDX-License-Identifier: Apache-2.0
#include "control/robot/files/list_bodies.h"

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <utility>

#include "control/robot/files/read_files.h"

namespace indurop::robot {

namespace {

const char* kind_text(SolidKind kind) {
  switch (kind) {
    case SolidKind::Box:
      return "box";
    case SolidKind::Cylinder:
      return "cylinder";
    case SolidKind::Ball:
      return "ball";
  }
  return "";
}

std::array<double, 3> in_mm(const Vec3& place) {
  return {1000 * place[0], 1000 * place[1], 1000 * place[2]};
}

std::array<double, 3> in_degrees(const Quat& orientation) {
  const Vec3 rpy = to_rpy(orientation);
  return {degrees(rpy[0]), degrees(rpy[1]), degrees(rpy[2])};
}

ListedBody listed(const BodyLine& line, const Pose& frame) {
  const Pose middle = frame * line.solid.place;
  ListedBody body{line.name, kind_text(line.solid.kind), {}, {}, {}, 0};
  for (std::size_t i = 0; i < 3; ++i) {
    body.size[i] = 2000 * line.solid.half[static_cast<int>(i)];
  }
  body.position = in_mm(middle.position);
  body.orientation = in_degrees(middle.orientation);
  return body;
}

// Without the points in it.
ListedFrame listed(const WorkFrame& frame) {
  return {frame.name, in_mm(frame.pose.position), in_degrees(frame.pose.orientation), frame.computed >= 0, {}};
}

std::vector<ListedFrame> frames_with_points(const JobBook& book) {
  std::vector<ListedFrame> out;
  for (const WorkFrame& one : book.frames) {
    out.push_back(listed(one));
  }
  for (const Point& point : book.points) {
    if (point.frame >= 0 && point.computed < 0) {
      const auto frame = static_cast<std::size_t>(point.frame);
      out[frame].points.push_back({point.name, in_mm((book.frames[frame].pose * point.in_frame).position)});
    }
  }
  return out;
}

// How far the points by which a belt was taught are apart, in mm; 0: it was not taught by points on it.
double taught_length(const JobBook& book, const WorkFrame& along, const Arm& arm) {
  if (!along.is_taught || along.points[0] < 0 || along.points[1] < 0) {
    return 0;
  }
  const auto place = [&](int point) {
    const Target& target = book.points[static_cast<std::size_t>(point)].target;
    return target.is_pose ? target.pose.position : arm.forward(target.joints).position;
  };
  return 1000 * (place(along.points[1]) - place(along.points[0])).norm();
}

// Each of them once.
std::vector<ListedBelt> belts_of(const JobBook& book, const Arm& arm) {
  std::vector<ListedBelt> out;
  for (const Job& job : book.jobs) {
    for (const Step& step : job.steps) {
      if (step.op != Op::Track || step.index < 0) {
        continue;
      }
      const WorkFrame& along = book.frames[static_cast<std::size_t>(step.mid)];
      const int part = book.computed[static_cast<std::size_t>(step.index)].index;
      ListedBelt belt{static_cast<int>(step.value), step.slot == 1, along.name,
                      book.frames[static_cast<std::size_t>(part)].name, 0};
      const bool known = std::any_of(out.begin(), out.end(), [&](const ListedBelt& one) {
        return one.number == belt.number && one.along == belt.along && one.part == belt.part;
      });
      if (!known) {
        belt.length = belt.turns ? 0 : taught_length(book, along, arm);
        out.push_back(std::move(belt));
      }
    }
  }
  return out;
}

}  // namespace

ListedBodies list_bodies(const FileNames& names) {
  const ReadFiles read = read_files(names);
  ListedBodies out;
  for (const WorkFrame& one : read.book.frames) {
    out.frames.push_back(one.name);
  }
  if (!read.errors.empty()) {
    base::Diagnostic first = read.errors.front();
    first.file = std::filesystem::path(first.file).filename().string();
    out.problem = base::to_string(first);
    return out;
  }
  out.work_frames = frames_with_points(read.book);
  if (read.model) {
    out.belts = belts_of(read.book, read.model->arm);
  }
  for (const BodyLine& line : read.book.keepouts) {
    out.zones.push_back(
        listed(line, line.frame < 0 ? Pose{} : read.book.frames[static_cast<std::size_t>(line.frame)].pose));
  }
  for (const BodyLine& line : read.book.bodies) {
    out.tools.push_back(listed(line, Pose{}));
    out.tools.back().tool = line.tool;
  }
  return out;
}

}  // namespace indurop::robot
