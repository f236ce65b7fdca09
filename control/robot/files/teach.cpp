// SPDX-License-Identifier: Apache-2.0
#include "control/robot/files/teach.h"

#include <algorithm>
#include <filesystem>
#include <system_error>
#include <utility>

#include "control/robot/files/read_files.h"
#include "control/robot/job/near_name.h"
#include "control/robot/job/point_lines.h"
#include "control/robot/kinematics/inverse.h"
#include "core/base/read_file.h"
#include "core/base/replace_file.h"

namespace indurop::robot {
namespace {

constexpr std::size_t kMostBytes = 4U << 20U;

template <class T>
const T* named(const std::vector<T>& all, const std::string& name) {
  const auto found = std::find_if(all.begin(), all.end(), [&](const T& one) { return one.name == name; });
  return found == all.end() ? nullptr : &*found;
}

Joints joints_of_stand(const Arm& arm, const Stand& stand) {
  Joints out = Joints::Zero();
  for (int i = 0; i < arm.count(); ++i) {
    const double value = stand.joints[static_cast<std::size_t>(i)];
    out[i] = arm.axis(i).slides() ? value / 1000 : radians(value);
  }
  return out;
}

Pose tip_of(const Stand& stand) {
  const auto& [x, y, z] = stand.position;
  const auto& [roll, pitch, yaw] = stand.orientation;
  return {Vec3(x, y, z) / 1000, from_rpy({radians(roll), radians(pitch), radians(yaw)})};
}

// The file for a new point; empty: the robot does not read the file that was named.
std::string file_for(const TeachOrder& order, const JobBook& book, const std::vector<std::string>& files) {
  if (!order.file.empty()) {
    const auto same = std::find_if(files.begin(), files.end(), [&](const std::string& one) {
      std::error_code error;
      return std::filesystem::equivalent(one, order.file, error);
    });
    return same == files.end() ? std::string() : *same;
  }
  const auto points_in = [&](const std::string& file) {
    return std::count_if(book.points.begin(), book.points.end(), [&](const Point& one) { return one.file == file; });
  };
  const auto most = std::max_element(files.begin(), files.end(), [&](const std::string& a, const std::string& b) {
    return points_in(a) < points_in(b);
  });
  return most == files.end() ? std::string() : *most;
}

// Returns "POSE ... IN pallet"; empty if there is no frame of that name.
std::string place_for(const TeachOrder& order, const JobBook& book, const Arm& arm, const Stand& stand,
                      const Point* before) {
  const bool was_pose = before != nullptr && before->target.is_pose;
  if (!order.as_pose && order.frame.empty() && (order.as_joint || !was_pose)) {
    return joint_text(arm, joints_of_stand(arm, stand));
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
  target.joints = joints_of_stand(arm, stand);
  target.held = workpiece_axes(arm) | (was_pose ? before->target.held : 0U);
  if (was_pose && before->target.posture) {
    target.posture = Inverse(arm).posture_at(target.joints);
  }
  return pose_text(arm, target, frame);
}

ArmShape shape_of(const Arm& arm) {
  ArmShape shape{arm.count(), {}};
  for (int i = 0; i < arm.count(); ++i) {
    shape.slides[static_cast<std::size_t>(i)] = arm.axis(i).slides();
  }
  return shape;
}

// The errors that the files would have if one of them had this text.
std::vector<base::Diagnostic> problems_with(const FileNames& names, const std::string& file, const std::string& text,
                                            const Arm& arm) {
  std::vector<JobFile> all;
  for (const std::string& path : names.jobs) {
    const auto read = base::read_file(path, kMostBytes);
    all.push_back({path, path == file ? text : read ? *read : std::string()});
  }
  return parse_jobs(all, shape_of(arm)).diagnostics;
}

void write(const FileNames& names, const Arm& arm, int line, TaughtPoint& point) {
  const auto text = base::read_file(point.now.file, kMostBytes);
  if (!text) {
    point.problem = point.now.file + ": " + text.error().text;
    return;
  }
  const WithPoint changed = put_point(*text, line, point.now.name, point.now.place);
  point.now.line = changed.line;
  point.errors = problems_with(names, point.now.file, changed.text, arm);
  if (!point.errors.empty()) {
    return;
  }
  if (const auto done = base::replace_file(point.now.file, changed.text, base::Durable::Yes); !done) {
    point.problem = point.now.file + ": " + done.error().text;
  }
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
  if (stand.joints.size() < static_cast<std::size_t>(arm.count())) {
    out.problem = "the arm of the files has " + std::to_string(arm.count()) + " axes, the robot " +
                  std::to_string(stand.joints.size());
    return out;
  }
  const Point* const before = named(read.book.points, order.point);
  out.now = {order.point, place_for(order, read.book, arm, stand, before),
             before != nullptr ? before->file : file_for(order, read.book, names.jobs), 0};
  if (out.now.place.empty()) {
    out.problem = "there is no frame '" + order.frame + "' in the files of the robot" +
                  meant(order.frame, names_of(read.book.frames));
  } else if (out.now.file.empty()) {
    out.problem = order.file.empty() ? "the robot reads no files of jobs or points: name one in the property jobs"
                                     : "the robot does not read " + order.file + ": name it in the property jobs";
  } else {
    out.before = before == nullptr ? std::string() : place_text(read.book, *before, arm);
    write(names, arm, before == nullptr ? 0 : before->place.line, out);
  }
  return out;
}

}  // namespace indurop::robot
