// SPDX-License-Identifier: Apache-2.0
// The files of a robot, read and checked against each other.

#pragma once

#include <optional>

#include "robot/clearance.h"
#include "robot/files.h"
#include "robot/job.h"
#include "robot/urdf.h"

namespace indurop::robot {

struct ReadFiles {
  std::string urdf;  // the text of its file
  std::optional<ArmModel> model;
  JobBook book;
  Clearance clearance;
  std::vector<base::Diagnostic> errors;  // without any, the others count
  std::vector<base::Diagnostic> notes;
  std::string kind;  // what the arm can do
};
ReadFiles read_files(const FileNames& names);

}  // namespace indurop::robot
