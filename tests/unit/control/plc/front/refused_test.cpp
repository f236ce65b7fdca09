// SPDX-License-Identifier: Apache-2.0
// What would compile to code that does something else than it says, and is refused or checked instead.

#include <gmock/gmock.h>

#include <algorithm>
#include <utility>

#include "tests/unit/control/plc/front/compiled.h"

namespace indurop::plc {
namespace {

using testing::compiled;
using ::testing::HasSubstr;
using testing::messages;
using ::testing::Not;
using testing::wrong;

constexpr const char* kBlocks = R"(TYPE Percent : INT (0..100); END_TYPE
FUNCTION_BLOCK Doubler
VAR_INPUT in : INT; END_VAR
VAR_OUTPUT out : INT; END_VAR
VAR_IN_OUT last : INT; END_VAR
  out := 2 * in;
  last := in;
END_FUNCTION_BLOCK
FUNCTION_BLOCK Half
VAR_IN_OUT part : Percent; END_VAR
  part := part / 2;
END_FUNCTION_BLOCK
)";

std::string program(const std::string& code) {
  return std::string(kBlocks) +
         "PROGRAM Main\nVAR p : Percent; i, j : INT; a : ARRAY[1..3] OF INT; b : ARRAY[1..3] OF Percent;\n"
         "d : Doubler; h : Half; t : TON; c : CTU; x : BOOL; pump AT %IX0.0 : BOOL; lamp AT %QX0.0 : BOOL; END_VAR\n" +
         code + "\nEND_PROGRAM\n";
}

TEST(PlcRefused, A_subrange_is_no_VAR_IN_OUT_of_its_base_type) {
  EXPECT_THAT(wrong(program("d(in := i, last := p);")), HasSubstr("last is VAR_IN_OUT and needs a variable of type"));
  EXPECT_THAT(wrong(program("h(part := i);")), HasSubstr("part is VAR_IN_OUT and needs a variable of type"));
  EXPECT_EQ(wrong(program("h(part := p); d(in := p, last := i);")), "");
}

TEST(PlcRefused, An_array_does_not_become_one_of_a_subrange) {
  EXPECT_THAT(wrong(program("b := a;")), HasSubstr("use a value of the same type"));
  EXPECT_EQ(wrong(program("a := b;")), "");
}

TEST(PlcRefused, An_output_is_checked_against_the_subrange_it_goes_to) {
  const Compiled sut = compiled(program("d(in := i, last := j, out => p);"));
  ASSERT_TRUE(sut.ok) << messages(sut);
  EXPECT_THAT(sut.modules.at(0).cpp, HasSubstr("p = iec::in_range({\"in.st:16:30\", \"Main\"}, d.out, 0, 100);"));
}

TEST(PlcRefused, An_input_or_output_is_given_once) {
  EXPECT_THAT(wrong(program("t(IN := x, IN := FALSE);")), HasSubstr("IN is given twice, remove one of them"));
  EXPECT_THAT(wrong(program("t(Q => x, Q => lamp);")), HasSubstr("Q is given twice"));
  EXPECT_THAT(wrong(program("t(x, T#1s, PT := T#2s);")), HasSubstr("PT is given twice"));
  EXPECT_THAT(wrong(program("c(R := x, RESET := x);")), HasSubstr("R is given twice"));
  EXPECT_THAT(wrong(program("d(in := 1, in := 2, last := i);")), HasSubstr("in is given twice"));
  EXPECT_THAT(wrong(program("t(EN := x, EN := x, IN := x);")), HasSubstr("EN is given twice"));
}

TEST(PlcRefused, The_variable_of_a_FOR_is_not_changed_inside) {
  for (const char* change :
       {"i := i + 1;", "IF x THEN i := 9; END_IF;", "d(in := 1, last := i);", "d(in := 1, last := j, out => i);",
        "FOR i := 1 TO 2 DO j := i; END_FOR;", "FOR j := 1 TO 2 DO i := j; END_FOR;"}) {
    EXPECT_THAT(wrong(program(std::string("FOR i := 1 TO 3 DO ") + change + " END_FOR;")),
                HasSubstr("this is the variable of the FOR at in.st:16:1, which must not be changed inside"))
        << change;
  }
  EXPECT_EQ(wrong(program("FOR i := 1 TO 3 DO j := i; END_FOR; i := 0;")), "");
}

TEST(PlcRefused, Inputs_are_not_written) {
  EXPECT_THAT(wrong(program("pump := TRUE;")), HasSubstr("%IX0.0 is an input, which only the world outside changes"));
  EXPECT_THAT(wrong(program("%IX0.1 := TRUE;")), HasSubstr("%IX0.1 is an input"));
  EXPECT_THAT(wrong(program("%IW2.3 := TRUE;")), HasSubstr("is an input"));
  EXPECT_THAT(wrong(program("t(IN := x, Q => pump);")), HasSubstr("%IX0.0 is an input"));
  EXPECT_EQ(wrong(program("lamp := pump; %QX0.2 := %IX0.1;")), "");
}

TEST(PlcRefused, Inputs_without_a_place_are_not_written_either) {
  const auto placeless = [](const std::string& code) {
    return std::string(kBlocks) +
           "VAR_GLOBAL gate AT %I* : BOOL; END_VAR\n"
           "PROGRAM Main\nVAR w AT %I* : WORD; a AT %I* : ARRAY[0..3] OF INT; q AT %Q* : WORD; t : TON; d : Doubler; "
           "x : BOOL; END_VAR\n" +
           code + "\nEND_PROGRAM\n";
  };
  for (const char* code : {"w := 16#12;", "w.3 := TRUE;", "gate := TRUE;", "a[2] := 4;", "t(IN := x, Q => gate);",
                           "d(in := 1, last := a[1]);"}) {
    EXPECT_THAT(wrong(placeless(code)), HasSubstr("%I* is an input, which only the world outside changes")) << code;
  }
  EXPECT_EQ(wrong(placeless("q := w; q.3 := gate; x := a[1] > 0;")), "");
}

TEST(PlcRefused, A_bit_of_a_subrange_is_checked) {
  const Compiled sut = compiled(program("p.6 := x; t(IN := x, Q => b[2].0);"));
  ASSERT_TRUE(sut.ok) << messages(sut);
  EXPECT_THAT(sut.modules.at(0).cpp, HasSubstr("iec::set_bit_in_range({\"in.st:16:1\", \"Main\"}, p, 6U, x, 0, 100);"));
  EXPECT_THAT(sut.modules.at(0).cpp, HasSubstr("b[1], 0U, t.q, 0, 100);"));
}

std::string times(const std::string& code) {
  return "PROGRAM Main\nVAR t : TIME; d : DATE; c : TOD; s : DT; i : INT; x : BOOL; delay : TON; END_VAR\n" + code +
         "\nEND_PROGRAM\n";
}

TEST(PlcRefused, A_bare_number_is_no_time) {
  EXPECT_THAT(wrong(times("delay(IN := x, PT := 500);")),
              HasSubstr("500 is not a TIME; a number has no unit, write T#"));
  EXPECT_THAT(wrong(times("t := 0;")), HasSubstr("0 is not a TIME; a number has no unit, write T#500ms"));
  EXPECT_THAT(wrong(times("t := T#1s + 5;")), HasSubstr("ADD does not take TIME and INT; a number has no unit"));
  EXPECT_THAT(wrong(times("t := MAX(t, 5);")), HasSubstr("MAX does not take TIME and INT; a number has no unit"));
  EXPECT_THAT(wrong(times("x := t > 5;")), HasSubstr("cannot be compared; a number has no unit, write T#500ms"));
  EXPECT_THAT(wrong(times("x := -5 < t;")), HasSubstr("cannot be compared; a number has no unit, write T#500ms"));
  EXPECT_THAT(wrong(times("t := SEL(x, 1, 2);")), HasSubstr("TIME"));
  EXPECT_THAT(wrong(times("d := 5;")), HasSubstr("5 is not a DATE; a number has no unit, write D#2026-01-31"));
  EXPECT_THAT(wrong(times("c := 5;")), HasSubstr("write TOD#12:30:00"));
  EXPECT_THAT(wrong(times("s := 5;")), HasSubstr("write DT#2026-01-31-12:30:00"));
  EXPECT_THAT(wrong("PROGRAM Main VAR t : TIME := 5; END_VAR t := t; END_PROGRAM"), HasSubstr("a number has no unit"));
}

TEST(PlcRefused, Times_and_numbers_go_together_where_the_standard_says_so) {
  EXPECT_EQ(wrong(times("t := T#1s * 5; t := t / 2; x := t > T#1s * 2; t := MAX(t, T#5s); t := -T#1s;")), "");
}

TEST(PlcRefused, C_code_in_braces_is_not_skipped) {
  const std::string ticks =
      "FUNCTION_BLOCK Ticks VAR_OUTPUT TX : TIME; END_VAR\n{extern long __tick; TX = __tick;}\n"
      "END_FUNCTION_BLOCK\n";
  const std::string main = "PROGRAM Main VAR x : Ticks; END_VAR x(); END_PROGRAM\n";
  EXPECT_THAT(wrong(ticks + main), HasSubstr("in.st:2:1: warning: Ticks is left out, because C code in { } is not"));
  EXPECT_THAT(wrong(ticks + main), HasSubstr("error: Main: there is no type and no function block 'Ticks'"));
  EXPECT_THAT(wrong("FUNCTION T_PLC_MS : DWORD\n{extern long __tick;}\nEND_FUNCTION\n" + times("i := 1;")), "");
  EXPECT_THAT(messages(compiled("FUNCTION T_PLC_MS : DWORD\n{extern long __tick;}\nEND_FUNCTION\n" + times("i := 1;"))),
              HasSubstr("not supported; the function of the library takes its place"));
  for (const char* code :
       {"{ __SET_VAR(data__->,X,,1) }", "{x = 1}", "{#include <a.h>}", "{{ x }}", "{ puts(\"}\") }"}) {
    EXPECT_THAT(wrong(times(std::string("x := TRUE;\n") + code)), HasSubstr("in.st:4:1: error: C code in { }")) << code;
  }
}

TEST(PlcRefused, Pragmas_of_editors_are_skipped) {
  for (const char* pragma : {"{attribute 'symbol' := 'read; write'}", "{region Start (first)}", "{warning 'a = b;'}",
                             "{disable code generation}", "{library private}", "{S+}", "{}"}) {
    EXPECT_EQ(wrong(times(std::string(pragma) + "\nx := TRUE;")), "") << pragma;
  }
}

TEST(PlcRefused, A_division_of_whole_numbers_that_becomes_a_REAL_is_a_warning) {
  const std::string head = "PROGRAM Main VAR x : REAL; i : INT; b : BOOL; END_VAR\n";
  for (const char* code : {"x := x * (1/2);", "x := 1/2;", "x := (1/2 + 1) * x;", "b := x > 1/2;", "x := -(1/2);"}) {
    EXPECT_THAT(messages(compiled(head + code + " END_PROGRAM")),
                HasSubstr("warning: Main: 1 / 2 is 0, a division of whole numbers; write 1.0 / 2.0"))
        << code;
  }
  for (const char* code : {"i := 7/2;", "x := x * (4/2);", "x := 1.0/2;", "x := INT_TO_REAL(7/2);"}) {
    EXPECT_THAT(messages(compiled(head + code + " END_PROGRAM")), Not(HasSubstr("division of whole numbers"))) << code;
  }
}

TEST(PlcRefused, Functions_without_inputs_take_none) {
  EXPECT_THAT(wrong(times("t := TIME(4);")), HasSubstr("TIME takes 0 values, not 1"));
  EXPECT_THAT(wrong(times("t := TIME() + T#1s;")), "");
}

TEST(PlcRefused, A_block_of_the_project_takes_the_place_of_any_of_the_library) {
  const Compiled sut = compiled(
      "FUNCTION_BLOCK TON VAR_INPUT IN : BOOL; END_VAR VAR_OUTPUT calls : INT; END_VAR calls := calls + 1; "
      "END_FUNCTION_BLOCK\n"
      "PROGRAM Main\nVAR t : TON; n : INT; END_VAR\nINITIAL_STEP a: act(L, T#1s); END_STEP\nSTEP b: END_STEP\n"
      "TRANSITION FROM a TO b := t.calls > 3; END_TRANSITION\nTRANSITION FROM b TO a := TRUE; END_TRANSITION\n"
      "ACTION act: t(IN := TRUE); n := t.calls; END_ACTION\nEND_PROGRAM\n");
  ASSERT_TRUE(sut.ok) << messages(sut);
  EXPECT_THAT(messages(sut), HasSubstr("'TON' takes the place of that of the standard library"));
  EXPECT_THAT(sut.modules.at(0).cpp, HasSubstr("plc::TON t{};"));
  EXPECT_THAT(sut.modules.at(0).cpp, HasSubstr("iec::Ton _st0{};")) << "charts have that of the library";
}

TEST(PlcRefused, A_REAL_that_is_too_large_is_no_constant) {
  const std::string head = "PROGRAM Main VAR x : REAL; y : LREAL; END_VAR\n";
  for (const char* code : {"x := 1.0E39;", "x := REAL#1.0E39;", "x := -1.0E39;", "x := 3.0E38 * 10.0;"}) {
    EXPECT_THAT(wrong(head + code + " END_PROGRAM"), HasSubstr("does not fit REAL")) << code;
  }
  for (const char* code : {"y := 1.0E308 * 10.0;", "y := -1.0E308 - 1.0E308;", "y := (-1.0) ** 0.5;"}) {
    EXPECT_THAT(wrong(head + code + " END_PROGRAM"), HasSubstr("the result is no number that LREAL holds")) << code;
  }
  for (const char* code :
       {"x := 3.0E38;", "x := REAL#3.0E38 * REAL#10.0;", "y := LREAL#1.0E308 * 10.0;", "y := LREAL#-1.0 ** 0.5;"}) {
    EXPECT_EQ(wrong(head + code + " END_PROGRAM"), "") << code;
    EXPECT_THAT(compiled(head + code + " END_PROGRAM").modules.at(0).cpp, Not(HasSubstr("inf"))) << code;
  }
}

// What the language has and we have not: one message that names it, and nothing about what it would have declared.
TEST(PlcRefused, What_is_not_supported_is_said_once) {
  const Compiled sut = compiled(
      "PROGRAM Main VAR i, j : INT; e : __SYSTEM.ExceptionCode; END_VAR\n__TRY\ni := 5 / j;\n__CATCH(e)\ni := 2;\n"
      "__FINALLY\nj := 1;\n__ENDTRY\nEND_PROGRAM");
  EXPECT_FALSE(sut.ok);
  EXPECT_EQ(sut.diagnostics.size(), 1U) << messages(sut);
  EXPECT_THAT(messages(sut), HasSubstr("__TRY is not supported: a fault is a C++ exception, which takes memory"));
}

TEST(PlcRefused, What_others_have_is_one_error_in_each_line_that_has_it) {
  const std::string counter = "FUNCTION_BLOCK C VAR_OUTPUT n : INT; END_VAR n := n + 1; END_FUNCTION_BLOCK\n";
  for (const auto& [text, message] : {
           std::pair{"PROGRAM Main VAR a, b : INT; END_VAR IF (a := b) > 3 THEN b := 1; END_IF; END_PROGRAM", "(ExST)"},
           std::pair{"PROGRAM Main VAR a, b : BOOL; END_VAR IF a := b THEN b := FALSE; END_IF; END_PROGRAM", "(ExST)"},
           std::pair{"PROGRAM Main VAR a, b : INT; END_VAR a := b + (b := 1); END_PROGRAM", "(ExST)"},
           std::pair{"PROGRAM Main VAR l : List<10, Inner<INT>>; END_VAR l(x := 3); END_PROGRAM", "VAR_GENERIC"},
           std::pair{"FUNCTION_BLOCK L EXTENDS List<10> END_FUNCTION_BLOCK", "VAR_GENERIC"},
           std::pair{"FUNCTION Make : C Make.n := 1; END_FUNCTION", "a function block cannot be a result"},
           std::pair{"PROGRAM Main VAR c, d : C; END_VAR c(); d(); c := d; END_PROGRAM", "is not assigned as a whole"},
       }) {
    const Compiled sut = compiled(counter + text);
    EXPECT_THAT(messages(sut), HasSubstr(message)) << text;
    const auto errors = std::count_if(sut.diagnostics.begin(), sut.diagnostics.end(), [](const base::Diagnostic& one) {
      return one.severity == base::Diagnostic::Severity::Error;
    });
    EXPECT_EQ(errors, 1) << text << "\n" << messages(sut);
  }
}

// Each method that uses it may run when the variable is gone: then it is a fault, no value of another one.
TEST(PlcRefused, VAR_IN_OUT_that_methods_use_ends_with_its_variable) {
  const std::string block =
      "FUNCTION_BLOCK F VAR_IN_OUT io : INT; END_VAR METHOD Up : INT io := io + 1; Up := io; END_METHOD Up(); "
      "END_FUNCTION_BLOCK PROGRAM Main VAR f : F; k : INT; END_VAR VAR_TEMP t : INT; END_VAR ";
  const auto code = [&](const std::string& body) {
    CompileOptions options;
    options.files = {"in.st"};
    options.name = "sut";
    options.dialect = Dialect::Codesys;
    const Compiled sut = compile(options, [&](const std::string& name) {
      return glb2idl::ReadResult{block + body + " END_PROGRAM", name, ""};
    });
    EXPECT_TRUE(sut.ok) << messages(sut);
    return sut.modules.at(0).cpp;
  };
  EXPECT_THAT(code("f(io := k);"), HasSubstr("iec::given({\"in.st:1:"));
  EXPECT_THAT(code("f(io := k);"), Not(HasSubstr("f.io = nullptr;")));
  EXPECT_THAT(code("f(io := t);"), HasSubstr("f.io = nullptr;"));
  EXPECT_THAT(wrong(block + "f(io := k); END_PROGRAM"), HasSubstr("'io' is VAR_IN_OUT of F, which only its body sees"));
}

TEST(PlcRefused, Characters_are_no_numbers_and_texts_of_two_kinds_not_mixed) {
  struct Mixed {
    const char* text;
    const char* message;
  };
  for (const auto& [text, message] : {
           Mixed{"FUNCTION F : INT VAR_INPUT w : WSTRING; END_VAR F := LEN(w); w := 'a'; END_FUNCTION",
                 "convert it with STRING_TO_WSTRING()"},
           Mixed{"FUNCTION F : CHAR F := 65; END_FUNCTION", "write the character, CHAR#'a'"},
           Mixed{"FUNCTION F : CHAR F := 'b'; F := CHAR#'ab'; END_FUNCTION", "is not one character"},
           Mixed{"FUNCTION F : WCHAR F := WCHAR#'a'; F := \"b\"; END_FUNCTION", "is not one character, write WCHAR#"},
           Mixed{"FUNCTION F : CHAR VAR_INPUT s : STRING[3]; END_VAR F := s[4]; END_FUNCTION", "outside of 1..3"},
       }) {
    const Compiled sut = compiled(std::string("PROGRAM Main VAR i : INT; END_VAR i := 1; END_PROGRAM\n") + text + "\n");
    EXPECT_FALSE(sut.ok) << text;
    EXPECT_EQ(sut.diagnostics.size(), 1U) << text << '\n' << messages(sut);
    EXPECT_THAT(messages(sut), HasSubstr(message));
  }
}

TEST(PlcRefused, An_open_EN_of_a_function_is_TRUE) {
  const auto add = [](const std::string& second) {
    return R"(<project xmlns="http://www.plcopen.org/xml/tc6_0201"><types><pous><pou name="Main" pouType="program">
<interface><localVars><variable name="a"><type><INT/></type></variable></localVars></interface><body><FBD>
<inVariable localId="1"><position x="0" y="0"/><connectionPointOut/><expression>a</expression></inVariable>
<block localId="2" typeName="ADD"><position x="5" y="0"/><inputVariables>
<variable formalParameter="EN"><connectionPointIn/></variable>
<variable formalParameter="IN1"><connectionPointIn><connection refLocalId="1"/></connectionPointIn></variable>
<variable formalParameter="IN2"><connectionPointIn>)" +
           second + R"(</connectionPointIn></variable></inputVariables><inOutVariables/>
<outputVariables><variable formalParameter="OUT"><connectionPointOut/></variable></outputVariables></block>
<outVariable localId="3"><position x="9" y="0"/><connectionPointIn><connection refLocalId="2" formalParameter="OUT"/>
</connectionPointIn><expression>a</expression></outVariable></FBD></body></pou></pous></types></project>)";
  };
  const Compiled sut = compiled(add("<connection refLocalId=\"1\"/>"), "in.xml");
  ASSERT_TRUE(sut.ok) << messages(sut);
  EXPECT_THAT(sut.modules.at(0).cpp, HasSubstr("iec::add(a, a)"));
  EXPECT_THAT(messages(compiled(add(""), "in.xml")), HasSubstr("this input of a function is connected to nothing"));
}

