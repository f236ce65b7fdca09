// SPDX-License-Identifier: Apache-2.0
// Programs that are small as text and huge as what they mean: each is compiled or refused at once, with a message.
// How long texts that grow take is counted in tests/unit/control/plc/growth.

#include <gmock/gmock.h>

#include <algorithm>
#include <string>

#include "control/plc/front/reader.h"
#include "control/plc/print/print.h"
#include "tests/unit/control/plc/front/compiled.h"
#include "tests/unit/control/plc/growth/growing_drawings.h"

namespace indurop::plc {
namespace {

using ::testing::HasSubstr;
using testing::wrong;

// The lines that `line` gives for each number below n, or above it, downwards.
template <class Line>
std::string lines(int n, Line line, bool downwards = false) {
  std::string out;
  for (int i = 1; i < n; ++i) {
    out += line(downwards ? n - i : i);
  }
  return out;
}

std::string n(int i) {
  return std::to_string(i);
}

constexpr const char* kMain = "PROGRAM Main VAR i : INT; END_VAR i := 1; END_PROGRAM\n";

TEST(PlcLimits, Structures_in_structures_are_limited_in_number_and_depth) {
  const auto nested = [](int levels, const std::string& fields) {
    return "TYPE S0 : STRUCT a, b, c, d : INT; END_STRUCT;\n" +
           lines(levels,
                 [&](int i) { return "S" + n(i) + " : STRUCT " + fields + " : S" + n(i - 1) + "; END_STRUCT;\n"; }) +
           "END_TYPE PROGRAM Main VAR x : S" + n(levels - 1) + "; END_VAR x := x; END_PROGRAM";
  };
  EXPECT_EQ(wrong(nested(6, "a, b, c, d")), "");
  EXPECT_EQ(wrong(nested(60, "a")), "");
  EXPECT_THAT(wrong(nested(14, "a, b, c, d")), HasSubstr("has more than 20000 fields with those of its inner"));
  EXPECT_THAT(wrong(nested(40, "a, b, c, d")), HasSubstr("has more than 20000 fields with those of its inner"));
  EXPECT_THAT(wrong(nested(3000, "a")), HasSubstr("structures and arrays more than 64 levels deep"));
  EXPECT_THAT(wrong(nested(12, "a : ARRAY[0..99] OF INT; b")), HasSubstr(""));
}

TEST(PlcLimits, Names_of_types_may_lead_to_each_other_as_often_as_they_like) {
  const auto chain = [](bool downwards) {
    return "TYPE " +
           lines(
               20000, [](int i) { return "T" + n(i) + " : T" + n(i - 1) + ";\n"; }, downwards) +
           "T0 : INT; END_TYPE PROGRAM Main VAR x : T19999; END_VAR x := 1; END_PROGRAM";
  };
  EXPECT_EQ(wrong(chain(false)), "");
  EXPECT_EQ(wrong(chain(true)), "");
}

TEST(PlcLimits, Function_blocks_extend_each_other_64_times_at_most) {
  const auto chain = [](int levels, bool downwards) {
    return "FUNCTION_BLOCK F0 VAR a0 : INT; END_VAR END_FUNCTION_BLOCK\n" +
           lines(
               levels,
               [](int i) {
                 return "FUNCTION_BLOCK F" + n(i) + " EXTENDS F" + n(i - 1) + " VAR a" + n(i) +
                        " : INT; END_VAR END_FUNCTION_BLOCK\n";
               },
               downwards) +
           "PROGRAM Main VAR f : F" + n(levels - 1) + "; END_VAR f(); END_PROGRAM";
  };
  for (const bool downwards : {false, true}) {
    EXPECT_EQ(wrong(chain(60, downwards)), "");
    EXPECT_THAT(wrong(chain(3000, downwards)), HasSubstr("is the last of more than 64 that extend each other"));
  }
}

TEST(PlcLimits, Structures_extend_each_other_64_times_at_most) {
  const auto chain = [](int levels, bool downwards) {
    return "TYPE S0 : STRUCT a0 : INT; END_STRUCT;\n" +
           lines(
               levels,
               [](int i) {
                 return "S" + n(i) + " EXTENDS S" + n(i - 1) + " : STRUCT a" + n(i) + " : INT; END_STRUCT;\n";
               },
               downwards) +
           "END_TYPE PROGRAM Main VAR x : S60; END_VAR x.a0 := 1; END_PROGRAM";
  };
  for (const bool downwards : {false, true}) {
    EXPECT_EQ(wrong(chain(65, downwards)), "");
    EXPECT_THAT(wrong(chain(3000, downwards)), HasSubstr("is the last of more than 64 structures that extend"));
  }
}

TEST(PlcLimits, Arrays_have_16_dimensions_at_most) {
  const auto array = [](int dimensions) {
    return "PROGRAM Main VAR a : ARRAY[0..0" + lines(dimensions, [](int) { return ", 0..0"; }) +
           "] OF INT; END_VAR END_PROGRAM";
  };
  EXPECT_EQ(wrong(array(16)), "");
  EXPECT_THAT(wrong(array(17)), HasSubstr("an ARRAY of 17 dimensions, at most 16 are possible"));
}

TEST(PlcLimits, Pointers_to_pointers_are_compared_once) {
  std::string types;
  for (const std::string one : {"A", "B"}) {
    types += one + "0 : POINTER TO INT;\n" +
             lines(60, [&](int i) { return one + n(i) + " : POINTER TO " + one + n(i - 1) + ";\n"; });
  }
  EXPECT_EQ(wrong("TYPE " + types + "END_TYPE PROGRAM Main VAR a : A59; b : B59; END_VAR a := b; END_PROGRAM"), "");
}

TEST(PlcLimits, A_diamond_of_interfaces_is_walked_once) {
  const std::string text =
      "INTERFACE I0 METHOD Go END_METHOD END_INTERFACE INTERFACE J0 END_INTERFACE\n" + lines(60, [](int i) {
        const std::string both = " EXTENDS I" + n(i - 1) + ", J" + n(i - 1) + " END_INTERFACE\n";
        return "INTERFACE I" + n(i) + both + "INTERFACE J" + n(i) + both;
      });
  EXPECT_EQ(wrong(text + "FUNCTION_BLOCK F IMPLEMENTS I59, J59 METHOD Go END_METHOD END_FUNCTION_BLOCK "
                         "PROGRAM Main VAR f : F; x : I0; END_VAR x := f; x.Go(); END_PROGRAM"),
            "");
}

TEST(PlcLimits, Instances_in_instances_are_limited_in_number_and_depth) {
  const auto nested = [](int levels, const std::string& variables) {
    return "FUNCTION_BLOCK F0 VAR_INPUT a : INT; END_VAR END_FUNCTION_BLOCK\n" +
           lines(levels,
                 [&](int i) {
                   return "FUNCTION_BLOCK F" + n(i) + " VAR " + variables + " : F" + n(i - 1) +
                          "; END_VAR END_FUNCTION_BLOCK\n";
                 }) +
           "PROGRAM Main VAR RETAIN f : F" + n(levels - 1) + "; END_VAR f(); END_PROGRAM";
  };
  EXPECT_EQ(wrong(nested(5, "a, b, c, d")), "");
  EXPECT_THAT(wrong(nested(30, "a, b, c, d")),
              HasSubstr("has more than 1000000 variables with those of the instances"));
  EXPECT_THAT(wrong(nested(500, "a")), HasSubstr("more than 64 instances lie inside each other"));
  EXPECT_THAT(wrong("PROGRAM Main VAR t : ARRAY[0..15000000] OF TON; END_VAR t[0](); END_PROGRAM"),
              HasSubstr("has more than 1000000 variables with those of the instances"));
  EXPECT_THAT(wrong("FUNCTION_BLOCK A VAR RETAIN x : A; END_VAR END_FUNCTION_BLOCK " + std::string(kMain)),
              HasSubstr("recursion is not possible: A -> A"));
}

TEST(PlcLimits, Initial_values_are_not_written_out_where_they_are_all_alike) {
  const auto array = [](const std::string& values, const std::string& type = "INT") {
    return "PROGRAM Main VAR a : ARRAY[0..15000000] OF " + type + " := [" + values +
           "]; END_VAR a[0] := 1; END_PROGRAM";
  };
  EXPECT_EQ(wrong(array("15000001(5)")), "");
  EXPECT_EQ(wrong(array("5")), "");
  EXPECT_EQ(wrong(array("1, 2, 3(0)")), "");
  EXPECT_THAT(wrong(array("7000000(5), 8000000(6)")), HasSubstr("more than 1000000 initial values"));
  EXPECT_THAT(wrong(array("2000000000(5)")), HasSubstr("values for 15000001 elements"));
  EXPECT_THAT(wrong(array("9000000000000000000(1), 9000000000000000000(1), 9000000000000000000(1)")),
              HasSubstr("values for 15000001 elements"));
  EXPECT_THAT(wrong(array("2(6)", "INT (5..9)")), HasSubstr("more than 1000000 initial values"));
}

TEST(PlcLimits, Written_values_of_arrays_are_as_long_as_the_list) {
  const Compiled sut = testing::compiled(
      "VAR_GLOBAL a : ARRAY[0..9, 0..1] OF INT := [1, 2, 3(4)]; b : ARRAY[0..99] OF INT := [100(7)]; END_VAR "
      "PROGRAM Main a[0, 0] := b[0]; END_PROGRAM");
  ASSERT_TRUE(sut.ok) << testing::messages(sut);
  EXPECT_THAT(sut.glb, HasSubstr("a[10][2] = {{1, 2}, {4, 4}, {4}};"));
}

TEST(PlcLimits, Calls_in_calls_are_checked_once) {
  const auto inside = [](const std::string& before, const std::string& middle) {
    std::string out;
    std::string end;
    for (int i = 0; i < 40; ++i) {
      out += before;
      end += ")";
    }
    return out + middle + end + ";";
  };
  const std::string head =
      "FUNCTION G : ANY_NUM VAR_INPUT x : ANY_NUM; END_VAR G := x; END_FUNCTION "
      "FUNCTION_BLOCK F METHOD M : INT VAR_INPUT x : INT; END_VAR M := x; END_METHOD END_FUNCTION_BLOCK "
      "PROGRAM Main VAR i : INT; b : BOOL; f : F; END_VAR i := ";
  for (const std::string& call :
       {inside("G(", "i"), inside("G(", "1"), inside("f.M(", "i"), inside("MAX(1, ", "2"), inside("SEL(b, 1, ", "i")}) {
    EXPECT_EQ(wrong(head + call + " END_PROGRAM"), "") << call.substr(0, 12);
  }
}

// Found by mutating texts: the call was checked a second time, when it knew inputs that no call gives.
TEST(PlcLimits, A_call_that_is_checked_twice_gives_the_same_result) {
  EXPECT_THAT(wrong("FUNCTION half:REAL VAR_INPUT ratio END_WHILE ratio:=half(); END_VAR END_FUNCTION"),
              HasSubstr("error"));
  EXPECT_THAT(wrong("FUNCTION half : REAL VAR_INPUT ratio : REAL := half(); END_VAR half := ratio; END_FUNCTION " +
                    std::string(kMain)),
              HasSubstr("error"));
}

TEST(PlcLimits, A_list_and_a_drawing_may_be_as_long_as_they_like) {
  std::string list = "PROGRAM Main VAR i : INT; END_VAR\nLD i\n";
  for (int i = 0; i < 20000; ++i) {
    list += "ADD 1\n";
  }
  EXPECT_EQ(wrong(list + "ST i\nEND_PROGRAM\n"), "");
}

TEST(PlcLimits, A_variable_may_be_the_action_of_any_number_of_steps) {
  const std::string steps = lines(20000, [](int i) { return "STEP S" + n(i) + ": b(N); END_STEP\n"; }) +
                            "TRANSITION FROM S0 TO (S1" +
                            lines(20000, [](int i) { return i < 2 ? "" : ", S" + n(i); }) + ") := b; END_TRANSITION\n";
  EXPECT_EQ(wrong("PROGRAM Main VAR b : BOOL; END_VAR INITIAL_STEP S0: END_STEP\n" + steps + "END_PROGRAM"), "");
}

std::string printed(const std::string& drawing) {
  Diagnostics diagnostics;
  const auto read = [&](const std::string& name) { return glb2idl::ReadResult{drawing, name, ""}; };
  plcopen::Document document = read_document({"in.xml"}, {}, read, diagnostics);
  const std::string text = print_text(printed_bodies(document, ""), true, diagnostics);
  return diagnostics.failed() ? base::to_text(diagnostics.list()) : text;
}

TEST(PlcLimits, An_operand_of_many_blocks_has_one_wire_to_all_of_them) {
  const std::string text = printed(testing::blocks_in_series(300));
  EXPECT_LT(std::count(text.begin(), text.end(), '\n'), 15) << text.substr(0, 2000);
}

TEST(PlcLimits, Drawings_have_pictures_of_4000000_characters_and_50000_pieces_of_wire_at_most) {
  EXPECT_THAT(printed(testing::blocks_far_apart(100)).substr(0, 300), HasSubstr("ADD"));
  EXPECT_THAT(
      printed(testing::blocks_far_apart(300)).substr(0, 300),
      HasSubstr("in.xml:3:1: error: POU main, network 1, input variable n: too large for a picture: the lines"));
  EXPECT_THAT(printed(testing::rungs_wide(800)).substr(0, 300),
              HasSubstr("POU main: too large for a picture: it has more than 4000000 characters; split it"));
}

}  // namespace
}  // namespace indurop::plc
