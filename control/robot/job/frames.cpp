// SPDX-License-Identifier: Apache-2.0
// Computes the tips of tools, and the poses of points that are given in work frames.
#include <array>
#include <iomanip>
#include <sstream>
#include <string>
#include <utility>

#include "control/robot/job/job.h"
#include "control/robot/kinematics/arm.h"
#include "control/robot/kinematics/frame_fit.h"
#include "control/robot/kinematics/tip_fit.h"

namespace indurop::robot {

namespace {

// m between points that teach a frame, and from the third to the line of the others
constexpr double kLeastDistance = 0.001;

Vec3 place_of(const Target& target, const Arm& arm) {
  return target.is_pose ? target.pose.position : arm.forward(target.joints).position;
}

// Computes a frame: x from the first point to the second, the third on the side of y. Returns an empty text, or why it
// is impossible.
std::string taught(const std::array<Vec3, 3>& at, Pose& frame) {
  const Vec3 x = at[1] - at[0];
  const Vec3 side = at[2] - at[0];
  if (x.norm() < kLeastDistance || side.norm() < kLeastDistance) {
    return "two of its points are the same place; teach the origin, a point on x, and one on the side of y";
  }
  const Vec3 z = x.cross(side);
  if (z.norm() / x.norm() < kLeastDistance) {
    return "its three points lie on one line; the third one says where y is, so teach it away from that line";
  }
  Mat3 axes;
  axes.col(0) = x.normalized();
  axes.col(2) = z.normalized();
  axes.col(1) = axes.col(2).cross(axes.col(0));
  frame = {at[0], Quat(axes)};
  return {};
}

std::string shown_tip(const Vec3& tip) {
  std::ostringstream text;
  text << std::fixed << std::setprecision(2) << 1000 * tip.x() << " " << 1000 * tip.y() << " " << 1000 * tip.z();
  return text.str();
}

}  // namespace

std::vector<base::Diagnostic> place_tools(JobBook& book, const Arm& arm) {
  std::vector<base::Diagnostic> found;
  for (Tool& tool : book.tools) {
    if (!tool.is_taught) {
      continue;
    }
    std::vector<Pose> ends;
    for (const int point : tool.points) {
      ends.push_back(arm.forward(book.points[static_cast<std::size_t>(point)].target.joints));
    }
    const TipFit fit = fit_tip(ends);
    if (!fit.wrong.empty()) {
      const std::string& worst = book.points[static_cast<std::size_t>(tool.points[fit.worst])].name;
      found.push_back({base::Diagnostic::Severity::Error, tool.file, tool.place,
                       "tool '" + tool.name + "': " + fit.wrong + (fit.most_error > 0 ? " ('" + worst + "')" : "")});
      continue;
    }
    tool.tip.position = fit.tip;
    std::ostringstream text;
    text << std::fixed << std::setprecision(2) << "tool '" << tool.name << "': its tip is at " << shown_tip(fit.tip)
         << " mm; its points agree within " << 1000 * fit.most_error << " mm, " << 1000 * fit.mean_error
         << " mm on average";
    found.push_back({base::Diagnostic::Severity::Note, tool.file, tool.place, text.str()});
  }
  return found;
}

namespace {

// Finds the frame from its matched points; a note states how well they agree.
base::Diagnostic match(WorkFrame& frame, const JobBook& book, const Arm& touching) {
  std::vector<MatchedPlace> places;
  for (std::size_t i = 0; i < frame.matched.size(); ++i) {
    const Target& target = book.points[static_cast<std::size_t>(frame.matched[i])].target;
    places.push_back({frame.in_frame[i], place_of(target, touching)});
  }
  const FrameFit fit = fit_frame(places);
  std::ostringstream text;
  text << std::fixed << std::setprecision(2) << "frame '" << frame.name << "': ";
  if (!fit.wrong.empty()) {
    const std::string& worst = book.points[static_cast<std::size_t>(frame.matched[fit.worst])].name;
    text << fit.wrong << (fit.most_error > 0 ? " ('" + worst + "')" : "");
    return {base::Diagnostic::Severity::Error, frame.file, frame.place, text.str()};
  }
  frame.pose = fit.frame;
  // Without a sign of 0.
  const Vec3 rpy = (to_rpy(fit.frame.orientation) * (100 * 180 / kPi)).array().round() / 100 + 0.0;
  text << "POSE " << shown_tip(fit.frame.position) << " RPY " << rpy[0] << " " << rpy[1] << " " << rpy[2]
       << "; its points agree within " << 1000 * fit.most_error << " mm, " << 1000 * fit.mean_error << " mm on average";
  return {base::Diagnostic::Severity::Note, frame.file, frame.place, text.str()};
}

}  // namespace

std::vector<base::Diagnostic> place_frames(JobBook& book, const Arm& arm) {
  std::vector<base::Diagnostic> found;
  for (WorkFrame& frame : book.frames) {
    if (!frame.is_taught) {
      continue;
    }
    const Arm touching = arm.with_tool(book.tools[static_cast<std::size_t>(frame.tool)].tip);
    if (!frame.in_frame.empty()) {
      found.push_back(match(frame, book, touching));
      continue;
    }
    std::array<Vec3, 3> at;
    for (std::size_t i = 0; i < at.size(); ++i) {
      at[i] = place_of(book.points[static_cast<std::size_t>(frame.points[i])].target, touching);
    }
    if (std::string why = taught(at, frame.pose); !why.empty()) {
      found.push_back({base::Diagnostic::Severity::Error, frame.file, frame.place,
                       "frame '" + frame.name + "': " + std::move(why)});
    }
  }
  for (Point& point : book.points) {
    if (point.frame < 0) {
      continue;
    }
    const Pose& frame = book.frames[static_cast<std::size_t>(point.frame)].pose;
    point.in_frame = point.target.pose;
    point.target.pose = frame * point.in_frame;
    point.axes = frame.orientation;
  }
  return found;
}

}  // namespace indurop::robot
