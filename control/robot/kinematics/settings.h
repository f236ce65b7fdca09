// SPDX-License-Identifier: Apache-2.0
// Reads and checks the properties of a robot module, for the module itself and for tools that check its configuration
// before anything runs.

#pragma once

#include <indurop/robot/controller.h>

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "control/robot/kinematics/arm.h"

namespace indurop::robot {

struct WrongSetting {
  std::string property;
  std::string text;  // what is wrong, and what to do
};

// Returns the text of a property; empty: it is not set.
using PropertyText = std::function<std::string(const char* name)>;

// Fills in the members that have the names of properties, except urdf and jobs. A member whose property is wrong keeps
// its value.
std::vector<WrongSetting> take_properties(const PropertyText& given, Settings& settings);
// Checks for values that make no sense.
std::vector<WrongSetting> check_settings(const Settings& settings);
// Checks the settings that have one value per axis; `weighed`: the torques of the arm are known. `singles`: number of
// axes that belong to no group.
std::vector<WrongSetting> check_axes(const Settings& settings, const Arm& arm, bool weighed = true,
                                     std::size_t singles = 0);
// Converts such a setting; zeros if it is empty.
Joints of_axes(const std::vector<double>& values) noexcept;
// The names that take_properties() knows, and urdf and jobs.
const std::vector<std::string>& setting_names();

}  // namespace indurop::robot
