// SPDX-License-Identifier: Apache-2.0
// What belongs to a call has to fit on the stack of the thread that runs the module.
#include <gmock/gmock.h>

#include "tests/unit/control/plc/front/compiled.h"

namespace indurop::plc {
namespace {

using ::testing::HasSubstr;
using testing::wrong;

constexpr const char* kBig = "TYPE Big : STRUCT list : ARRAY[1..131072] OF DINT; END_STRUCT; END_TYPE\n";
constexpr const char* kStackMain =
    "PROGRAM Main VAR b : Big; i : DINT; END_VAR i := i + 1; b.list[1] := i; END_PROGRAM\n";

std::string with(const std::string& more) {
  return std::string(kBig) + more + kStackMain;
}

TEST(PlcStack, Variables_of_programs_may_be_large) {
  EXPECT_EQ(wrong(with("")), "");
}

TEST(PlcStack, A_result_that_does_not_fit_is_refused_with_what_to_do) {
  const std::string said = wrong(with("FUNCTION F : Big F.list[1] := 1; END_FUNCTION\n"));
  EXPECT_THAT(said, HasSubstr("in.st:2:10: error: a call of F needs 524288 bytes of the stack, at most 131072 are "
                              "possible; its result has 524288; declare large variables in VAR_GLOBAL"));
}

TEST(PlcStack, Inputs_locals_and_temporary_variables_count) {
  EXPECT_THAT(wrong(with("FUNCTION F : INT VAR_INPUT b : Big; END_VAR F := 1; END_FUNCTION\n")),
              HasSubstr("'b' has 524288"));
  EXPECT_THAT(wrong(with("FUNCTION F : INT VAR b : Big; END_VAR b.list[1] := 1; F := 1; END_FUNCTION\n")),
              HasSubstr("'b' has 524288"));
  EXPECT_THAT(wrong(with("FUNCTION_BLOCK F VAR_TEMP b : Big; END_VAR b.list[1] := 1; END_FUNCTION_BLOCK\n")),
              HasSubstr("'b' has 524288"));
  EXPECT_EQ(wrong(with("FUNCTION F : INT VAR_IN_OUT b : Big; END_VAR b.list[1] := 1; F := 1; END_FUNCTION\n")), "");
  EXPECT_EQ(wrong(with("FUNCTION_BLOCK F VAR b : Big; END_VAR b.list[1] := 1; END_FUNCTION_BLOCK\n")), "");
}

TEST(PlcStack, Calls_inside_each_other_add_up) {
  const std::string said =
      wrong(with("FUNCTION F : INT VAR a : ARRAY[1..90000] OF BYTE; END_VAR a[1] := 1; F := 1; END_FUNCTION\n"
                 "FUNCTION G : INT VAR a : ARRAY[1..50000] OF BYTE; END_VAR a[1] := 1; G := F(); END_FUNCTION\n"));
  EXPECT_THAT(said, HasSubstr("a call of G needs 140004 bytes"));
  EXPECT_THAT(said, HasSubstr("F, which it calls, has 90002"));
}

}  // namespace
}  // namespace indurop::plc
