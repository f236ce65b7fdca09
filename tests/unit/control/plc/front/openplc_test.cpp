// SPDX-License-Identifier: Apache-2.0
// Projects of the OpenPLC Editor from version 4 on: project.json, and a file for each POU.

#include <gmock/gmock.h>

#include <map>

#include "tests/unit/control/plc/front/compiled.h"

namespace indurop::plc {
namespace {

using ::testing::HasSubstr;
using testing::messages;
using testing::written;

using Files = std::map<std::string, std::string>;

Compiled openplc_project(const Files& files) {
  CompileOptions options;
  for (const auto& [name, text] : files) {
    options.files.push_back(name);
  }
  options.name = "sut";
  return compile(options, [&](const std::string& name) { return glb2idl::ReadResult{files.at(name), name, ""}; });
}

const std::string kProject = R"({
  "meta": {"name": "cell", "type": "plc-project"},
  "data": {
    "pous": [],
    "dataTypes": [
      {"name": "Mode", "derivation": "enumerated", "initialValue": "Slow",
       "values": [{"description": "Fast"}, {"description": "Slow"}]},
      {"name": "Row", "derivation": "array", "baseType": {"definition": "base-type", "value": "int"},
       "dimensions": [{"dimension": "0..4"}]},
      {"name": "Point", "derivation": "structure", "variable": [
        {"name": "x", "type": {"definition": "base-type", "value": "int"},
         "initialValue": {"simpleValue": {"value": "3"}}}]}
    ],
    "configuration": {"resource": {
      "tasks": [{"name": "task0", "triggering": "Cyclic", "interval": "T#20ms", "priority": 1}],
      "instances": [{"name": "instance0", "program": "main", "task": "task0"}],
      "globalVariables": [
        {"name": "row", "type": {"definition": "user-data-type", "value": "Row"}, "location": "", "documentation": ""},
        {"name": "mode", "type": {"definition": "user-data-type", "value": "Mode"}, "location": "",
         "initialValue": null, "documentation": ""},
        {"name": "level", "type": {"definition": "base-type", "value": "uint"}, "location": "%MW0",
         "initialValue": "20", "documentation": ""}
      ]
    }}
  }
}
)";

std::string node(const std::string& id, const std::string& type, int x, const std::string& data) {
  return R"({"id": ")" + id + R"(", "type": ")" + type + R"(", "position": {"x": )" + std::to_string(x) +
         R"(, "y": 30}, "width": 24, "height": 24, "data": {)" + data + "}}";
}

std::string edge(const std::string& from, const std::string& pin, const std::string& to, const std::string& input) {
  return R"({"source": ")" + from + R"(", "sourceHandle": ")" + pin + R"(", "target": ")" + to +
         R"(", "targetHandle": ")" + input + R"("})";
}

std::string joined(const std::vector<std::string>& all) {
  std::string out;
  for (const std::string& one : all) {
    out += (out.empty() ? "" : ",\n") + one;
  }
  return out;
}

std::string rung(const std::string& comment, const std::vector<std::string>& nodes,
                 const std::vector<std::string>& edges) {
  return R"({"id": "r", "comment": ")" + comment + R"(", "nodes": [)" + joined(nodes) + R"(], "edges": [)" +
         joined(edges) + "]}";
}

std::string variable(const std::string& name, const std::string& variant) {
  return R"("variable": {"name": ")" + name + R"("}, "variant": ")" + variant + R"(")";
}

// (start OR motor) AND NOT stop, then a timer.
std::string ladder() {
  const std::string timer =
      R"("variant": {"name": "TON", "type": "function-block"}, "variable": {"name": "delay"},
         "inputHandles": [{"id": "IN"}, {"id": "PT"}], "outputHandles": [{"id": "Q"}, {"id": "ET"}])";
  const std::string first = rung(
      "Start",
      {node("left", "powerRail", 0, R"("variant": "left")"), node("open", "parallel", 40, ""),
       node("a", "contact", 60, variable("start", "default")), node("b", "contact", 60, variable("motor", "default")),
       node("close", "parallel", 100, ""), node("c", "contact", 120, variable("stop", "negated")),
       node("d", "coil", 200, variable("motor", "default")), node("right", "powerRail", 300, R"("variant": "right")")},
      {edge("left", "left-rail", "open", "input"), edge("open", "output-right", "a", "input"),
       edge("open", "output-down", "b", "input"), edge("a", "output", "close", "input"),
       edge("b", "output", "close", "input-down"), edge("close", "output-right", "c", "input"),
       edge("c", "output", "d", "input"), edge("d", "output", "right", "right-rail")});
  const std::string second = rung(
      "",
      {node("left", "powerRail", 0, R"("variant": "left")"), node("a", "contact", 60, variable("motor", "risingEdge")),
       node("v", "variable", 60, variable("T#2s", "input")), node("t", "block", 100, timer),
       node("d", "coil", 200, variable("belt", "set"))},
      {edge("left", "left-rail", "a", "input"), edge("a", "output", "t", "IN"), edge("v", "output", "t", "PT"),
       edge("t", "Q", "d", "input")});
  return "PROGRAM main\nVAR\n\tstart, stop : bool;\n\tmotor : bool AT %QX0.0;\n\tbelt : bool;\n\tdelay : "
         "TON;\nEND_VAR\n\n{\n"
         R"("name": "main", "rungs": [)" +
         first + ",\n" + second + "]\n}\nEND_PROGRAM\n";
}

