// SPDX-License-Identifier: Apache-2.0
// Reads the files of a robot and checks them against each other.

#pragma once

#include <optional>

#include "control/robot/collision/clearance.h"
#include "control/robot/files/files.h"
#include "control/robot/files/urdf.h"
#include "control/robot/job/job.h"

namespace indurop::robot {

struct ReadFiles {
  std::string urdf;  // the text of its file
  std::optional<ArmModel> model;
  JobBook book;
  Clearance clearance;
  std::vector<base::Diagnostic> errors;  // if empty, the other members are valid
  std::vector<base::Diagnostic> notes;
  std::string kind;        // what the arm can do
  std::uint64_t mark = 0;  // differs if the text of any file does
};
ReadFiles read_files(const FileNames& names);

// What job files need to know of the arm.
ArmShape shape_of(const Arm& arm);

}  // namespace indurop::robot
