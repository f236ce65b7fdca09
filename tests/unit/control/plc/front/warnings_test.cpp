// SPDX-License-Identifier: Apache-2.0
// What compiles and is seldom meant.

#include <gmock/gmock.h>

#include "tests/unit/control/plc/front/compiled.h"

namespace indurop::plc {
namespace {

using testing::compiled;
using ::testing::HasSubstr;
using testing::messages;
using ::testing::Not;

std::string warnings(const std::string& text, const std::string& file = "in.st") {
  const Compiled sut = compiled(text, file);
  return (sut.ok ? "" : "it does not compile: ") + messages(sut);
}

constexpr const char* kBlock =
    "FUNCTION_BLOCK Valve VAR_INPUT on : BOOL; END_VAR VAR_OUTPUT open, closed : BOOL; END_VAR VAR_IN_OUT n : INT; "
    "END_VAR\n"
    "open := on; n := n + 1;\nEND_FUNCTION_BLOCK\n";

TEST(PlcWarnings, A_text_that_grows_beyond_its_length_in_UTF8) {
  const std::string head = "PROGRAM Main VAR s : STRING[5]; END_VAR\n";
  EXPECT_THAT(warnings(head + "s := 'Mot\xf6r'; END_PROGRAM"),  // Latin-1
              HasSubstr("the text has 5 letters, which are 6 characters of a STRING (UTF-8), and is cut to 5; use "
                        "STRING[6], or WSTRING"));
  EXPECT_THAT(warnings(head + "s := 'Motors'; END_PROGRAM"), HasSubstr("the text has 6 characters and is cut to 5"));
  EXPECT_THAT(warnings(head + "s := 'Mot\xf6'; END_PROGRAM"), Not(HasSubstr("cut")));
}

TEST(PlcWarnings, Dates_reach_from_1677_to_2262) {
  const std::string head = "PROGRAM Main VAR d : DATE; t : DT; END_VAR\n";
  EXPECT_THAT(warnings(head + "d := D#1677-09-22; d := D#2262-04-11; t := DT#2262-04-11-23:47:16; END_PROGRAM"),
              Not(HasSubstr("error")));
  EXPECT_THAT(warnings(head + "d := D#1677-09-21; END_PROGRAM"),
              HasSubstr("write a day from 1677-09-22 to 2262-04-11"));
  EXPECT_THAT(warnings(head + "d := D#2262-04-12; END_PROGRAM"),
              HasSubstr("write a day from 1677-09-22 to 2262-04-11"));
  EXPECT_THAT(warnings(head + "t := DT#2262-04-11-23:47:17; END_PROGRAM"),
              HasSubstr("it is after 2262-04-11-23:47:16.8"));
}

TEST(PlcWarnings, An_output_that_is_never_written) {
  const std::string all =
      warnings(std::string(kBlock) + "PROGRAM Main VAR v : Valve; i : INT; END_VAR v(on := TRUE, n := i); END_PROGRAM");
  EXPECT_THAT(all, HasSubstr("warning: Valve: the output 'closed' is never written"));
  EXPECT_THAT(all, Not(HasSubstr("'open'")));
}

TEST(PlcWarnings, An_instance_that_is_never_called) {
  const std::string head =
      std::string(kBlock) +
      "FUNCTION_BLOCK User VAR_IN_OUT t : TON; END_VAR t(IN := TRUE, PT := T#1s); END_FUNCTION_BLOCK\n"
      "PROGRAM Main VAR v : Valve; t : TON; u : User; a : ARRAY[1..2] OF TON; b : BOOL; i : INT; END_VAR\n";
  const std::string none = warnings(head + "b := v.open; b := t.Q; b := a[1].Q; u(t := t); END_PROGRAM");
  EXPECT_THAT(none, HasSubstr("'v' is never called, so its outputs never change; call it: v(...);"));
  EXPECT_THAT(none, HasSubstr("'a' is never called"));
  EXPECT_THAT(none, Not(HasSubstr("'t' is never called"))) << "it is passed to u, which calls it";
  const std::string all = warnings(head + "v(n := i); u(t := t); a[i](IN := v.open); END_PROGRAM");
  EXPECT_THAT(all, Not(HasSubstr("never called")));
}

TEST(PlcWarnings, What_is_read_from_outside_only_is_used) {
  CompileOptions options;
  options.files = {"in.st"};
  options.name = "sut";
  options.dialect = Dialect::Codesys;
  const std::string text =
      "FUNCTION_BLOCK F VAR CONSTANT most : INT := 9; least : INT := 1; END_VAR VAR n : INT; END_VAR\n"
      "n := n + 1; END_FUNCTION_BLOCK\n"
      "PROGRAM Main VAR f : F; i : INT; END_VAR f(); i := f.most; END_PROGRAM";
  const Compiled sut = compile(options, [&](const std::string& name) { return glb2idl::ReadResult{text, name, ""}; });
  ASSERT_TRUE(sut.ok) << messages(sut);
  EXPECT_THAT(messages(sut), HasSubstr("'least' is never used"));
  EXPECT_THAT(messages(sut), Not(HasSubstr("'most'")));
}

TEST(PlcWarnings, Two_REALs_that_are_compared_exactly) {
  const std::string head = "PROGRAM Main VAR x, y : REAL; z : LREAL; b : BOOL; i : INT; END_VAR\n";
  EXPECT_THAT(warnings(head + "b := x = y; END_PROGRAM"),
              HasSubstr("two REAL are seldom exactly equal, compare ABS(a - b)"));
  EXPECT_THAT(warnings(head + "b := z <> x * y; END_PROGRAM"), HasSubstr("two LREAL are seldom exactly equal"));
  EXPECT_THAT(warnings(head + "b := x < y OR x = 0.0 OR x <> 2.5 OR i = 3; END_PROGRAM"),
              Not(HasSubstr("exactly equal")));
  for (const char* text :
       {"b := x = 0.1;", "b := EQ(x, y);", "b := NE(z, 3.3);", "b := ABS(x) <> 3.3;", "b := EQ(x, 0.1);"}) {
    EXPECT_THAT(warnings(head + text + " END_PROGRAM"), HasSubstr("seldom exactly equal")) << text;
  }
  EXPECT_THAT(warnings(head + "b := EQ(i, 3) OR EQ(x, 1.0) OR NE(z, 0.0) OR GT(x, y); END_PROGRAM"),
              Not(HasSubstr("exactly equal")));
}

TEST(PlcWarnings, A_division_of_whole_numbers_where_a_REAL_is_wanted) {
  const std::string head = "PROGRAM Main VAR x : REAL; i : INT; b : BOOL; END_VAR ";
  EXPECT_THAT(warnings(head + "x := (1/2) * x; END_PROGRAM"), HasSubstr("1 / 2 is 0, a division of whole numbers"));
  for (const char* text : {"x := DIV(1, 2) * x;", "x := MAX(1, 2) / MAX(3, 4) * x;"}) {
    EXPECT_THAT(warnings(head + text + " END_PROGRAM"),
                HasSubstr("this division of whole numbers becomes one of REAL, because that is wanted"))
        << text;
  }
  EXPECT_EQ(warnings(head + "i := DIV(7, 2) + 7 / 2; x := 7.0 / 2 * x; b := x > 0.5; b := DIV(7, 2) = 3; END_PROGRAM"),
            "");
}

TEST(PlcWarnings, Whole_numbers_that_lose_something_before_they_become_more) {
  const std::string head = "PROGRAM Main VAR x : REAL; i, n : INT; d : DINT; l : LINT; u : UINT; END_VAR ";
  const auto of = [&](const std::string& text) { return warnings(head + text + " END_PROGRAM"); };
  for (const char* text : {"x := i / 2;", "x := -(i / n) + 1;", "x := INT_TO_REAL(n) + i / 2; x := i / n * 2;"}) {
    EXPECT_THAT(of(text), HasSubstr("this is a division of whole numbers, its remainder is lost")) << text;
  }
  for (const char* text : {"d := n * 30000;", "d := n * i + 1;", "x := n * 3;", "l := d * d;"}) {
    EXPECT_THAT(of(text), HasSubstr("so it wraps where the result does not fit")) << text;
  }
  EXPECT_THAT(of("d := n * 30000;"), HasSubstr("calculated as INT"));
  EXPECT_THAT(of("x := INT_TO_REAL(i / 2); x := INT_TO_REAL(i) / 2; d := INT_TO_DINT(n) * 30000; d := n; n := n * i; "
                 "i := i / 2; d := n MOD 7 + 1; x := 6 / 3; d := 300 * 300; x := d; u := u * 2;"),
              Not(HasSubstr("whole numbers, its")));
}

TEST(PlcWarnings, A_loop_that_nothing_ends) {
  const std::string head = "PROGRAM Main VAR i : INT; END_VAR ";
  for (const char* text : {"WHILE TRUE DO i := i + 1; END_WHILE;", "REPEAT i := i + 1; UNTIL FALSE END_REPEAT;",
                           "WHILE 1 = 1 DO FOR i := 1 TO 3 DO EXIT; END_FOR; END_WHILE;"}) {
    EXPECT_THAT(warnings(head + text + " END_PROGRAM"), HasSubstr("this loop never ends")) << text;
  }
  for (const char* text : {"WHILE TRUE DO i := i + 1; IF i > 3 THEN EXIT; END_IF; END_WHILE;",
                           "REPEAT i := i + 1; IF i > 3 THEN RETURN; END_IF; UNTIL FALSE END_REPEAT;",
                           "REPEAT i := i + 1; UNTIL TRUE END_REPEAT;", "WHILE i < 3 DO i := i + 1; END_WHILE;"}) {
    EXPECT_EQ(warnings(head + text + " END_PROGRAM"), "") << text;
  }
}

TEST(PlcWarnings, An_input_that_its_block_writes) {
  const auto block = [](const std::string& kind, const std::string& rest) {
    return kind + " VAR_INPUT a : INT; END_VAR a := a + 1; a := 2;" + rest;
  };
  const std::string main = " PROGRAM Main VAR f : F; END_VAR f(a := 1); END_PROGRAM";
  const std::string said = warnings(block("FUNCTION_BLOCK F", " END_FUNCTION_BLOCK") + main);
  EXPECT_THAT(said, HasSubstr("'a' is an input, which the caller gives"));
  EXPECT_EQ(said.find("is an input"), said.rfind("is an input")) << "once";
  EXPECT_EQ(warnings(block("FUNCTION G : INT", " G := a; END_FUNCTION") +
                     " PROGRAM Main VAR i : INT; END_VAR i := G(1); END_PROGRAM"),
            "")
      << "in a function it is one more variable";
}

TEST(PlcWarnings, A_comma_after_the_last_value_of_a_call) {
  const Compiled sut =
      compiled("PROGRAM Main VAR t : TON; i : INT; END_VAR t(IN := TRUE, PT := T#1s,); i := ABS(i,); END_PROGRAM");
  EXPECT_TRUE(sut.ok) << messages(sut);
  EXPECT_THAT(messages(sut), HasSubstr("there is no value after the last ','"));
}

TEST(PlcWarnings, An_empty_body) {
  EXPECT_THAT(warnings("PROGRAM Main VAR_INPUT x : BOOL; END_VAR ; END_PROGRAM"), HasSubstr("Main: the body is empty"));
}

TEST(PlcWarnings, A_task_without_an_interval) {
  const std::string program = "PROGRAM Main VAR x : BOOL; END_VAR x := NOT x; END_PROGRAM\n";
  const auto configured = [&](const std::string& task) {
    return program + "CONFIGURATION c RESOURCE r ON pc TASK fast (" + task +
           "); PROGRAM p WITH fast : Main; END_RESOURCE END_CONFIGURATION";
  };
  EXPECT_THAT(warnings(configured("PRIORITY := 1")), HasSubstr("the task fast has no interval and runs every 10 ms"));
  EXPECT_THAT(warnings(configured("INTERVAL := T#1ms, PRIORITY := 1")), Not(HasSubstr("no interval")));
}

std::string chart(const std::string& transitions) {
  std::string text = "PROGRAM Main VAR x : BOOL; END_VAR\nINITIAL_STEP a: END_STEP\n";
  for (const char* step : {"b", "c", "d"}) {
    text += std::string("STEP ") + step + ": END_STEP\n";
  }
  return text + transitions + "END_PROGRAM\n";
}

std::string from(const std::string& source, const std::string& target) {
  return "TRANSITION FROM " + source + " TO " + target + " := NOT x; END_TRANSITION\n";
}

TEST(PlcWarnings, A_step_that_is_never_reached) {
  const std::string all = warnings(chart(from("a", "b") + from("b", "a") + from("c", "d") + from("d", "c")));
  EXPECT_THAT(all, HasSubstr("the step 'c' never becomes active; lead a transition to it"));
  EXPECT_THAT(all, HasSubstr("the step 'd' never"));
  EXPECT_THAT(all, Not(HasSubstr("the step 'b'")));
}

TEST(PlcWarnings, A_jump_out_of_simultaneous_sequences) {
  const std::string fine = warnings(chart(from("a", "(b, c)") + from("(b, c)", "d") + from("d", "a")));
  EXPECT_THAT(fine, Not(HasSubstr("the step")));
  const std::string all = warnings(chart(from("a", "(b, c)") + from("(b, c)", "d") + from("d", "a") + from("b", "a")));
  EXPECT_THAT(all, HasSubstr("the step 'c' can become active while it is active"));
}

TEST(PlcWarnings, A_second_coil_of_a_variable) {
  const auto coil = [](int id, const std::string& attributes) {
    return "<coil localId=\"" + std::to_string(id) + "\"" + attributes +
           "><connectionPointIn><connection refLocalId=\"1\"/></connectionPointIn><variable>lamp</variable></coil>";
  };
  const auto ladder = [&](const std::string& second) {
    return R"(<project xmlns="http://www.plcopen.org/xml/tc6_0201"><types><dataTypes/><pous><pou name="Main" )"
           R"(pouType="program"><interface><localVars><variable name="lamp"><type><BOOL/></type></variable></localVars>)"
           R"(</interface><body><LD><leftPowerRail localId="1"/>)" +
           coil(2, "") + coil(3, second) + "</LD></body></pou></pous></types></project>";
  };
  EXPECT_THAT(warnings(ladder(""), "in.xml"), HasSubstr("'lamp' has another coil already, of which nothing remains"));
  EXPECT_THAT(warnings(ladder(" storage=\"set\""), "in.xml"), Not(HasSubstr("another coil")));
}

}  // namespace
}  // namespace indurop::plc
