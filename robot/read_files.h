// SPDX-License-Identifier: Apache-2.0
// The files of a robot, read and checked against each other.

#pragma once

#include <optional>

#include "robot/files.h"
#include "robot/job.h"
#include "robot/urdf.h"

namespace indurop::robot {

struct ReadFiles {
  std::optional<ArmModel> model;
  JobBook book;
  std::vector<base::Diagnostic> errors;  // without any, both of the others count
};
ReadFiles read_files(const FileNames& names);

}  // namespace indurop::robot
