// SPDX-License-Identifier: Apache-2.0
// The types of instances that tools show as objects. The judge of where values are is the layout that the module is
// compiled with.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <string>

#include "control/plc/emit/instance_types.h"
#include "control/plc/front/watch_plan.h"

namespace indurop::plc {
namespace {

using ::testing::ElementsAre;

constexpr const char* kPlant =
    "TYPE Point : STRUCT x : INT; y : REAL; END_STRUCT; END_TYPE\n"
    "VAR_GLOBAL go : BOOL; limit : INT; END_VAR\n"
    "FUNCTION_BLOCK Base VAR_INPUT enable : BOOL; END_VAR VAR runs : UDINT; END_VAR runs := runs + 1;\n"
    "METHOD Reset limit := 0; END_METHOD END_FUNCTION_BLOCK\n"
    "FUNCTION_BLOCK Motor EXTENDS Base VAR_OUTPUT speed : REAL; END_VAR VAR_IN_OUT total : DINT; END_VAR\n"
    "VAR t : TON; spot : Point; p : POINTER TO INT; END_VAR VAR CONSTANT most : INT := 5; END_VAR VAR_TEMP k : INT; "
    "END_VAR\n"
    "k := most; t(IN := enable, PT := T#1s); p := ADR(spot.x); spot.x := k; total := total + 1; speed := 2.0;\n"
    "END_FUNCTION_BLOCK\n"
    "FUNCTION_BLOCK Line VAR motors : ARRAY[1..2, 0..1] OF Motor; text : STRING[7]; sum : DINT; END_VAR\n"
    "motors[1, 0](enable := TRUE, total := sum); motors[2, 1](enable := TRUE, total := sum); text := 'a';\n"
    "END_FUNCTION_BLOCK\n"
    "PROGRAM main VAR_EXTERNAL go : BOOL; END_VAR VAR RETAIN kept : INT; END_VAR VAR line : Line; big : LINT;\n"
    "place AT %IX0.0 : BOOL; END_VAR\n"
    "IF go AND place THEN line(); END_IF; big := big + 1; kept := limit; END_PROGRAM\n"
    "PROGRAM steps VAR n : INT; END_VAR\n"
    "INITIAL_STEP rest: END_STEP\nSTEP run: inc(P); END_STEP\nACTION inc: n := n + 1; END_ACTION\n"
    "TRANSITION FROM rest TO run := TRUE; END_TRANSITION\nTRANSITION FROM run TO rest := run.T > T#1s; END_TRANSITION\n"
    "END_PROGRAM\n"
    "CONFIGURATION c RESOURCE r ON cpu TASK fast(INTERVAL := T#1ms, PRIORITY := 1); TASK slow(INTERVAL := T#1s, "
    "PRIORITY "
    ":= 2);\n"
    "PROGRAM one WITH fast : main; PROGRAM two WITH slow : main; PROGRAM chart WITH slow : steps; END_RESOURCE\n"
    "END_CONFIGURATION\n";

WatchPlan plan_of(const std::string& text) {
  CompileOptions options;
  options.files = {"in.st"};
  options.name = "sut";
  return watch_plan(options, [text](const std::string& name) { return glb2idl::ReadResult{text, name, ""}; });
}

// Offsets by path in capitals, of all that is reported.
class Expanded {
 public:
  explicit Expanded(const InstanceTypes& all) : all_(all) {}
  std::map<std::string, std::size_t> of(std::size_t program) {
    instance(all_.programs[program], "", kInstanceBegin);
    return std::move(found_);
  }

