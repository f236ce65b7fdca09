// SPDX-License-Identifier: Apache-2.0
// What is wrong with the files and properties of a robot module, for whoever looks at them before anything runs.

#pragma once

#include <string>
#include <vector>

#include "base/diagnostic.h"
#include "robot/job.h"
#include "robot/settings.h"

namespace indurop::robot {

struct FileNames {
  std::string urdf;
  std::vector<std::string> jobs;  // points too
  std::vector<double> workspace;  // as Settings has it; NaN: what is no number
  double tool_speed = 0;          // mm/s, likewise; 0: anything goes
  double clearance = 5;           // mm
  std::string ignored{};          // Settings::ignore_collisions
};

struct Findings {
  std::vector<base::Diagnostic> files;  // with a note of what the arm can do
  std::vector<WrongSetting> properties;
  std::vector<NamedVariable> variables;  // shared ones that jobs name: numbers or bools
};
// All of both. Workspace and tool speed are taken from the properties.
Findings check_module(FileNames names, const PropertyText& property);

}  // namespace indurop::robot
