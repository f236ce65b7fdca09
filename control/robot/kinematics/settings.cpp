// SPDX-License-Identifier: Apache-2.0
#include "control/robot/kinematics/settings.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <utility>

#include "core/base/word_values.h"

namespace indurop::robot {

namespace {

using Wrong = std::vector<WrongSetting>;

struct Number {
  const char* name;
  double Settings::*member;
};
// Settings that must be above 0.
constexpr Number kNumbers[] = {
    {"time_to_speed", &Settings::time_to_speed},
    {"time_to_acceleration", &Settings::time_to_acceleration},
    {"tool_speed", &Settings::tool_speed},
    {"tool_turn_speed", &Settings::tool_turn_speed},
    {"following_limit", &Settings::following_limit},
    {"regain_distance", &Settings::regain_distance},
    {"plan_time", &Settings::plan_time},
    {"clearance", &Settings::clearance},
    {"guide_mass", &Settings::guide_mass},
    {"guide_damping", &Settings::guide_damping},
};
// Settings that need not be above 0.
constexpr Number kOtherNumbers[] = {
    {"emergency_factor", &Settings::emergency_factor},
};
struct Flag {
  const char* name;
  bool Settings::*member;
};
constexpr Flag kFlags[] = {{"absolute", &Settings::absolute}, {"plan_in_tick", &Settings::plan_in_tick}};
struct List {
  const char* name;
  std::vector<double> Settings::*member;
};
constexpr List kLists[] = {{"acceleration", &Settings::acceleration},
                           {"jerk", &Settings::jerk},
                           {"workspace", &Settings::workspace},
                           {"cell_box", &Settings::cell_box},
                           {"base_in_cell", &Settings::base_in_cell},
                           {"counts_per_turn", &Settings::counts_per_turn},
                           {"counts_per_mm", &Settings::counts_per_mm},
                           {"gear", &Settings::gear},
                           {"zero", &Settings::zero},
                           {"rotor_inertia", &Settings::rotor_inertia},
                           {"rated_torque", &Settings::rated_torque},
                           {"collision_limit", &Settings::collision_limit},
                           {"guide_threshold", &Settings::guide_threshold}};
constexpr const char* kCategory = "emergency_category";
constexpr const char* kIgnored = "ignore_collisions";
constexpr const char* kOthers = "other_robots";

// This library stands alone: core/base/text.h is not in it.
std::string trimmed(const std::string& text) {
  constexpr const char* kSpaces = " \t\r\n";
  const std::size_t first = text.find_first_not_of(kSpaces);
  return first == std::string::npos ? "" : text.substr(first, text.find_last_not_of(kSpaces) - first + 1);
}

std::string quote(const std::string& text) {
  return "'" + text + "'";
}

// Reads a number. take_properties() has trimmed the texts of properties.
void take_number(const PropertyText& property, const Number& number, Settings& settings, Wrong& wrong) {
  const std::string text = property(number.name);
  if (text.empty()) {
    return;
  }
  if (const auto value = base::number_in(text)) {
    settings.*number.member = *value;
  } else {
    wrong.push_back({number.name, quote(text) + " is no number, write one such as 0.25"});
  }
}

void take_list(const PropertyText& property, const List& list, Settings& settings, Wrong& wrong) {
  std::istringstream words(property(list.name));
  std::vector<double> values;
  for (std::string word; words >> word;) {
    const auto value = base::number_in(word);
    if (!value) {
      wrong.push_back({list.name, quote(word) + " is no number, write numbers with spaces between them"});
      return;
    }
    values.push_back(*value);
  }
  if (!values.empty()) {
    settings.*list.member = std::move(values);
  }
}

}  // namespace

std::vector<WrongSetting> take_properties(const PropertyText& given, Settings& settings) {
  const auto property = [&given](const char* name) { return trimmed(given(name)); };
  Wrong wrong;
  for (const Number& number : kNumbers) {
    take_number(property, number, settings, wrong);
  }
  for (const Number& number : kOtherNumbers) {
    take_number(property, number, settings, wrong);
  }
  for (const Flag& flag : kFlags) {
    const std::string text = property(flag.name);
    const auto value = base::flag_in(text);
    settings.*flag.member = value.value_or(settings.*flag.member);
    if (!value && !text.empty()) {
      wrong.push_back({flag.name, quote(text) + " is neither true nor false"});
    }
  }
  for (const List& list : kLists) {
    take_list(property, list, settings, wrong);
  }
  settings.ignore_collisions = property(kIgnored);
  std::istringstream others(property(kOthers));
  for (std::string other; others >> other;) {
    settings.other_robots.push_back(other);
  }
  if (const std::string text = property(kCategory); !text.empty()) {
    if (text == "0" || text == "1") {
      settings.emergency_category = text == "0" ? StopCategory::Category0 : StopCategory::Category1;
    } else {
      wrong.push_back({kCategory, "it has to be 0 or 1, an emergency stop takes power away"});
    }
  }
  return wrong;
}

namespace {

// Checks the settings of robots that share their space.
void check_space(const Settings& settings, Wrong& wrong) {
  const std::vector<std::string>& others = settings.other_robots;
  const auto finite = [](const std::vector<double>& values) {
    return std::all_of(values.begin(), values.end(), [](double v) { return std::isfinite(v); });
  };
  const auto is_box = [&](const std::vector<double>& v) {
    return v.size() == 6 && finite(v) && v[0] != v[3] && v[1] != v[4] && v[2] != v[5];
  };
  if (others.size() > kOtherRobots) {
    wrong.push_back({kOthers, "at most " + std::to_string(kOtherRobots) + " other robots can share the space of one"});
  }
  for (auto one = others.begin(); one != others.end(); ++one) {
    if (one->size() > string<32>::capacity()) {
      wrong.push_back({kOthers, quote(*one) + " is too long: at most 31 characters"});
    }
    if (*one == settings.name) {
      wrong.push_back({kOthers, quote(*one) + " is this robot; name the others only"});
    }
    if (std::find(others.begin(), one, *one) != one) {
      wrong.push_back({kOthers, quote(*one) + " is named twice"});
    }
  }
  if (others.empty()) {
    const auto refuse = [&](const char* name, const std::vector<double>& values) {
      if (!values.empty()) {
        wrong.push_back({name, "it is for robots that share their space; name the others in other_robots"});
      }
    };
    refuse("cell_box", settings.cell_box);
    refuse("base_in_cell", settings.base_in_cell);
    return;
  }
  if (!is_box(settings.cell_box)) {
    wrong.push_back({"cell_box",
                     "robots that share their space need the box that contains it: two opposite corners, x y z x y z "
                     "in mm"});
  }
  if (!settings.base_in_cell.empty() && (settings.base_in_cell.size() != 6 || !finite(settings.base_in_cell))) {
    wrong.push_back({"base_in_cell", "it has to be a pose, x y z in mm, roll pitch yaw in deg"});
  }
}

}  // namespace

std::vector<WrongSetting> check_settings(const Settings& settings) {
  Wrong wrong;
  for (const Number& number : kNumbers) {
    const double value = settings.*number.member;
    if (!(std::isfinite(value) && value > 0)) {
      wrong.push_back({number.name, "it has to be above 0"});
    }
  }
  if (!(std::isfinite(settings.emergency_factor) && settings.emergency_factor >= 1)) {
    wrong.push_back({"emergency_factor", "it has to be 1 or more: an emergency stop brakes at least like any other"});
  }
  if (settings.emergency_category != StopCategory::Category0 &&
      settings.emergency_category != StopCategory::Category1) {
    wrong.push_back({kCategory, "it has to be 0 or 1, an emergency stop takes power away"});
  }
  check_space(settings, wrong);
  return wrong;
}

std::vector<WrongSetting> check_axes(const Settings& settings, const Arm& arm, bool weighed, std::size_t singles) {
  Wrong wrong;
  const auto count = static_cast<std::size_t>(arm.count());
  const std::size_t all = count + singles;
  const auto check = [&](const char* name, const std::vector<double>& values, std::size_t many, bool or_none = false) {
    const auto is_sane = [&](double v) { return std::isfinite(v) && (v > 0 || (or_none && v == 0)); };
    const bool fits = values.empty() || values.size() == many;
    if (!fits || !std::all_of(values.begin(), values.end(), is_sane)) {
      wrong.push_back({name, "it has to be " + std::to_string(many) + " numbers " + (or_none ? "from" : "above") +
                                 " 0, one of each axis"});
    }
  };
  const auto check_shared = [&](const char* name, const std::vector<double>& values, bool or_none = false) {
    const auto is_sane = [&](double v) { return std::isfinite(v) && (or_none || v != 0); };
    if ((values.size() != 1 && values.size() != all) || !std::all_of(values.begin(), values.end(), is_sane)) {
      wrong.push_back({name, "it has to be one number for all axes, or " + std::to_string(all) + ", one of each" +
                                 (or_none ? "" : "; none may be 0")});
    }
  };
  check_shared("counts_per_turn", settings.counts_per_turn);
  check_shared("counts_per_mm", settings.counts_per_mm);
  check_shared("gear", settings.gear);
  check_shared("zero", settings.zero, true);
  check("acceleration", settings.acceleration, all);
  check("jerk", settings.jerk, all);
  check("rated_torque", settings.rated_torque, count);
  // The torques of axes that move the workpiece are not known, so none may be unexpected.
  std::vector<double> of_arm = settings.collision_limit;
  for (std::size_t i = 0; of_arm.size() == count && i < count; ++i) {
    of_arm[i] = arm.moves_workpiece(static_cast<int>(i)) && of_arm[i] == 0 ? 1 : of_arm[i];
  }
  check("collision_limit", of_arm, count);
  check("rotor_inertia", settings.rotor_inertia, count, true);
  check("guide_threshold", settings.guide_threshold, count, true);
  for (const char* name : {"collision_limit", "rotor_inertia"}) {
    const bool rotors = name == std::string_view("rotor_inertia");
    if (!(rotors ? settings.rotor_inertia : settings.collision_limit).empty() && !weighed) {
      wrong.push_back({name, "the URDF does not say what the arm weighs; give its links <inertial>"});
    }
  }
  if (!settings.collision_limit.empty() && settings.rated_torque.empty()) {
    wrong.push_back({"collision_limit", "what drives measure counts in parts of rated_torque; give that too"});
  }
  return wrong;
}

Joints of_axes(const std::vector<double>& values) noexcept {
  Joints joints = Joints::Zero();
  std::copy_n(values.begin(), std::min(values.size(), static_cast<std::size_t>(kAxes)), joints.data());
  return joints;
}

const std::vector<std::string>& setting_names() {
  static const std::vector<std::string> kNames = [] {
    std::vector<std::string> names{"urdf", "jobs", kCategory, kIgnored, kOthers};
    const auto add = [&](const auto& table) {
      for (const auto& one : table) {
        names.emplace_back(one.name);
      }
    };
    add(kNumbers);
    add(kOtherNumbers);
    add(kFlags);
    add(kLists);
    return names;
  }();
  return kNames;
}

}  // namespace indurop::robot
