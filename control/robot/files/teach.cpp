// SPDX-License-Identifier: Apache-2.0
#include "control/robot/files/teach.h"

#include <algorithm>
#include <string_view>
#include <utility>

#include "control/robot/files/change_files.h"
#include "control/robot/files/read_files.h"
#include "control/robot/job/near_name.h"
#include "control/robot/job/point_lines.h"
#include "control/robot/kinematics/inverse.h"

namespace indurop::robot {
namespace {

Pose tip_of(const Stand& stand) {
  const auto& [x, y, z] = stand.position;
  const auto& [roll, pitch, yaw] = stand.orientation;
  return {Vec3(x, y, z) / 1000, from_rpy({radians(roll), radians(pitch), radians(yaw)})};
}

// Returns "POSE ... IN pallet"; empty if there is no frame of that name.
std::string place_for(const TeachOrder& order, const JobBook& book, const Arm& arm, const Stand& stand,
                      const Point* before) {
  const bool was_pose = before != nullptr && before->target.is_pose;
  if (!order.as_pose && order.frame.empty() && (order.as_joint || !was_pose)) {
    return joint_text(arm, joints_of_values(arm, stand.joints));
  }
  const bool in_its_frame = order.frame.empty() && was_pose && before->frame >= 0;
  const WorkFrame* const frame =
      in_its_frame ? &book.frames[static_cast<std::size_t>(before->frame)] : named(book.frames, order.frame);
  if (frame == nullptr && !order.frame.empty()) {
    return "";
  }
  // What the point says of posture and axes it says again; of those that move the workpiece, in any case.
  Target target;
  target.pose = tip_of(stand);
  target.joints = joints_of_values(arm, stand.joints);
  target.held = workpiece_axes(arm) | (was_pose ? before->target.held : 0U);
  if (was_pose && before->target.posture) {
    target.posture = Inverse(arm).posture_at(target.joints);
  }
  return pose_text(arm, target, frame);
}

}  // namespace

ListedPoints list_points(const FileNames& names) {
  ReadFiles read = read_files(names);
  ListedPoints out{{}, {}, std::move(read.errors)};
  for (const WorkFrame& one : read.book.frames) {
    out.frames.push_back(one.name);
  }
  for (const Point& one : read.book.points) {
    if (out.errors.empty() && read.model) {
      out.points.push_back({one.name, place_text(read.book, one, read.model->arm), one.file, one.place.line});
    }
  }
  return out;
}

TaughtPoint teach_point(const FileNames& names, const TeachOrder& order, const Stand& stand) {
  ReadFiles read = read_files(names);
  TaughtPoint out;
  out.errors = std::move(read.errors);
  if (!out.errors.empty() || !read.model) {
    return out;
  }
  const Arm& arm = read.model->arm;
  if (out.problem = wrong_axes(arm, stand); !out.problem.empty()) {
    return out;
  }
  const Point* const before = named(read.book.points, order.point);
  out.now = {order.point, place_for(order, read.book, arm, stand, before),
             before != nullptr ? before->file : file_for(order.file, read.book, names.jobs), 0};
  if (out.now.place.empty()) {
    out.problem = "there is no frame '" + order.frame + "' in the files of the robot" +
                  meant(order.frame, names_of(read.book.frames));
  } else if (out.now.file.empty()) {
    out.problem = no_file(order.file);
  } else {
    out.before = before == nullptr ? std::string() : place_text(read.book, *before, arm);
    const int line = before == nullptr ? 0 : before->place.line;
    FileChange change = change_file(names, arm, out.now.file, [&](std::string_view text) {
      WithPoint changed = put_point(text, line, out.now.name, out.now.place);
      out.now.line = changed.line;
      return std::move(changed.text);
    });
    out.errors = std::move(change.errors);
    out.problem = std::move(change.problem);
  }
  return out;
}

}  // namespace indurop::robot
