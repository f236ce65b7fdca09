// SPDX-License-Identifier: Apache-2.0
#include "control/robot/kinematics/settings.h"

#include <gmock/gmock.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <map>

#include "control/robot/files/files.h"
#include "core/base/diagnostic.h"
#include "robot_fixture.h"

namespace indurop::robot {
namespace {

using ::testing::AllOf;
using ::testing::Each;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

class Robot_settings : public testing::Test {
 protected:
  // Names of what is wrong if the property has this text.
  std::vector<std::string> wrong(const std::string& name, const std::string& text) {
    Settings settings;
    std::vector<WrongSetting> found =
        take_properties([&](const char* asked) { return asked == name ? text : std::string(); }, settings);
    for (const auto& more : {check_settings(settings), check_axes(settings, cell_arm())}) {
      found.insert(found.end(), more.begin(), more.end());
    }
    std::vector<std::string> names;
    for (const WrongSetting& one : found) {
      names.push_back(one.property);
    }
    return names;
  }
};

TEST_F(Robot_settings, The_defaults_are_sane) {
  EXPECT_THAT(wrong("", ""), IsEmpty());
}

TEST_F(Robot_settings, Each_is_refused_if_it_makes_no_sense) {
  for (const std::string& name : setting_names()) {
    if (name == "urdf" || name == "jobs" || name == "ignore_collisions" || name == "other_robots") {
      continue;
    }
    EXPECT_THAT(wrong(name, "abc"), ElementsAre(name));
    EXPECT_THAT(wrong(name, "nan"), ElementsAre(name));
    const bool any_sign = name == "workspace" || name == "gear" || name == "zero" || name.starts_with("counts_");
    if (name != "absolute" && name != "plan_in_tick" && !any_sign) {
      EXPECT_THAT(wrong(name, "-5"), AllOf(Not(IsEmpty()), Each(name)));
    }
  }
  for (const char* name : {"time_to_speed", "tool_speed", "gear", "counts_per_mm", "plan_time", "emergency_factor"}) {
    EXPECT_THAT(wrong(name, "0"), ElementsAre(name));
  }
  EXPECT_THAT(wrong("emergency_factor", "0.5"), ElementsAre("emergency_factor"));
  EXPECT_THAT(wrong("emergency_category", "2"), ElementsAre("emergency_category"));
  EXPECT_THAT(wrong("acceleration", "1 2 3"), ElementsAre("acceleration"));
  EXPECT_THAT(wrong("jerk", "1 2 3 4 5 -1"), ElementsAre("jerk"));
  EXPECT_THAT(wrong("counts_per_turn", "1000 2000"), ElementsAre("counts_per_turn"));
  EXPECT_THAT(wrong("gear", "1 1 1 0 1 1"), ElementsAre("gear"));
  EXPECT_THAT(wrong("zero", "0 0 0 0 0 inf"), ElementsAre("zero"));
}

TEST_F(Robot_settings, Of_robots_that_share_their_space_are_refused_if_they_do_not_fit) {
  Settings settings;
  settings.name = "R1";
  settings.cell_box = {0, 0, 0, 1, 1, 1};
  const auto wrong = [&] {
    std::vector<std::string> texts;
    for (const WrongSetting& one : check_settings(settings)) {
      texts.push_back(one.property + ": " + one.text);
    }
    return texts;
  };
  settings.other_robots = {"R2", "R3", "R4"};
  EXPECT_THAT(wrong(), IsEmpty());
  settings.other_robots = {"R2", "R3", "R4", "R5"};
  EXPECT_THAT(wrong(), ElementsAre("other_robots: at most 3 other robots can share the space of one"));
  settings.other_robots = {"R2", "R1"};
  EXPECT_THAT(wrong(), ElementsAre("other_robots: 'R1' is this robot; name the others only"));
  settings.other_robots = {"R2", "R2"};
  EXPECT_THAT(wrong(), ElementsAre("other_robots: 'R2' is named twice"));
  settings.other_robots = {std::string(32, 'R')};
  EXPECT_THAT(wrong(), ElementsAre(HasSubstr("is too long: at most 31 characters")));
  settings.other_robots = {"R2"};
  for (const std::vector<double>& box : {std::vector<double>{}, {0, 0, 0, 1, 1}, {0, 0, 0, 1, 0, 1}}) {
    settings.cell_box = box;
    EXPECT_THAT(wrong(), ElementsAre(HasSubstr("cell_box: robots that share their space need the box")));
  }
  settings.cell_box = {0, 0, 0, 1, 1, 1};
  settings.base_in_cell = {1, 2, 3};
  EXPECT_THAT(wrong(), ElementsAre(HasSubstr("base_in_cell: it has to be a pose")));
}

// Long: it is a list of all properties.
TEST_F(Robot_settings, All_of_them_are_taken) {
  const std::map<std::string, std::string> texts = {{"counts_per_turn", "10 -20 30 40 50 60"},
                                                    {"counts_per_mm", "11"},
                                                    {"gear", "-2"},
                                                    {"zero", "0 -90 90 0 0 1.5"},
                                                    {"rotor_inertia", "1 2 0 4 5 6"},
                                                    {"rated_torque", "1 1 1 1 1 2"},
                                                    {"collision_limit", "1 1 1 1 1 3"},
                                                    {"guide_mass", "12"},
                                                    {"guide_damping", "80"},
                                                    {"guide_threshold", "0 1 2 3 4 5"},
                                                    {"time_to_speed", " 0.5\n"},
                                                    {"time_to_acceleration", "+1"},
                                                    {"tool_speed", "1e3"},
                                                    {"tool_turn_speed", "90"},
                                                    {"emergency_factor", "2"},
                                                    {"emergency_category", "0"},
                                                    {"following_limit", "3"},
                                                    {"regain_distance", "4"},
                                                    {"plan_time", "0.1"},
                                                    {"plan_in_tick", "yes"},
                                                    {"absolute", "off"},
                                                    {"acceleration", "1 2 3 4 5 6"},
                                                    {"jerk", "6 5 4 3 2 1"},
                                                    {"workspace", "0 0 0 1 1 1"},
                                                    {"clearance", "7"},
                                                    {"other_robots", " R2 R3 "},
                                                    {"cell_box", "0 1 2 3 4 5"},
                                                    {"base_in_cell", "6 5 4 3 2 1"},
                                                    {"ignore_collisions", "wrist forearm"}};
  Settings settings;
  EXPECT_THAT(take_properties([&](const char* name) { return texts.at(name); }, settings), IsEmpty());
  EXPECT_THAT(settings.counts_per_turn, ElementsAre(10, -20, 30, 40, 50, 60));
  EXPECT_THAT(settings.counts_per_mm, ElementsAre(11));
  EXPECT_THAT(settings.gear, ElementsAre(-2));
  EXPECT_THAT(settings.zero, ElementsAre(0, -90, 90, 0, 0, 1.5));
  EXPECT_THAT(settings.rotor_inertia, ElementsAre(1, 2, 0, 4, 5, 6));
  EXPECT_THAT(settings.rated_torque, ElementsAre(1, 1, 1, 1, 1, 2));
  EXPECT_THAT(settings.collision_limit, ElementsAre(1, 1, 1, 1, 1, 3));
  EXPECT_EQ(settings.guide_mass, 12);
  EXPECT_EQ(settings.guide_damping, 80);
  EXPECT_THAT(settings.guide_threshold, ElementsAre(0, 1, 2, 3, 4, 5));
  EXPECT_EQ(settings.time_to_speed, 0.5);
  EXPECT_EQ(settings.time_to_acceleration, 1);
  EXPECT_EQ(settings.tool_speed, 1000);
  EXPECT_EQ(settings.tool_turn_speed, 90);
  EXPECT_EQ(settings.emergency_factor, 2);
  EXPECT_EQ(settings.emergency_category, StopCategory::Category0);
  EXPECT_EQ(settings.following_limit, 3);
  EXPECT_EQ(settings.regain_distance, 4);
  EXPECT_EQ(settings.plan_time, 0.1);
  EXPECT_TRUE(settings.plan_in_tick);
  EXPECT_FALSE(settings.absolute);
  EXPECT_THAT(settings.acceleration, ElementsAre(1, 2, 3, 4, 5, 6));
  EXPECT_THAT(settings.jerk, ElementsAre(6, 5, 4, 3, 2, 1));
  EXPECT_THAT(settings.workspace, ElementsAre(0, 0, 0, 1, 1, 1));
  EXPECT_EQ(settings.clearance, 7);
  EXPECT_EQ(settings.ignore_collisions, "wrist forearm");
  EXPECT_THAT(settings.other_robots, ElementsAre("R2", "R3"));
  EXPECT_THAT(settings.cell_box, ElementsAre(0, 1, 2, 3, 4, 5));
  EXPECT_THAT(settings.base_in_cell, ElementsAre(6, 5, 4, 3, 2, 1));
}

TEST(Robot_files, Speeds_of_jobs_beyond_full_speed_are_warned_of) {
  const auto job = std::filesystem::path(testing::TempDir()) / ("speeds." + std::to_string(::getpid()) + ".job");
  const auto urdf = std::filesystem::path(job).replace_extension(".urdf");
  std::ofstream(urdf) << cell_urdf();
  std::ofstream(job) << "SPEED 1000 mm/s\nSPEED 1001 mm/s\nSPEED 100%\n  SPEED 0.5 mm/s\n";
  const auto notes = [&](const std::string& tool_speed) {
    const Findings found = check_module({urdf.string(), {job.string()}, {}}, [&](const std::string& name) {
      return name == "tool_speed" ? tool_speed : "";
    });
    return base::to_text(found.files);
  };
  const std::string text = notes("1000");
  EXPECT_THAT(text, HasSubstr(job.string() + ":2:1: warning: SPEED 1001 mm/s is beyond full speed, 1000 mm/s (property "
                                             "tool_speed): lines run at that"));
  EXPECT_THAT(text, Not(HasSubstr("SPEED 1000 ")));
  EXPECT_THAT(notes("250"), HasSubstr("SPEED 1000 mm/s is beyond full speed, 250 mm/s"));
  EXPECT_THAT(notes("250"), Not(HasSubstr("SPEED 0.5 ")));
  std::filesystem::remove(job);
  std::filesystem::remove(urdf);
}

}  // namespace
}  // namespace indurop::robot