TEST(PlcOpenPlc, A_project_with_a_ladder) {
  const Compiled made = openplc_project({{"project.json", kProject}, {"pous/programs/main.ld", ladder()}});
  ASSERT_TRUE(made.ok) << messages(made);
  const std::string text = written(made);
  EXPECT_THAT(text, HasSubstr("<period>20ms</period>"));
  EXPECT_THAT(text, HasSubstr("(_p3_start || _p4_motor) && !stop")) << "branches meet";
  EXPECT_THAT(text, HasSubstr("// network 1: Start"));
  EXPECT_THAT(text, HasSubstr("delay.pt = iec::Time{2000000000}"));
  EXPECT_THAT(text, HasSubstr("belt = true"));
}

TEST(PlcOpenPlc, Globals_and_types_of_the_project) {
  const Compiled made =
      openplc_project({{"project.json", kProject},
                       {"datatypes/Other.dt", "TYPE\n  Other : (On, Off) := Off;\nEND_TYPE\n"},
                       {"pous/function-blocks/Add.il",
                        "FUNCTION_BLOCK Add1\nVAR_INPUT a : int; END_VAR\nVAR_OUTPUT b : int; END_VAR\n"
                        "LD a\nADD 1\nST b\nEND_FUNCTION_BLOCK\n"},
                       {"pous/programs/main.st",
                        "PROGRAM main\nVAR p : Point; add : Add1; o : Other; END_VAR\n"
                        "add(a := p.x);\nIF mode = Slow AND o = Off THEN level := 5; row[4] := add.b; END_IF;\n"
                        "END_PROGRAM\n"}});
  ASSERT_TRUE(made.ok) << messages(made);
  EXPECT_THAT(made.glb, HasSubstr("int16_t row[5]"));
  EXPECT_THAT(made.glb, HasSubstr("level = 20"));
}

TEST(PlcOpenPlc, A_function_block_diagram) {
  const std::string add =
      R"("variant": {"name": "ADD", "type": "function"}, "variable": {"name": ""},
         "inputHandles": [{"id": "IN1"}, {"id": "IN2"}], "outputHandles": [{"id": "OUT"}])";
  const std::string drawing =
      rung("",
           {node("a", "input-variable", 0, variable("x", "")), node("b", "input-variable", 0, variable("3", "")),
            node("f", "block", 100, add), node("o", "output-variable", 200, variable("y", ""))},
           {edge("a", "output", "f", "IN1"), edge("b", "output", "f", "IN2"), edge("f", "OUT", "o", "input")});
  const Compiled made = openplc_project(
      {{"project.json", kProject},
       {"pous/programs/main.fbd", "PROGRAM main\nVAR\n  x, y : INT;\nEND_VAR\n\n{\"name\": \"main\", \"rung\": " +
                                      drawing + "}\nEND_PROGRAM\n"}});
  ASSERT_TRUE(made.ok) << messages(made);
  EXPECT_THAT(written(made), HasSubstr("y = iec::add(x, std::int16_t{3})"));
}

// As versions before had it.
TEST(PlcOpenPlc, POUs_inside_the_project) {
  std::string text = kProject;
  text.replace(text.find("\"pous\": []"), 10,
               R"("pous": [{"type": "function", "data": {"language": "st", "name": "Twice",
      "returnType": "int", "documentation": "", "variables": [{"name": "a", "class": "input",
      "type": {"definition": "base-type", "value": "int"}, "location": ""}],
      "body": {"language": "st", "value": "Twice := 2 * a;"}}},
    {"type": "program", "data": {"language": "st", "name": "main", "documentation": "", "variables": [
      {"name": "n", "class": "local", "type": {"definition": "array", "value": "", "data": {"dimensions":
      [{"dimension": "1..3"}], "baseType": {"definition": "base-type", "value": "int"}}}, "location": ""}],
      "body": {"language": "st", "value": "n[1] := Twice(n[2]);"}}}])");
  const Compiled made = openplc_project({{"project.json", text}});
  ASSERT_TRUE(made.ok) << messages(made);
  EXPECT_THAT(written(made), HasSubstr("Twice("));
}

TEST(PlcOpenPlc, What_is_wrong_is_said_with_its_place) {
  EXPECT_THAT(messages(openplc_project({{"project.json", "{}"}})),
              HasSubstr("this is no project of the OpenPLC Editor"));
  EXPECT_THAT(messages(openplc_project({{"main.ld", "PROGRAM main\nEND_PROGRAM\n"}})),
              HasSubstr("there is no drawing in it"));
  std::string text = ladder();
  text.replace(text.find("\"stop\""), 6, "\"stopp\"");
  EXPECT_THAT(messages(openplc_project({{"main.ld", text}})), HasSubstr("'stopp' is not declared"));
}

}  // namespace
}  // namespace indurop::plc