 private:
  void instance(std::size_t number, const std::string& path, std::size_t begin) {
    const InstanceType& type = all_.types[number];
    if (type.base != kNoType) {
      instance(type.base, path, begin);
    }
    for (const InstanceVariable& one : type.variables) {
      if (one.offset) {
        value(one, *one.type, path + (path.empty() ? "" : ".") + upper(one.name), begin + *one.offset);
      }
    }
  }
  std::size_t value(const InstanceVariable& variable, const Type& type, const std::string& path, std::size_t at) {
    if (variable.of == kNoType) {
      found_[path] = at;
      return 0;
    }
    if (type.kind != Type::Kind::Array) {
      instance(variable.of, path, at);
      return all_.types[variable.of].bytes;
    }
    return elements(variable, type, path, at, 0, "");
  }
  std::size_t elements(const InstanceVariable& variable, const Type& type, const std::string& path, std::size_t at,
                       std::size_t dimension, const std::string& indices) {
    if (dimension == type.dimensions.size()) {
      return value(variable, *type.element, path + "[" + indices + "]", at);
    }
    std::size_t bytes = 0;
    for (std::int64_t i = type.dimensions[dimension].low; i <= type.dimensions[dimension].high; ++i) {
      bytes += elements(variable, type, path, at + bytes, dimension + 1,
                        indices + (indices.empty() ? "" : ",") + std::to_string(i));
    }
    return bytes;
  }

  const InstanceTypes& all_;
  std::map<std::string, std::size_t> found_;
};

// As a text; those of all other sections are "local".
std::string section_of(const InstanceVariable& variable) {
  switch (variable.section) {
    case ast::Section::Input:
      return "input";
    case ast::Section::Output:
      return "output";
    case ast::Section::InOut:
      return "in_out";
    case ast::Section::External:
      return "external";
    default:
      return "local";
  }
}

TEST(PlcInstanceTypes, Values_are_where_the_module_writes_them) {
  const WatchPlan plan = plan_of(kPlant);
  ASSERT_TRUE(plan.ok) << base::to_text(plan.diagnostics);
  const InstanceTypes sut = instance_types(plan.instances);
  ASSERT_EQ(sut.programs.size(), 3U);
  for (std::size_t i = 0; i < plan.layouts.size(); ++i) {
    std::map<std::string, std::size_t> wanted;
    for (const WatchedVariable& one : plan.layouts[i].variables) {
      if (one.path.front() != '_' && one.path.find("._") == std::string::npos) {  // names of the compiler
        wanted[one.path] = one.offset;
      }
    }
    EXPECT_EQ(Expanded(sut).of(i), wanted);
  }
  EXPECT_TRUE(Expanded(sut).of(0).contains("LINE.MOTORS[2,1].T.ET"));
  EXPECT_TRUE(Expanded(sut).of(2).contains("RUN"));
  EXPECT_EQ(sut.programs[0], sut.programs[1]) << "two instances, one type";
}

TEST(PlcInstanceTypes, Variables_have_their_sections) {
  const WatchPlan plan = plan_of(kPlant);
  const InstanceTypes sut = instance_types(plan.instances);
  std::map<std::string, std::string> sections;  // of all types, by "type.variable"
  for (const InstanceType& type : sut.types) {
    for (const InstanceVariable& one : type.variables) {
      sections[type.name + "." + one.name] = section_of(one) + (one.offset ? "" : " -") + (one.global ? " shared" : "");
    }
  }
  EXPECT_EQ(sections, (std::map<std::string, std::string>{
                          {"Base.enable", "input"},    {"Base.limit", "external - shared"},
                          {"Base.runs", "local"},      {"Motor.most", "local -"},
                          {"Motor.p", "local -"},      {"Motor.speed", "output"},
                          {"Motor.spot", "local"},     {"Motor.t", "local"},
                          {"Motor.total", "in_out -"}, {"TON.IN", "input"},
                          {"TON.PT", "input"},         {"TON.Q", "output"},
                          {"TON.ET", "output"},        {"Line.motors", "local"},
                          {"Line.sum", "local"},       {"Line.text", "local"},
                          {"main.big", "local"},       {"main.go", "external - shared"},
                          {"main.kept", "local"},      {"main.limit", "external - shared"},
                          {"main.line", "local"},      {"main.place", "local - shared"},
                          {"steps.n", "local"},        {"steps.rest", "local"},
                          {"steps.run", "local"},
                      }));
}

TEST(PlcInstanceTypes, Tasks_have_their_modules) {
  EXPECT_THAT(plan_of(kPlant).modules, ElementsAre("sut_fast", "sut_slow"));
  EXPECT_THAT(plan_of("PROGRAM main VAR n : INT; END_VAR n := 1; END_PROGRAM\n").modules, ElementsAre("sut"));
}

}  // namespace
}  // namespace indurop::plc
