// SPDX-License-Identifier: Apache-2.0
// Finds errors in the files and properties of a robot module, before anything runs.

#pragma once

#include <optional>
#include <string>
#include <vector>

#include "control/robot/job/job.h"
#include "control/robot/kinematics/settings.h"
#include "core/base/diagnostic.h"

namespace indurop::robot {

struct FileNames {
  std::string urdf;
  std::vector<std::string> jobs;  // including point files
  std::vector<double> workspace;  // as in Settings; NaN: not a number
  double tool_speed = 0;          // mm/s, as in Settings; 0: no limit
  double clearance = 5;           // mm
  std::string ignored{};          // Settings::ignore_collisions
  std::vector<double> rotor_inertia{};
  std::optional<bool> shares{};  // whether there are Settings::other_robots; nullopt: it is not known
  double tool_turn_speed = 180;  // deg/s, as in Settings
  // As in Settings; without them, an endless axis may be anywhere.
  std::vector<double> counts_per_turn{}, gear{}, zero{};
  std::vector<double> rated_torque{};  // as in Settings; without it, no axis can push
};

FileNames names_of(const Settings& settings);

struct Findings {
  std::vector<base::Diagnostic> files;  // including a note on the abilities of the arm
  std::vector<WrongSetting> properties;
  std::vector<NamedVariable> variables;  // shared ones that jobs name: numbers or bools
};
// Checks files and properties. Workspace and tool speed are taken from the properties.
Findings check_module(FileNames names, const PropertyText& property);

}  // namespace indurop::robot
