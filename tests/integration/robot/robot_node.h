// SPDX-License-Identifier: Apache-2.0
// The robot task in a node, with simulated drives and the emergency stop, asked as a PLC program would ask.

#pragma once

#include <cctype>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <nlohmann/json.hpp>
#include <regex>
#include <string>
#include <vector>

#include "node_fixture.h"

namespace indurop::test {

class RobotNode : public NodeTest {
 protected:
  void copy(const std::string& from, const std::string& to) {
    std::ifstream file(from);
    write(to, {std::istreambuf_iterator<char>(file), {}});
  }
  // `robots`: the namespace of each, and its axes.
  std::vector<Module> modules(const std::string& job,
                              const std::map<std::string, std::string>& robots = {{"PLC_ROBOT", "123456"}}) {
    copy(std::string(CELL_SOURCE) + "/robot.urdf", "robot.urdf");
    write("test.job", job);
    std::string devices = "<ioconfig>";
    for (const auto& [robot, axes] : robots) {
      for (const char axis : axes) {
        const std::string name = robot + "::AXIS" + axis;
        devices += "<device name='" + robot + axis + "' driver='cia402' speed='540' following='30' probe='12' in='" +
                   name + "_IN' out='" + name + "_OUT'/>\n";
      }
    }
    write("ioconfig.xml", devices + "</ioconfig>\n");
    const std::string cell = CELL_BUILD;
    // Without rights to real time, on a busy machine, a run takes far longer than the ten periods after which it counts
    // as hanging.
    const std::string patient = "<budget>10s</budget>";
    return {{.file = IO_MODULE,
             .name = "io",
             .period = "5ms",
             .priority = 1,
             .properties = {{"config", "ioconfig.xml"}},
             .more = patient},
            {.file = cell + "/Robot.so",
             .name = "robot",
             .period = "5ms",
             .priority = 2,
             .properties = {{"urdf", "robot.urdf"},
                            {"jobs", "test.job"},
                            {"following_limit", "30"},
                            {"rated_torque", "200 200 200 200 200 200"}},
             .more = patient},
            {.file = cell + "/estop.so",
             .name = "estop",
             .operation = "sporadic",
             .period = "1ms",
             .priority = 1,
             .more = "<position>after-base</position>"}};
  }

  // The second one has seven axes.
  std::vector<Module> two_robots() {
    auto all =
        modules("POINT A = JOINT 30 10 -10 0 40 -20\nMOVJ A\n", {{"PLC_ROBOT", "123456"}, {"PLC_ROBOT2", "1234567"}});
    copy(SEVEN_AXES, "seven.urdf");
    write("second.job",
          "POINT A = JOINT -45 30 0 -70 0 60 25\nPOINT B = POSE 500 -100 600 RPY 180 0 180 AXIS 3 20\n"
          "MOVJ B\nMOVJ A\nSET PLC_ROBOT2::O8 ON\n");
    all.push_back({.file = SECOND_ROBOT,
                   .name = "robot2",
                   .period = "5ms",
                   .priority = 3,
                   .properties = {{"urdf", "seven.urdf"}, {"jobs", "second.job"}, {"following_limit", "30"}}});
    return all;
  }

  // Two robots of six axes that share their space. The first one points to the place between them and leaves it after
  // a while, the second one wants to go there.
  std::vector<Module> robots_that_share(const std::string& first_job) {
    auto all = modules(first_job, {{"PLC_ROBOT", "123456"}, {"PLC_ROBOT2", "123456"}});
    const std::string box = "0 -700 0 1400 700 1400";
    const auto access = [](const std::string& own, const std::string& other) {
      std::string names;
      for (const char* variable : {"::ROBOT_SPACE", "::ROBOT_HELD"}) {
        names += "<read>" + other + variable + "</read><write>" + own + variable + "</write>";
      }
      return "<budget>10s</budget><access>" + names + "</access>";
    };
    all[1].properties.insert(all[1].properties.end(), {{"other_robots", "PLC_ROBOT2"}, {"cell_box", box}});
    all[1].more = access("PLC_ROBOT", "PLC_ROBOT2");
    write("second.job", "POINT IN = JOINT 90 0 0 0 0 0\nMOVJ IN\nSET PLC_ROBOT2::O8 ON\n");
    all.push_back({.file = SECOND_ROBOT,
                   .name = "robot2",
                   .period = "5ms",
                   .priority = 3,
                   .properties = {{"urdf", "robot.urdf"},
                                  {"jobs", "second.job"},
                                  {"following_limit", "30"},
                                  {"other_robots", "PLC_ROBOT"},
                                  {"cell_box", box},
                                  {"base_in_cell", "1400 0 0 0 0 90"}},
                   .more = access("PLC_ROBOT2", "PLC_ROBOT")});
    return all;
  }

