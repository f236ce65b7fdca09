// SPDX-License-Identifier: Apache-2.0
// What the properties of a robot module say, read and checked, for the module itself and for whoever looks at its
// configuration before anything runs.

#pragma once

#include <indurop/robot/controller.h>

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "robot/arm.h"

namespace indurop::robot {

struct WrongSetting {
  std::string property;
  std::string text;  // what, and what to do
};

// The text of a property; empty: it is not there.
using PropertyText = std::function<std::string(const char* name)>;

// Fills in what properties say, by the names of the members, urdf and jobs excepted. What is wrong keeps its value.
std::vector<WrongSetting> take_properties(const PropertyText& given, Settings& settings);
// Values that make no sense.
std::vector<WrongSetting> check_settings(const Settings& settings);
// Those of which each axis has one; `weighed`: the torques of the arm are known.
std::vector<WrongSetting> check_axes(const Settings& settings, const Arm& arm, bool weighed = true);
// A property of that kind; none: zeros.
Joints of_axes(const std::vector<double>& values) noexcept;
// The names that take_properties() knows, urdf and jobs.
const std::vector<std::string>& setting_names();

}  // namespace indurop::robot
