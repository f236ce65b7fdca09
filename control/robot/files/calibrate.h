// SPDX-License-Identifier: Apache-2.0
// Calibrates tools, frames and cameras of a robot: collects points in a file next to its files, shows what follows from
// them, and declares the result in its files. Not real-time safe. Each change replaces one file as a whole, so several
// programs may work on it in turn.

#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "control/robot/files/files.h"
#include "control/robot/files/stand.h"

namespace indurop::robot {

enum class CalibrationKind { Tool, Frame, Camera, HandCamera };
// "tool", "frame", "camera", "hand-camera"
std::optional<CalibrationKind> calibration_kind(std::string_view word);
std::string_view word_of(CalibrationKind kind);

struct CalibrationOrder {
  CalibrationKind kind = CalibrationKind::Tool;
  std::string name;    // of the tool or frame; a camera on the arm is a tool
  std::string points;  // file with the points; empty: NAME.KIND.points in the folder of the first job file
  std::string file;    // for a new declaration; empty: the file with most of the points
};

struct CalibrationPoint {
  std::string mark;           // "TIP"
  std::string place;          // "JOINT 0 -10 -20 0 90 0 TOOL tip", as in the file
  std::string seen;           // "10.2 20.1 0"; empty unless a camera is calibrated
  std::optional<double> off;  // mm, what remains of it; none: there is no result
};

struct Calibration {
  std::vector<base::Diagnostic>
      errors;           // of the files; if there are any, the rest is not valid and nothing was changed
  std::string problem;  // with the request; if there is one, nothing was changed
  std::string points_file;
  std::vector<CalibrationPoint> points;
  std::string wrong;                        // why they give no result; empty: they do
  std::string next;                         // what to touch next, for the user
  std::string next_mark;                    // "TIP"; empty: there are enough points
  std::string declaration;                  // "TOOL pen = POSE 0 0 120 RPY 0 0 0"; empty: no result
  std::string before;                       // the declaration in the files; empty: it is new
  std::string file;                         // in which it is, or would be
  int line = 0;                             // 0: it is new
  double rms = 0, most = 0, sigma = 0;      // mm; sigma: of one coordinate of a point, 0 if it is not known
  std::size_t worst = 0;                    // point with `most`, from 1; 0: no result
  int spare = 0;                            // equations beyond those needed
  bool turned = false;                      // whether the points determine the orientation
  std::array<double, 3> place_deviation{};  // mm, standard deviations along x y z; 0 if sigma is
  std::array<double, 3> turn_deviation{};   // deg, about x y z of the result
  double scale = 1;                         // of a camera: distances touched by distances seen
};

struct TakenPoint {
  std::string mark;          // empty: Calibration::next_mark
  std::vector<double> seen;  // x y, x y z, or x y z roll pitch yaw in mm and deg; for cameras
  std::string tool;          // the selected tool of the robot; empty: none
};

Calibration show_calibration(const FileNames& names, const CalibrationOrder& order);
// Adds the present position to the points.
Calibration take_point(const FileNames& names, const CalibrationOrder& order, const TakenPoint& taken,
                       const Stand& stand);
// Removes a point, from 1; 0: all of them.
Calibration drop_point(const FileNames& names, const CalibrationOrder& order, std::size_t point);
// Declares the result: replaces the declaration, which stays as a comment before it, with the date. Masses and the
// comment of the line are kept. Points that are not in a file of the user's choice become NAME.KIND.points.accepted.
Calibration accept_calibration(const FileNames& names, const CalibrationOrder& order);

}  // namespace indurop::robot