TEST(PlcRefused, A_library_has_no_PROGRAM) {
  EXPECT_THAT(wrong("FUNCTION G : INT G := 1; END_FUNCTION\n"), HasSubstr("there is no PROGRAM that could run"));
  CompileOptions options;
  options.files = {"in.st"};
  options.library = true;
  const auto checked = [&](const std::string& library) {
    return compile(options, [&](const std::string& name) { return glb2idl::ReadResult{library, name, ""}; });
  };
  const Compiled sut = checked("FUNCTION G : INT G := 1; END_FUNCTION\n");
  EXPECT_TRUE(sut.ok);
  EXPECT_TRUE(sut.modules.empty());
  EXPECT_FALSE(checked("FUNCTION G : INT G := x; END_FUNCTION\n").ok);
  EXPECT_THAT(messages(checked("FUNCTION F : INT VAR_INPUT x : ANY_NUM; END_VAR F := 1; END_FUNCTION\n")),
              HasSubstr("warning: F is never called, so its body was not checked"));
}

TEST(PlcRefused, What_is_in_a_NAMESPACE_is_seen_through_it) {
  const std::string space = "NAMESPACE Space FUNCTION F : INT F := 1; END_FUNCTION END_NAMESPACE\n";
  const auto main = [&](const std::string& code) {
    return wrong(space + "PROGRAM Main VAR i : INT; END_VAR " + code + " END_PROGRAM");
  };
  EXPECT_EQ(main("i := Space.F();"), "");
  EXPECT_THAT(main("i := F();"), HasSubstr("in.st:2:40: error: 'F' is in a NAMESPACE, write Space.F, or USING Space;"));
  EXPECT_THAT(main("i := Space.G();"), HasSubstr("error"));
  EXPECT_THAT(wrong(space + "USING Spice;\nPROGRAM Main VAR i : INT; END_VAR i := 1; END_PROGRAM"),
              HasSubstr("in.st:2:7: error: there is no NAMESPACE 'Spice'"));
  EXPECT_THAT(
      wrong("NAMESPACE Space VAR_GLOBAL x : INT; END_VAR END_NAMESPACE\nPROGRAM Main VAR i : INT; END_VAR i := 1; "
            "END_PROGRAM"),
      HasSubstr("a NAMESPACE holds types, functions, function blocks, classes and interfaces, not 'VAR_GLOBAL'"));
}

