// SPDX-License-Identifier: Apache-2.0
// Instruction lists: the input operators of the standard function blocks (IEC 61131-3, Tables 53 no. 3 and 54), which
// are a CAL with that one input, and what is computed and stored nowhere.

#include <gmock/gmock.h>

#include "tests/unit/control/plc/front/compiled.h"

namespace indurop::plc {
namespace {

using testing::compiled;
using ::testing::HasSubstr;
using testing::messages;
using testing::wrong;

struct Input {
  const char* block;
  const char* type;  // of what is loaded
  const char* word;
  const char* member;  // of the block in C++
};

std::string list(const std::string& block, const std::string& type, const std::string& code) {
  return "PROGRAM Main\nVAR fb : " + block + "; a : " + type + "; b : BOOL; END_VAR\n" + code + "\nEND_PROGRAM\n";
}

TEST(PlcList, Each_input_operator_is_a_call_with_that_input) {
  for (const Input& one : {Input{"SR", "BOOL", "S1", "s1"},
                           {"SR", "BOOL", "R", "r"},
                           {"RS", "BOOL", "S", "s"},
                           {"RS", "BOOL", "R1", "r1"},
                           {"R_TRIG", "BOOL", "CLK", "clk"},
                           {"F_TRIG", "BOOL", "CLK", "clk"},
                           {"CTU", "BOOL", "CU", "cu"},
                           {"CTU", "BOOL", "R", "r"},
                           {"CTU", "INT", "PV", "pv"},
                           {"CTD", "BOOL", "CD", "cd"},
                           {"CTD", "BOOL", "LD", "ld"},
                           {"CTD", "INT", "PV", "pv"},
                           {"CTUD", "BOOL", "LD", "ld"},
                           {"CTUD", "BOOL", "R", "r"},
                           {"TP", "BOOL", "IN", "in"},
                           {"TON", "TIME", "PT", "pt"},
                           {"TOF", "BOOL", "IN", "in"}}) {
    const std::string code = std::string("LD a\n") + one.word + " fb\n";
    const Compiled sut = compiled(list(one.block, one.type, code));
    ASSERT_TRUE(sut.ok) << messages(sut);
    EXPECT_THAT(sut.modules.at(0).cpp, HasSubstr(std::string("fb.") + one.member + " = a;\n  fb(scan);")) << code;
  }
}

TEST(PlcList, The_same_words_in_front_of_other_variables_are_set_reset_and_load) {
  const Compiled sut = compiled(list("CTU", "BOOL", "LD a\nS b\nR a\nLD b\nST a"));
  ASSERT_TRUE(sut.ok) << messages(sut);
  EXPECT_THAT(sut.modules.at(0).cpp, HasSubstr("b = true;"));
  EXPECT_THAT(sut.modules.at(0).cpp, HasSubstr("a = false;"));
  EXPECT_THAT(sut.modules.at(0).cpp, HasSubstr("a = b;"));
}

TEST(PlcList, An_input_that_the_block_has_not_is_an_error) {
  EXPECT_THAT(wrong(list("TON", "BOOL", "LD a\nCU fb")), HasSubstr("error: Main: there is no function 'CU'"));
  EXPECT_THAT(wrong(list("CTU", "BOOL", "LD a\nCU b")), HasSubstr("there is no function 'CU'"));
}

TEST(PlcList, What_is_computed_and_not_stored_is_checked) {
  EXPECT_THAT(wrong(list("TON", "BOOL", "LD a\nFOO b")), HasSubstr("there is no function 'FOO'"));
  EXPECT_THAT(wrong(list("TON", "BOOL", "LD a\nFOO b\nLD b\nST a")), HasSubstr("there is no function 'FOO'"));
  EXPECT_THAT(wrong(list("TON", "BOOL", "LD nowhere\nLD b\nST a")), HasSubstr("'nowhere' is not declared"));
  EXPECT_THAT(wrong(list("TON", "BOOL", "LD a\nFOO b\nx: LD b\nST a")), HasSubstr("there is no function 'FOO'"));
}

TEST(PlcList, A_call_does_not_change_what_was_loaded_before) {
  const Compiled sut =
      compiled("PROGRAM Main VAR t : TON; x, y, z : BOOL; END_VAR\nLD t.Q\nCAL t(IN := x)\nAND y\nST z\nEND_PROGRAM");
  ASSERT_TRUE(sut.ok) << messages(sut);
  const std::string cpp = testing::written(sut);
  ASSERT_NE(cpp.find("_il1 = t.q;"), std::string::npos) << cpp;
  EXPECT_LT(cpp.find("_il1 = t.q;"), cpp.find("t(scan"));
}

TEST(PlcList, An_error_stands_at_the_operator) {
  EXPECT_THAT(wrong(list("TON", "INT", "LD a\nADD b\nST a")), HasSubstr("in.st:4:1: error: Main: ADD does not take"));
  EXPECT_THAT(wrong(list("TON", "INT", "LD a\nADD 1\nAND b\nST a")),
              HasSubstr("in.st:5:1: error: Main: AND, OR and XOR"));
}

TEST(PlcList, A_formal_call_may_come_first) {
  EXPECT_EQ(wrong(list("TON", "INT", "LIMIT(MN := 0, IN := a, MX := 5)\nST a")), "");
  EXPECT_EQ(wrong(list("TON", "INT", "LIMIT(\n  MN := 0,\n  IN := a,\n  MX := 5\n)\nADD 1\nST a")), "");
  EXPECT_EQ(wrong(list("TON", "INT", "fb(IN := b);\nIF b THEN a := 1; END_IF;")), "");
}

}  // namespace
}  // namespace indurop::plc
