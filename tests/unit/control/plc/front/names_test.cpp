// SPDX-License-Identifier: Apache-2.0
// Names and comments of a PLCopen file may hold anything. What is written from them is only ever a name or a comment.

#include <gmock/gmock.h>

#include "tests/unit/control/plc/front/compiled.h"

namespace indurop::plc {
namespace {

using testing::compiled;
using ::testing::HasSubstr;
using testing::messages;
using ::testing::Not;
using testing::written;
using testing::wrong;

constexpr const char* kEvil = "a{}; int b";

// A project with one variable of a type of its own, drawn as -| v |---( coil )-. Each name can be another one.
struct Names {
  std::string type = "Mode";
  std::string value = "Off";
  std::string field_type = "Pair";
  std::string field = "left";
  std::string pou = "Main";
  std::string variable = "v";
  std::string coil = "v";
  std::string label = "Again";
  std::string task = "fast";
  std::string instance = "one";
  std::string comment = "nothing";
};

std::string project(const Names& names) {
  return R"(<project xmlns="http://www.plcopen.org/xml/tc6_0201"><types><dataTypes><dataType name=")" + names.type +
         R"("><baseType><enum><values><value name=")" + names.value +
         R"("/></values></enum></baseType></dataType><dataType name=")" + names.field_type +
         R"("><baseType><struct><variable name=")" + names.field +
         R"("><type><INT/></type></variable></struct></baseType></dataType></dataTypes><pous><pou name=")" + names.pou +
         R"(" pouType="program"><interface><localVars><variable name=")" + names.variable +
         R"("><type><BOOL/></type><documentation><p>)" + names.comment +
         R"(</p></documentation></variable></localVars></interface><body><LD><leftPowerRail localId="1"/>)" +
         R"(<contact localId="2"><connectionPointIn><connection refLocalId="1"/></connectionPointIn>)" +
         "<variable>TRUE</variable></contact>" +
         R"(<coil localId="3"><connectionPointIn><connection refLocalId="2"/></connectionPointIn><variable>)" +
         names.coil + R"(</variable></coil><label localId="4" label=")" + names.label +
         R"("/></LD></body></pou></pous></types><instances><configurations><configuration name="Device 1">)" +
         R"(<resource name="Plc Logic"><task name=")" + names.task +
         R"(" interval="T#10ms" priority="1"><pouInstance name=")" + names.instance + R"(" typeName=")" + names.pou +
         R"("/></task></resource></configuration></configurations></instances></project>)";
}

TEST(PlcNames, Ordinary_names_compile) {
  EXPECT_EQ(wrong(project({}), "in.xml"), "");
}

TEST(PlcNames, Only_names_become_names_of_the_generated_code) {
  for (std::string Names::*const one : {&Names::type, &Names::value, &Names::field_type, &Names::field, &Names::pou,
                                        &Names::variable, &Names::label, &Names::task, &Names::instance}) {
    Names names;
    names.*one = kEvil;
    EXPECT_THAT(wrong(project(names), "in.xml"), HasSubstr("'a{}; int b' is no name; use letters, digits and '_'"))
        << names.type << names.value << names.field_type << names.field << names.pou << names.variable << names.label
        << names.task << names.instance;
  }
}

TEST(PlcNames, A_task_is_no_path) {
  Names names;
  names.task = "../../evil";
  EXPECT_THAT(wrong(project(names), "in.xml"), HasSubstr("error: task ../../evil: '../../evil' is no name"));
}

TEST(PlcNames, Words_of_the_language_are_no_names) {
  Names names;
  names.variable = "End_If";
  names.coil = "v";
  EXPECT_THAT(wrong(project(names), "in.xml"), HasSubstr("'End_If' is a word of the language and cannot be a name"));
}

TEST(PlcNames, A_coil_is_a_variable) {
  for (const char* coil : {"v OR v", "NOT v", "v = v", "TRUE", "ABS(1) = 1"}) {
    Names names;
    names.coil = coil;
    EXPECT_THAT(wrong(project(names), "in.xml"), HasSubstr("this is not a variable, so nothing can be assigned to it"))
        << coil;
  }
}

TEST(PlcNames, An_expression_cannot_be_a_VAR_IN_OUT) {
  EXPECT_THAT(wrong("FUNCTION_BLOCK F VAR_IN_OUT x : INT; END_VAR x := x + 1; END_FUNCTION_BLOCK\n"
                    "PROGRAM Main VAR f1 : F; a : INT; END_VAR f1(x := a + 1); END_PROGRAM"),
              HasSubstr("this is not a variable"));
}

TEST(PlcNames, A_comment_ends_with_its_line) {
  Names names;
  names.comment = "unix \\ \t\n#error out\\";
  const Compiled program = testing::compiled(project(names), "in.xml");
  ASSERT_TRUE(program.ok) << testing::messages(program);
  EXPECT_THAT(testing::written(program), Not(HasSubstr("\\ \n")));
  EXPECT_THAT(testing::written(program), Not(HasSubstr("\n#error")));
}

TEST(PlcNames, The_name_of_a_file_ends_with_its_line) {
  const Compiled program =
      testing::compiled("PROGRAM Main VAR a : INT; END_VAR a := 1; END_PROGRAM", "in\n#error\n.st");
  ASSERT_TRUE(program.ok) << testing::messages(program);
  EXPECT_THAT(testing::written(program), Not(HasSubstr("\n#error")));
}

TEST(PlcNames, Two_resources_may_have_a_task_and_an_instance_of_the_same_name) {
  const std::string resource =
      " ON pc TASK t (INTERVAL := T#1ms, PRIORITY := 1); PROGRAM p WITH t : Main; END_RESOURCE ";
  const Compiled sut =
      compiled("PROGRAM Main VAR a : INT; END_VAR a := a + 1; END_PROGRAM CONFIGURATION c RESOURCE one" + resource +
               "RESOURCE two" + resource + "END_CONFIGURATION");
  ASSERT_TRUE(sut.ok) << messages(sut);
  ASSERT_EQ(sut.modules.size(), 2U);
  EXPECT_EQ(sut.modules[0].name, "sut_one_t");
  EXPECT_EQ(sut.modules[1].name, "sut_two_t");
}

// Else the field of the variable would be taken: silently, where the types are the same.
TEST(PlcNames, What_is_in_a_namespace_is_not_hidden_by_a_variable_of_the_same_name) {
  const std::string text =
      "NAMESPACE Lib.Math TYPE C : (A, B); END_TYPE END_NAMESPACE TYPE S : STRUCT B : INT := 42; END_STRUCT; END_TYPE "
      "PROGRAM Main VAR C : S; x : INT; y : Lib.Math.C; END_VAR x := C.B; ";
  for (const char* value : {"Lib.Math.C.B", "Lib.Math.C#B"}) {
    const Compiled sut = compiled(text + "y := " + value + "; END_PROGRAM");
    EXPECT_TRUE(sut.ok) << messages(sut);
    EXPECT_THAT(written(sut), HasSubstr("y = plc::C::B;"));
    EXPECT_THAT(wrong(text + "x := " + value + "; END_PROGRAM"), HasSubstr("a C is not an INT"));
  }
  EXPECT_THAT(wrong("NAMESPACE Lib FUNCTION F : INT F := 1; END_FUNCTION END_NAMESPACE "
                    "PROGRAM Main VAR F : TON; x : INT; END_VAR F(); x := Lib.F(); END_PROGRAM"),
              HasSubstr("'Lib.F' and the variable 'F' cannot be distinguished here"));
}

}  // namespace
}  // namespace indurop::plc