TEST(PlcRefused, A_UNION_holds_only_what_any_bytes_are_a_value_of) {
  const auto with = [](const std::string& field) {
    return wrong("TYPE U : UNION w : WORD; " + field +
                 " END_UNION END_TYPE PROGRAM Main VAR x : U; END_VAR x.w := 1; END_PROGRAM");
  };
  EXPECT_EQ(with("b : ARRAY[0..1] OF BYTE;"), "");
  EXPECT_THAT(with("b : BOOL;"), HasSubstr("a UNION has no BOOL and no BIT"));
  EXPECT_THAT(with("b : ARRAY[0..1] OF BOOL;"), HasSubstr("a UNION has no BOOL and no BIT"));
  EXPECT_THAT(with("p : POINTER TO INT;"), HasSubstr("a UNION cannot contain a POINTER TO INT"));
  EXPECT_THAT(with("i : INT (0..5);"), HasSubstr("a UNION has no subrange"));
  EXPECT_THAT(with("i : INT := 5;"), HasSubstr("a field of a UNION has no initial value"));
  EXPECT_THAT(wrong("TYPE U : UNION w : WORD; END_UNION END_TYPE PROGRAM Main VAR x : U := (w := 1); END_VAR x.w := 1; "
                    "END_PROGRAM"),
              HasSubstr("a UNION begins with zeros"));
}

