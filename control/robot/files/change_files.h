// SPDX-License-Identifier: Apache-2.0
// Changes one of a robot's job files, if all of them stay valid. Not real-time safe.

#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "control/robot/files/files.h"
#include "control/robot/files/stand.h"
#include "control/robot/kinematics/arm.h"

namespace indurop::robot {

inline constexpr std::size_t kMostFileBytes = 4U << 20U;

// Returns why the robot is not the arm of the files; empty: it is.
std::string wrong_axes(const Arm& arm, const Stand& stand);

// The file for a new declaration: the one that is named, or the one with most of the points. Empty: the robot does not
// read it, see no_file().
std::string file_for(const std::string& named, const JobBook& book, const std::vector<std::string>& files);
std::string no_file(const std::string& named);

// Returns the errors that the files would have if one of them had this text.
std::vector<base::Diagnostic> problems_with(const FileNames& names, const std::string& file, const std::string& text,
                                            const Arm& arm);

struct FileChange {
  std::vector<base::Diagnostic> errors;  // that the files would have; if there are any, nothing was changed
  std::string problem;                   // why the file could not be changed; nothing was changed
};
// Replaces the file by what `edit` makes of its text, completely or not at all.
FileChange change_file(const FileNames& names, const Arm& arm, const std::string& file,
                       const std::function<std::string(std::string_view)>& edit);

}  // namespace indurop::robot
