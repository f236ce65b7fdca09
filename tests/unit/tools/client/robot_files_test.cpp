// SPDX-License-Identifier: Apache-2.0
#include "tools/client/robot/robot_files.h"

#include <gmock/gmock.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <utility>

#include "tools/client/robot/pallets.h"

namespace indurop::tools {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr const char* kArm = R"(<robot name="arm"><link name="base"/><link name="tool"/>
<joint name="j1" type="revolute"><parent link="base"/><child link="tool"/><axis xyz="0 0 1"/>
<limit lower="-1" upper="1" velocity="1" effort="0"/></joint></robot>)";

class Robot_files : public testing::Test {
 protected:
  void SetUp() override {
    std::filesystem::create_directories(folder_);
    config_.file = folder_ / "module.xml";
    config_.modules.emplace_back();
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  void write(const std::string& name, const std::string& text) const { std::ofstream(folder_ / name) << text; }
  [[nodiscard]] std::vector<std::string> errors() const {
    std::vector<std::string> texts;
    for (const base::Diagnostic& one : check_robot_files(config_, check_)) {
      texts.push_back(base::to_string(one).substr(folder_.string().size() + 1));
    }
    return texts;
  }

  config::Config config_;
  config::CheckResult check_;

 private:
  std::filesystem::path folder_ =
      std::filesystem::temp_directory_path() / ("robot_files_test." + std::to_string(::getpid()));
};

TEST_F(Robot_files, All_of_them_are_read_and_all_errors_reported_at_once) {
  config_.modules[0].properties = {{"urdf", "arm.urdf"}, {"jobs", "points.job  pick.job gone.job"}};
  write("arm.urdf", "<robot name=\"arm\"/>");
  write("points.job", "POINT A = JOINT 1 2 3\n");
  write("pick.job", "MOVJ A\nTRAVEL B\n");
  const auto found = errors();
  EXPECT_THAT(found, testing::Contains(HasSubstr("arm.urdf:1:")));
  EXPECT_THAT(found, testing::Contains(HasSubstr("points.job:1:")));
  EXPECT_THAT(found, testing::Contains(HasSubstr("pick.job:2:1: error: unknown statement 'TRAVEL'")));
  EXPECT_THAT(found, testing::Contains(HasSubstr("gone.job:1:1: error: this job cannot be read")));
}

TEST_F(Robot_files, Jobs_name_variables_that_there_are) {
  const auto add = [&](const char* name, schema::Base base) {
    schema::Variable one;
    one.name = name;
    one.type.base = base;
    one.type.element_size = 2;
    check_.schema.variables.push_back(one);
  };
  add("PLC_ROBOT::I4", schema::Base::Int16);
  add("PLC_ROBOT::name", schema::Base::Text);
  write("arm.urdf", kArm);
  config_.modules[0].properties = {{"urdf", "arm.urdf"}, {"jobs", "pick.job"}};
  write("pick.job", "WAIT I4 ON\nSET PLC_ROBOT::I4 ON\nSET I5 OFF\nIF I4 ON AND  name = 1\n SET I5 ON\nEND\n");
  EXPECT_THAT(errors(),
              testing::IsSupersetOf({HasSubstr("pick.job:3:5: error: no variable 'I5'; did you mean 'PLC_ROBOT::I4'?"),
                                     HasSubstr("pick.job:4:15: error: 'name' is not a number")}));
  write("pick.job", "WAIT I4 ON\nSET PLC_ROBOT::I4 ON\n");
  check_.uses = {{"PLC_ROBOT::I4", {""}, {""}}};
  EXPECT_THAT(errors(), testing::Not(testing::Contains(HasSubstr("pick.job"))));
}

TEST_F(Robot_files, Variables_of_jobs_that_access_does_not_name_get_a_warning) {
  for (const char* name : {"A::in", "A::both", "A::out"}) {
    schema::Variable& one = check_.schema.variables.emplace_back();
    one.name = name;
    one.type.base = schema::Base::Int16;
    one.type.element_size = 2;
  }
  write("arm.urdf", kArm);
  config_.modules[0].name = "Arm";
  config_.modules[0].properties = {{"urdf", "arm.urdf"}, {"jobs", "pick.job"}};
  write("pick.job", "WAIT in ON\nFOLLOW out = both + in\nSET A::both ON\nPULSE out 1s\nIF A::out > 1\nEND\n");
  const auto of_job = [&] {
    std::vector<std::string> found = errors();
    std::erase_if(found, [](const std::string& text) { return text.find("pick.job") == std::string::npos; });
    return found;
  };
  const auto warning = [](const char* place, const char* what, const char* element) {
    return testing::AllOf(HasSubstr(std::string("pick.job:") + place + ": warning: jobs " + what + ", which <access>"),
                          HasSubstr(std::string("add ") + element));
  };
  EXPECT_THAT(of_job(), testing::UnorderedElementsAre(warning("1:6", "read 'A::in'", "<read>A::in</read>"),
                                                      warning("2:8", "set 'A::out'", "<write>A::out</write>"),
                                                      warning("2:14", "read 'A::both'", "<read>A::both</read>"),
                                                      warning("3:5", "set 'A::both'", "<write>A::both</write>"),
                                                      warning("5:4", "read 'A::out'", "<read>A::out</read>")));
  // What another module names does not count, and what a module writes it may read.
  check_.uses = {{"A::in", {"Arm"}, {}}, {"A::both", {"Arm"}, {"Other"}}, {"A::out", {"Other"}, {"Arm"}}};
  EXPECT_THAT(of_job(), ElementsAre(HasSubstr("add <write>A::both</write>")));
  check_.uses[1].writers.emplace_back("Arm");
  EXPECT_THAT(of_job(), IsEmpty());
}

TEST_F(Robot_files, Other_robots_are_declared_and_named_in_access) {
  for (const char* name : {"PLC_ROBOT2::ROBOT_SPACE", "PLC_ROBOT2::ROBOT_HELD"}) {
    check_.schema.variables.emplace_back().name = name;
  }
  write("arm.urdf", kArm);
  config_.modules[0].properties = {
      {"urdf", "arm.urdf"}, {"cell_box", "0 0 0 1 1 1"}, {"other_robots", "PLC_ROBOT2 PLC_ROBOT3"}};
  config_.modules[0].reads = {"PLC_ROBOT2::ROBOT_SPACE"};
  EXPECT_THAT(errors(),
              testing::IsSupersetOf(
                  {HasSubstr("property other_robots: 'PLC_ROBOT2::ROBOT_HELD' is not in <access> of this module"),
                   HasSubstr("property other_robots: no module of this node declares 'PLC_ROBOT3::ROBOT_SPACE'")}));
  config_.modules[0].reads.emplace_back("PLC_ROBOT2::ROBOT_HELD");
  EXPECT_THAT(errors(), testing::Not(testing::Contains(HasSubstr("<access>"))));
}

robot::ListedBodies bodies_with_pallet() {
  robot::ListedBodies bodies;
  bodies.work_frames.push_back({"pallet", {100, 200, 30}, {0, 0, 90}, false, {{"CORNER", {80, 210, 35}}}});
  return bodies;
}

TEST(Pallets, Places_are_in_the_order_in_which_they_are_used) {
  const auto found = pallets_in(" CORNER y 3 40 x 2 -60 z 2 30 PALLET::parts ; ", bodies_with_pallet());
  ASSERT_TRUE(found.ok()) << found.error();
  ASSERT_EQ(found->size(), 1U);
  const Pallet& one = found->front();
  EXPECT_EQ(one.frame, "pallet");
  EXPECT_EQ(one.used, "PALLET::parts");
  EXPECT_THAT(one.size, ElementsAre(60, 40, 30));
  ASSERT_EQ(one.places.size(), 12U);
  // The frame is turned by 90 degrees: its y is -x of the base, its x is y of the base.
  const auto expect_place = [&](std::size_t number, double x, double y, double z) {
    EXPECT_NEAR(one.places[number][0], x, 1e-9) << number;
    EXPECT_NEAR(one.places[number][1], y, 1e-9) << number;
    EXPECT_NEAR(one.places[number][2], z, 1e-9) << number;
  };
  expect_place(0, 80, 210, 35);
  expect_place(1, 40, 210, 35);
  expect_place(2, 0, 210, 35);
  expect_place(3, 80, 150, 35);
  expect_place(6, 80, 210, 65);
  expect_place(11, 0, 150, 65);
}

TEST(Pallets, What_is_wrong_is_said) {
  for (const auto& [text, why] : {std::pair("CORNER y 3 40", "is no pallet; write POINT"),
                                  {"CORNER y 3 40 x 2 PALLET::parts", "is no pallet"},
                                  {"CORNER q 3 40 parts", "'q 3 40' is no direction"},
                                  {"CORNER y 2.5 40 parts", "is no direction"},
                                  {"CORNER y 3 0 parts", "is no direction"},
                                  {"CORNER y 200 4 x 200 4 parts", "has 40000 places; at most 2000"},
                                  {"CORNR y 3 40 parts", "Did you mean 'CORNER'?"}}) {
    const auto found = pallets_in(text, bodies_with_pallet());
    ASSERT_FALSE(found.ok()) << text;
    EXPECT_THAT(found.error(), HasSubstr(why));
  }
  EXPECT_THAT(*pallets_in("", {}), IsEmpty());
}

TEST_F(Robot_files, Pallets_are_checked_with_the_module) {
  check_.schema.variables.emplace_back().name = "PALLET::parts";
  write("arm.urdf", kArm);
  write("points.job", "FRAME f = POSE 0 0 0 RPY 0 0 0\nPOINT A = JOINT 0\n");
  config_.modules[0].properties = {{"urdf", "arm.urdf"}, {"jobs", "points.job"}, {"pallets", "A x 2 40 PALLET::parts"}};
  EXPECT_THAT(errors(), testing::Contains(HasSubstr("property pallets: there is no point 'A' in a work frame")));
  config_.modules[0].properties.back() = {"pallet", "A x 2 40 PALLET::parts"};
  EXPECT_THAT(errors(), testing::Contains(HasSubstr("the robot has no property 'pallet'. Did you mean 'pallets'?")));
}

TEST_F(Robot_files, A_module_that_simulates_the_arm_is_no_robot) {
  config_.modules[0].name = "robot";
  config_.modules[0].properties = {{"urdf", "arm.urdf"}, {"jobs", "pick.job"}};
  config_.modules.emplace_back().name = "physics";
  config_.modules[1].properties = {{"urdf", "arm.urdf"}};
  config_.modules.emplace_back().name = "other";
  config_.modules[2].properties = {{"urdf", "other.urdf"}};
  std::vector<std::string> names;
  for (const RobotFiles& one : robot_files_of(config_)) {
    names.push_back(one.module);
  }
  EXPECT_THAT(names, ElementsAre("robot", "other"));
}

TEST_F(Robot_files, Only_robot_modules_have_them) {
  config_.modules[0].properties = {{"gain", "3"}};
  EXPECT_THAT(errors(), IsEmpty());
  // Another module with a property of that name: it does not read URDF.
  config_.modules[0].properties = {{"jobs", "7 8"}};
  check_.facts.resize(1);
  check_.facts[0].file.imports = {"_ZN3irp5printEv", "malloc"};
  EXPECT_THAT(errors(), IsEmpty());
  check_.facts[0].file.imports = {"_ZN4urdf9parseURDFERKNSt7__cxx1112basic_stringE", "malloc"};
  EXPECT_THAT(errors(), ElementsAre(HasSubstr("robot.urdf:1:1: error"), HasSubstr("7:1:1: error"), HasSubstr("8:1:1")));
}

}  // namespace
}  // namespace indurop::tools
