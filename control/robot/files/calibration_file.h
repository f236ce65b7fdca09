// SPDX-License-Identifier: Apache-2.0
// The file with the points of a calibration: one line for each, like places in job files.

#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "control/robot/files/calibrate.h"
#include "control/robot/job/job.h"
#include "control/robot/kinematics/arm.h"
#include "control/robot/kinematics/calibration.h"

namespace indurop::robot {

struct MarkWord {
  Mark mark;
  std::string_view word;
};
// The marks that a calibration of this kind has, in the order in which they are taken.
std::vector<MarkWord> marks_of(CalibrationKind kind);

struct MarkedPoint {
  MarkWord mark{};
  std::string place;  // as in the file, behind the mark and what was seen
  std::string seen;   // as in the file
  Measured measured;
  int line = 0;  // from 1
};

struct CalibrationFile {
  std::vector<MarkedPoint> points;
  std::vector<base::Diagnostic> errors;
};
// Tools that touched are those of the book.
CalibrationFile parse_calibration(const std::string& file, std::string_view text, CalibrationKind kind, const Arm& arm,
                                  const JobBook& book);

// Returns the mark of the point to take next, and what to touch, for the user; empty: there are enough.
std::pair<std::string, std::string> next_point(CalibrationKind kind, const std::vector<MarkedPoint>& points);

// Returns the text without a line, from 1.
std::string without_line(std::string_view text, int line);
// Returns the line of a point: "TIP JOINT 0 -10 -20 0 90 0", "SEEN 10 20 0 AT JOINT ... TOOL tip". `seen`: 0, 3 or 6
// numbers. Angles are written to a millionth of a degree, places to a millionth of a mm.
std::string calibration_line(const Arm& arm, std::string_view mark, const std::vector<double>& seen,
                             const Joints& joints, const std::string& tool);

}  // namespace indurop::robot