TEST(PlcRefused, An_array_without_bounds_is_seen_by_what_it_is_given_to_only) {
  const auto function = [](const std::string& variables, const std::string& code = "F := 1;") {
    return wrong("FUNCTION F : INT VAR_IN_OUT a : ARRAY[*] OF INT; END_VAR " + variables + " " + code +
                 " END_FUNCTION PROGRAM Main VAR l : ARRAY[1..3] OF INT; d : ARRAY[1..3] OF DINT; i : INT; END_VAR i "
                 ":= F(l); END_PROGRAM");
  };
  const std::string rule = "ARRAY[*] is for VAR_IN_OUT of functions, methods and function blocks only";
  EXPECT_EQ(function("", "F := a[LOWER_BOUND(a, 1)];"), "");
  EXPECT_THAT(function("VAR b : ARRAY[*] OF INT; END_VAR"), HasSubstr(rule));
  EXPECT_THAT(function("VAR_INPUT b : ARRAY[*] OF INT; END_VAR"), HasSubstr(rule));
  EXPECT_THAT(function("VAR p : POINTER TO ARRAY[*] OF INT; END_VAR"), HasSubstr(rule));
  EXPECT_THAT(function("", "F := a[1, 2];"), HasSubstr("ARRAY[*] OF INT needs 1 indices, not 2"));
  EXPECT_THAT(function("", "F := LOWER_BOUND(a, 2);"), HasSubstr("the dimensions of ARRAY[*] OF INT are 1 to 1"));
  EXPECT_THAT(function("VAR p : POINTER TO INT; END_VAR", "p := ADR(a[1]);"),
              HasSubstr("elements of an ARRAY[*] have no address"));
  EXPECT_THAT(function("VAR p : REFERENCE TO INT; END_VAR", "p REF= a[1];"),
              HasSubstr("elements of an ARRAY[*] have no address"));
  EXPECT_THAT(function("VAR b : ARRAY[1..3] OF INT; END_VAR", "a := b;"),
              HasSubstr("an ARRAY[*] is not assigned as a whole"));
  EXPECT_THAT(function("VAR b : ARRAY[1..3] OF INT; END_VAR", "b := a;"), HasSubstr("is not an ARRAY[1..3] OF INT"));
  EXPECT_THAT(function("VAR n : DINT; END_VAR", "n := SIZEOF(a);"), HasSubstr("an ARRAY[*] has no size known now"));
  EXPECT_THAT(wrong("FUNCTION F : INT VAR_IN_OUT a : ARRAY[*] OF INT; END_VAR F := a[1]; END_FUNCTION\n"
                    "PROGRAM Main VAR d : ARRAY[1..3] OF DINT; i : INT; END_VAR i := F(d); END_PROGRAM"),
              HasSubstr("a is VAR_IN_OUT and needs a variable of type ARRAY[*] OF INT"));
}

TEST(PlcRefused, A_place_inside_of_an_array_is_not_a_second_variable) {
  const std::string head = "PROGRAM Main VAR list AT %MW10 : ARRAY[1..3] OF WORD; w : WORD; END_VAR ";
  EXPECT_THAT(messages(compiled(head + "w := list[1]; w := %MW12; END_PROGRAM")),
              HasSubstr("%MW12 lies in the array 'list' at %MW10, write its element"));
  EXPECT_TRUE(compiled(head + "w := list[1]; w := %MW13; END_PROGRAM").ok);
}

TEST(PlcRefused, A_pointer_that_leads_to_itself) {
  const std::string main = "PROGRAM Main VAR x : P; b : BOOL; END_VAR b := NOT b; END_PROGRAM\n";
  for (const char* type : {"POINTER TO P", "ARRAY[0..1] OF POINTER TO P"}) {
    EXPECT_THAT(messages(compiled("TYPE P : " + std::string(type) + "; END_TYPE\n" + main)),
                HasSubstr("a pointer to 'P' leads to itself, put a STRUCT between"));
  }
}

}  // namespace
}  // namespace indurop::plc
