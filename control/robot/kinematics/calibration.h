// SPDX-License-Identifier: Apache-2.0
// Calibrates tools, work frames and cameras from what the arm touched and what a camera saw: least squares with what
// remains of each point, how well the result is determined, and why points cannot show it. Knows nothing of jobs. Not
// real-time safe; may be used by any thread.

#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "control/robot/kinematics/geometry.h"

namespace indurop::robot {

// What a point says.
enum class Mark {
  Tip,      // tool: the tip touches the fixed place
  AlongX,   // tool: the fixed place lies on the x axis of the tool, on its positive side
  PlaneXZ,  // tool: it lies in the plane of x and z, on the side of +z
  Origin,   // frame: the origin is touched
  OnX,      // frame: a place on its x axis, the first one on the positive side
  PlaneXY,  // frame: a place in the plane of x and y, the first one on the side of +y
  Seen,     // camera: what was touched, and where the camera saw it
};

struct Measured {
  Mark mark = Mark::Tip;
  Pose at;    // of the arm's end for tools and for cameras on it, else of what touched; only its position counts then
  Pose seen;  // of a camera: in its frame; only its position counts if the camera stands in the cell
};

using Covariance = Eigen::Matrix<double, 6, 6>;

struct Calibrated {
  // Tool: tip in the frame of the arm's end. Frame, camera: in the base. Camera on the arm: in the frame of its end.
  Pose result;
  bool turned = true;       // false: the points say nothing of the orientation (a tool of Tip points only)
  std::vector<double> off;  // m, what remains of each point
  double rms = 0;           // m, root mean square of these
  double most = 0;          // m, the largest of these
  std::size_t worst = 0;    // its index
  int spare = 0;            // equations beyond those that are needed; 0: nothing remains, whatever the errors
  double sigma = 0;         // m, standard deviation of one coordinate of a point, estimated from what remains
  Covariance cofactor = Covariance::Zero();  // covariance of position (m) and rotation vector (rad, in axes of the
                                             // result) if sigma is 1; times sigma^2 it is the estimated one
  double scale = 1;   // camera in the cell: distances touched by distances seen; 1 if both measure in mm
  std::string wrong;  // why the points give no result; empty if they do

  // Standard deviations, estimated; 0 if `spare` is.
  [[nodiscard]] Vec3 place_deviation() const;  // m, along the axes of the frame in which the result is given
  [[nodiscard]] Vec3 turn_deviation() const;   // rad, about the axes of the result
};

// An angle of 1 rad counts as this distance (m) where what a camera on the arm saw is compared: 1 mrad as 0.1 mm.
inline constexpr double kTurnArm = 0.1;

// 4 Tip points or more, and, for the orientation, both of AlongX and PlaneXZ or neither.
Calibrated calibrate_tool(std::span<const Measured> points);
// 1 Origin, 1 OnX, 1 PlaneXY or more of each.
Calibrated calibrate_frame(std::span<const Measured> points);
// 4 Seen points or more (Kabsch 1976, Umeyama 1991).
Calibrated calibrate_camera(std::span<const Measured> points);
// The camera is on the arm and saw one fixed thing from 4 positions or more: AX = XB (Park and Martin 1994, then all
// unknowns at once).
Calibrated calibrate_hand_camera(std::span<const Measured> points);

}  // namespace indurop::robot
