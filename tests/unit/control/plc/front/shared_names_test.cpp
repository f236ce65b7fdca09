// SPDX-License-Identifier: Apache-2.0
// Names of a program that mean something in C++ or IDL: the program keeps them, what others see is called otherwise.

#include <gmock/gmock.h>

#include "tests/unit/control/plc/front/compiled.h"

namespace indurop::plc {
namespace {

using testing::compiled;
using ::testing::HasSubstr;
using testing::messages;
using ::testing::Not;

TEST(PlcSharedNames, A_global_that_is_a_keyword_is_shared_under_another_name) {
  const Compiled sut = compiled(
      "VAR_GLOBAL new : BOOL; _x : INT; a__b : INT; end_1 : INT; speed : INT; END_VAR\n"
      "PROGRAM Main\nnew := TRUE; _x := 1; a__b := 2; end_1 := 3; speed := 4;\nEND_PROGRAM\n");
  ASSERT_TRUE(sut.ok) << messages(sut);
  EXPECT_THAT(sut.glb, HasSubstr("bool new_value;\nint16_t x;\nint16_t a_b;\nint16_t end_1;\nint16_t speed;\n"));
  EXPECT_THAT(messages(sut), HasSubstr("in.st:1:12: warning: 'new' has another meaning in C++ or IDL, so modules and "
                                       "tools see it as sut::new_value"));
  EXPECT_THAT(messages(sut), Not(HasSubstr("'speed'")));
}

TEST(PlcSharedNames, Two_variables_do_not_get_one_name) {
  const Compiled sut = compiled(
      "VAR_GLOBAL x : BOOL; _x : INT; a__b : INT; a_b : INT; END_VAR\n"
      "PROGRAM Main\nx := TRUE; _x := 1; a__b := 2; a_b := 3;\nEND_PROGRAM\n");
  ASSERT_TRUE(sut.ok) << messages(sut);
  EXPECT_THAT(sut.glb, HasSubstr("bool x;\nint16_t x_value;\nint16_t a_b;\nint16_t a_b_value;\n"));
}

TEST(PlcSharedNames, Types_fields_and_values_may_have_any_name) {
  const Compiled sut = compiled(
      "TYPE Motor : STRUCT motor : INT; new : INT; new_value : INT; get : BOOL; Kind : INT; END_STRUCT;\n"
      "union : STRUCT a : INT; END_STRUCT; Kind : (off, switch); END_TYPE\n"
      "VAR_GLOBAL m : Motor; u : union; k : Kind := switch; END_VAR\n"
      "PROGRAM Main\nm.MOTOR := 1; m.new := m.new_value; m.get := TRUE; m.Kind := 1; u.a := 2; k := "
      "switch;\nEND_PROGRAM\n");
  ASSERT_TRUE(sut.ok) << messages(sut);
  EXPECT_THAT(sut.glb, HasSubstr("  int16_t motor_value;\n  int16_t new_value_value;\n  int16_t new_value;\n"
                                 "  bool get_value;\n  int16_t Kind_value;\n"));
  EXPECT_THAT(sut.glb, HasSubstr("struct union_type {"));
  EXPECT_THAT(sut.glb, HasSubstr("enum Kind { off, switch_state };"));
  EXPECT_THAT(sut.modules.at(0).cpp, HasSubstr("shared.m.motor_value = 1;"));
  EXPECT_THAT(sut.modules.at(0).cpp,
              HasSubstr("iec::write_changed(::sut::m.new_value_value, shared.m.new_value_value, "));
}

TEST(PlcSharedNames, A_file_may_be_named_like_a_word_of_CXX) {
  for (const auto& [file, space] : {std::pair("enum.st", "enum_space"), std::pair("std.st", "std_space"),
                                    std::pair("main.st", "plc"), std::pair("motor.st", "motor")}) {
    CompileOptions options;
    options.files = {file};
    const Compiled sut = compile(options, [&](const std::string& name) {
      return glb2idl::ReadResult{"VAR_GLOBAL x : BOOL; END_VAR PROGRAM P x := TRUE; END_PROGRAM", name, ""};
    });
    ASSERT_TRUE(sut.ok) << messages(sut);
    EXPECT_THAT(sut.glb, HasSubstr(std::string("namespace ") + space + ";"));
  }
}

}  // namespace
}  // namespace indurop::plc
