// SPDX-License-Identifier: Apache-2.0
// What pointers and references may lead to.

#include <gmock/gmock.h>

#include <string>

#include "tests/unit/control/plc/front/compiled.h"

namespace indurop::plc {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using testing::wrong;

TEST(PlcPointers, A_pointer_leads_to_a_subrange_only_if_it_has_its_limits) {
  const auto pointing = [](const std::string& code) {
    return "TYPE Percent : INT (0..100); END_TYPE\n"
           "TYPE Small : INT (0..50); END_TYPE\n"
           "FUNCTION Far : INT VAR_INPUT q : REF_TO INT; END_VAR q^ := 500; Far := q^; END_FUNCTION\n"
           "PROGRAM Main\nVAR p : Percent; i : INT; b : ARRAY[1..3] OF Percent; q : REF_TO INT; r : REFERENCE TO INT;\n"
           "k : POINTER TO INT; c : POINTER TO ARRAY[1..3] OF INT; w : POINTER TO POINTER TO INT; mine : REF_TO "
           "Percent;\n"
           "s : REFERENCE TO Small; bytes : POINTER TO BYTE; own : POINTER TO Percent; END_VAR\n" +
           code + "\nEND_PROGRAM\n";
  };
  for (const char* code : {"q := REF(p);", "r REF= p;", "k := ADR(p);", "c := ADR(b);", "w := ADR(own);", "q := mine;",
                           "k := own;", "mine := REF(i);", "s REF= p;", "i := Far(REF(p));", "i := Far(mine);"}) {
    EXPECT_THAT(wrong(pointing(code)), HasSubstr("have other limits, so a value could be written that is none of them"))
        << code;
  }
  EXPECT_EQ(wrong(pointing("mine := REF(p); own := ADR(b[2]); q := REF(i); bytes := ADR(p); mine^ := i; i := own^;")),
            "");
}

TEST(PlcPointers, What_outlives_a_call_is_not_led_to_its_variables) {
  const auto keeping = [](const std::string& code) {
    return "INTERFACE IOne METHOD Go END_METHOD END_INTERFACE\n"
           "FUNCTION_BLOCK One IMPLEMENTS IOne METHOD Go END_METHOD END_FUNCTION_BLOCK\n"
           "TYPE Box : STRUCT p : POINTER TO INT; END_STRUCT END_TYPE\n"
           "FUNCTION_BLOCK Keeper\n"
           "VAR p : POINTER TO INT; r : REFERENCE TO INT; box : Box; one : IOne; mine : INT; own : One; END_VAR\n"
           "METHOD Keep : POINTER TO INT\nVAR_IN_OUT given : INT; END_VAR VAR_INPUT n : INT; END_VAR\n"
           "VAR x : INT; q : POINTER TO INT; list : ARRAY[1..2] OF POINTER TO INT; seen : IOne; "
           "END_VAR\n" +
           code + "\nEND_METHOD\nEND_FUNCTION_BLOCK\nPROGRAM Main VAR k : Keeper; END_VAR END_PROGRAM\n";
  };
  const std::string text = "is gone when the call is over";
  for (const char* code :
       {"p := ADR(x);", "p := ADR(n);", "r REF= x;", "box.p := ADR(x);", "Keep := ADR(x);", "p := REF(x);"}) {
    EXPECT_THAT(testing::messages(testing::compiled(keeping(code))), HasSubstr(text)) << code;
  }
  for (const char* code : {"q := ADR(x);", "list[1] := ADR(x);", "p := ADR(mine);", "p := ADR(given);",
                           "Keep := ADR(mine);", "p := q;", "p := ADR(box.p^);", "r REF= mine;"}) {
    EXPECT_EQ(wrong(keeping(code)), "") << code;
    EXPECT_THAT(testing::messages(testing::compiled(keeping(code))), Not(HasSubstr(text))) << code;
  }
  const std::string brief =
      keeping("one := brief;").replace(keeping("").find("VAR x : INT;"), 3, "VAR_TEMP brief : One; END_VAR VAR");
  EXPECT_THAT(wrong(brief), HasSubstr("this instance is gone when the call is over"));
  EXPECT_EQ(wrong(keeping("one := own; seen := own;")), "");
}

}  // namespace
}  // namespace indurop::plc