  // The robot of four axes and a feeder that belongs to no group, axis 5.
  std::vector<Module> with_feeder() {
    auto all = modules("", {{"PLC_ROBOT", "12345"}});
    std::ifstream file(FOUR_AXES);
    std::string urdf{std::istreambuf_iterator<char>(file), {}};
    urdf.insert(urdf.rfind("</robot>"),
                "<link name='wire'/><joint name='feeder' type='prismatic'><parent link='base'/><child link='wire'/>"
                "<axis xyz='0 0 1'/><limit lower='-100' upper='100' velocity='5' effort='1'/></joint>"
                "<single_axes joints='feeder'/>");
    write("robot.urdf", urdf);
    all[1].properties = {{"urdf", "robot.urdf"}, {"jobs", "test.job"}, {"following_limit", "100"}};
    return all;
  }

  // Each ok_NAME of the program says whether the block did what it should.
  void run_blocks(const std::string& name, int priority = 3,
                  const std::string& job = "TOOL gripper = POSE 0 0 120 RPY 0 0 0\n") {
    run_blocks(name, priority, modules(job));
  }
  void run_blocks(const std::string& name, int priority, std::vector<Module> all) {
    all.push_back(
        {.file = std::string(BLOCKS_DIR) + "/" + name + ".so", .name = "plc", .period = "5ms", .priority = priority});
    const Outcome outcome = run_to_end(all, {"--sim", "--until", "90s"});
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_EQ(number(name + "::stage"), 100)
        << indurop({"get", "PLC_ROBOT::MC_ANSWER"}).out << indurop({"get", "PLC_ROBOT::ROBOT_MODULE_STATE"}).out;
    std::ifstream file(std::string(BLOCKS_SOURCE) + "/" + name + ".st");
    const std::string text{std::istreambuf_iterator<char>(file), {}};
    const std::regex pattern("\\bok_\\w+");
    const std::string declared = text.substr(0, text.find("PROGRAM"));
    int blocks = 0;
    for (auto i = std::sregex_iterator(declared.begin(), declared.end(), pattern); i != std::sregex_iterator(); ++i) {
      ++blocks;
      EXPECT_EQ(indurop({"get", name + "::" + i->str()}).out, "true\n") << i->str();
    }
    EXPECT_GT(blocks, 5);
  }
  // Its number; 0: there is none.
  static pid_t thread_called(pid_t process, const std::string& name) {
    for (const auto& each : std::filesystem::directory_iterator("/proc/" + std::to_string(process) + "/task")) {
      std::ifstream file(each.path() / "comm");
      std::string text;
      if (std::getline(file, text) && text == name) {
        return static_cast<pid_t>(std::stol(each.path().filename()));
      }
    }
    return 0;
  }

  void begin(const std::string& job) {
    start_and_wait(modules(job));
    set("PLC_ROBOT::I14", "1");
    set("PLC_ROBOT::I15", "1");
    ASSERT_TRUE(wait_until([&] { return number("PLC_ROBOT::EMERGENCY_STOP.bActive") == 0; }));
  }
  void set(const std::string& variable, const std::string& to) {
    const Outcome outcome = indurop({"set", variable, to});
    EXPECT_EQ(outcome.code, 0) << outcome.err;
  }
  // A number in a variable, or a part of one.
  double number(const std::string& variable) {
    const Outcome outcome = indurop({"get", variable});
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    if (outcome.code != 0) {
      return std::nan("");
    }
    if (std::isalpha(static_cast<unsigned char>(outcome.out[0])) == 0) {
      return std::stod(outcome.out);
    }
    const auto parts = indurop({"typeof", variable, "-o", "json"}).json()["parts"];  // the value of an enumeration
    return parts[0]["values"][outcome.out.substr(0, outcome.out.find('\n'))].get<double>();
  }
  int next_request() { return static_cast<int>(number("PLC_ROBOT::ROBOT_MODULE_STATE.nAcknowledge")) + 1; }
  // ROBOT_ERROR of the service, once it has ended.
  int serve(const std::string& request) {
    const int wanted = next_request();
    set("PLC_ROBOT::ROBOT_MODULE_SERVICE", "{nRequest: " + std::to_string(wanted) + ", " + request + "}");
    EXPECT_TRUE(wait_until([&] { return number("PLC_ROBOT::ROBOT_MODULE_STATE.nDone") == wanted; }));
    return static_cast<int>(number("PLC_ROBOT::ROBOT_MODULE_STATE.nError"));
  }
  int state() { return static_cast<int>(number("PLC_ROBOT::ROBOT_MODULE_STATE.eState")); }
  double joint(int axis) { return 360.0 / 1320000 * number("PLC_ROBOT::AXIS" + std::to_string(axis) + "_IN.position"); }
};

}  // namespace indurop::test
