// SPDX-License-Identifier: Apache-2.0
// What pointers and references may lead to.

#include <gmock/gmock.h>

#include <string>

#include "tests/unit/plc/front/compiled.h"

namespace indurop::plc {
namespace {

using ::testing::HasSubstr;
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

}  // namespace
}  // namespace indurop::plc
