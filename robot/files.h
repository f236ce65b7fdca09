// SPDX-License-Identifier: Apache-2.0
// What is wrong with the files of a robot, for whoever looks at them before anything runs.

#pragma once

#include <string>
#include <vector>

#include "base/diagnostic.h"

namespace indurop::robot {

struct FileNames {
  std::string urdf;
  std::vector<std::string> jobs;  // points too
  std::vector<double> workspace;  // as Settings has it; NaN: what is no number
};

// All errors of all of them, and a note of what the arm can do.
std::vector<base::Diagnostic> check_files(const FileNames& names);

}  // namespace indurop::robot
