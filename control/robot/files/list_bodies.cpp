// SPDX-License-Identifier: Apache-2.0
#include "control/robot/files/list_bodies.h"

#include <filesystem>

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

ListedBody listed(const BodyLine& line, const Pose& frame) {
  const Pose middle = frame * line.solid.place;
  const Vec3 rpy = to_rpy(middle.orientation);
  ListedBody body{line.name, kind_text(line.solid.kind), {}, {}, {}, 0};
  for (std::size_t i = 0; i < 3; ++i) {
    const int k = static_cast<int>(i);
    body.size[i] = 2000 * line.solid.half[k];
    body.position[i] = 1000 * middle.position[k];
    body.orientation[i] = degrees(rpy[k]);
  }
  return body;
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
