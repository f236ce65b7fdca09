// SPDX-License-Identifier: Apache-2.0
// What is wrong is said once, whatever follows from it; and what is named from outside of POUs has to be there.

#include <gmock/gmock.h>

#include <algorithm>
#include <string>

#include "tests/unit/control/plc/front/compiled.h"

namespace indurop::plc {
namespace {

using testing::compiled;
using ::testing::HasSubstr;
using testing::messages;
using ::testing::Not;
using testing::written;
using testing::wrong;

// One mistake, one message: also where what follows cannot be understood any more.
TEST(PlcMistakes, A_mistake_in_the_text_is_said_once) {
  struct Row {
    const char* text;
    const char* message;
  };
  const std::string head = "PROGRAM Main VAR i : INT; s : STRING; END_VAR\n";
  for (const auto& [text, message] : {
           Row{"FOR i = 1 TO 10 DO\ni := 3;\nEND_FOR;\n", "expected ':=' after the loop's variable"},
           Row{"FOR i := 1 TO 10\ni := 3;\nEND_FOR;\n", "expected 'DO'"},
           Row{"WHILE i < DO\ni := 3;\nEND_WHILE;\n", "expected a value"},
           Row{"IF i = THEN\ni := 3;\nELSE\ni := 4;\nEND_IF;\n", "expected a value"},
           Row{"IF i = 1\ni := 3;\nEND_IF;\n", "expected 'THEN'"},
           Row{"s := 'abc;\ni := 1;\n", "this text has no end"},
           Row{"s := CONCAT('abc, s);\ni := 1;\n", "this text has no end"},
           Row{"(* i := 1;\n", "this comment has no end"},
           Row{"i := j + 1;\nj := 2;\nIF j > 3 THEN i := 3; END_IF;\n", "'j' is not declared"},
       }) {
    const Compiled sut = compiled(head + text + "END_PROGRAM\n");
    EXPECT_FALSE(sut.ok) << text;
    EXPECT_EQ(sut.diagnostics.size(), 1U) << text << '\n' << messages(sut);
    EXPECT_THAT(messages(sut), HasSubstr(message));
  }
}

// IEC 61131-3, 6.6.1.4.2: a call without names gives what there is, one with names as much as it likes. Inputs with an
// initial value may be left out, as editors allow it.
TEST(PlcMistakes, A_call_without_names_gives_all_inputs) {
  const std::string head =
      "FUNCTION F : INT VAR_INPUT a, b : INT; c : INT := 5; END_VAR VAR_OUTPUT d : INT; END_VAR F := a + b + c; d := "
      "a; "
      "END_FUNCTION FUNCTION None : INT None := 1; END_FUNCTION "
      "FUNCTION_BLOCK B METHOD M : INT VAR_INPUT a : INT; b : INT; END_VAR M := a + b; END_METHOD END_FUNCTION_BLOCK "
      "PROGRAM Main VAR i : INT; e : BOOL; m : B; END_VAR ";
  for (const char* text : {"i := F(1);", "F(1);", "i := m.M(1);", "i := F(1, c := 2);"}) {
    EXPECT_THAT(wrong(head + text + " END_PROGRAM"), HasSubstr(" needs a value for its input ")) << text;
  }
  for (const char* text :
       {"i := F(1, 2);", "i := F(a := 1);", "i := F(c := 1, d => i);", "i := F(1, 2, 3);", "i := F(1, 2, 3, i);",
        "i := F(1, 2, c := 3);", "i := m.M(1, 2);", "i := m.M(b := 1);", "F(EN := e, a := 1);", "i := None();"}) {
    EXPECT_EQ(wrong(head + text + " END_PROGRAM"), "") << text;
  }
  for (const char* text : {"i := F();", "F();", "i := m.M();"}) {  // with names, of which there is none
    EXPECT_THAT(messages(compiled(head + text + " END_PROGRAM")),
                HasSubstr(" is called without a value for any input, so a has that of its type"))
        << text;
  }
}

TEST(PlcMistakes, A_number_given_to_a_function_of_any_type_takes_the_type_that_is_wanted) {
  const std::string head =
      "FUNCTION Twice : ANY_NUM VAR_INPUT x : ANY_NUM; END_VAR Twice := x + x; END_FUNCTION "
      "FUNCTION More : INT VAR_INPUT x : ANY_NUM; END_VAR More := TO_INT(x); END_FUNCTION "
      "PROGRAM Main VAR r : REAL; u : UINT; s : SINT; i : INT; p : INT(0..9); b : BOOL; END_VAR ";
  for (const char* text : {"r := Twice(1.5);", "r := Twice(3);", "u := Twice(3);", "s := Twice(3);", "i := Twice(3);",
                           "p := Twice(3);", "i := More(1.5);", "b := Twice(300) > 500;", "u := Twice(MAX(1, 2));"}) {
    EXPECT_EQ(wrong(head + text + " END_PROGRAM"), "") << text;
  }
  EXPECT_THAT(wrong(head + "u := Twice(-3); END_PROGRAM"), HasSubstr("error"));
}

TEST(PlcMistakes, An_action_is_declared_once) {
  const std::string twice =
      " VAR x : BOOL; END_VAR ACTION Act: x := TRUE; END_ACTION ACTION act: x := FALSE; END_ACTION Act();";
  EXPECT_THAT(wrong("PROGRAM Main" + twice + " END_PROGRAM"),
              HasSubstr("in.st:1:77: error: 'act' is already declared at"));
  EXPECT_THAT(
      wrong("FUNCTION_BLOCK F" + twice + " END_FUNCTION_BLOCK PROGRAM Main VAR f : F; END_VAR f.Act(); END_PROGRAM"),
      HasSubstr("'act' is already declared at in.st:1:"));
}

TEST(PlcMistakes, An_action_of_a_program_may_be_called_as_one_of_a_block_it_uses) {
  const std::string block =
      "FUNCTION_BLOCK F VAR_OUTPUT q : BOOL; END_VAR ACTION Act: q := NOT q; END_ACTION q := TRUE; END_FUNCTION_BLOCK ";
  EXPECT_EQ(wrong(block + "PROGRAM Main VAR f : F; x : BOOL; END_VAR ACTION Act: x := f.q; END_ACTION Act(); f.Act(); "
                          "END_PROGRAM"),
            "");
}

// What is wrong is named, not what follows from it.
TEST(PlcMistakes, The_message_names_the_mistake) {
  struct Row {
    const char* text;
    const char* message;
  };
  const std::string head =
      "FUNCTION F : INT VAR_INPUT a : INT; END_VAR F := a; END_FUNCTION "
      "FUNCTION_BLOCK B VAR_INPUT a : INT; END_VAR VAR_OUTPUT o : INT; END_VAR METHOD Init : INT VAR_INPUT c : INT; "
      "END_VAR Init := c; END_METHOD o := a; END_FUNCTION_BLOCK "
      "PROGRAM Main VAR i : INT; b : B; t : TIME; END_VAR ";
  for (const auto& [text, message] : {
           Row{"i := F;", "'F' is a function, call it: F(...)"},
           Row{"i := ABS;", "'ABS' is a function, call it: ABS(...)"},
           Row{"Init(3);", "Init is a method of B, call it of an instance: name.Init(...)"},
           Row{"t := 5 * T#1s;", "MUL does not take INT and TIME; write the TIME first"},
           Row{"i := b.Init;", "'Init' is a method of B, call it: Init(...)"},
           Row{"i := b(a := 3);", "'b' is not a function; the call of a function block stands alone"},
           Row{"i.%X99 := TRUE;", "an INT has the bits 0 to 15"},
           Row{"t := T#1m90s;", "only its first number may be so large: 60 S make one M"},
           Row{"t := T#1d24h;", "only its first number may be so large: 24 H make one D"},
           Row{"{i++} i := 2;", "C code in { } is not supported"},
       }) {
    const Compiled sut = compiled(head + text + " END_PROGRAM");
    EXPECT_FALSE(sut.ok) << text;
    EXPECT_EQ(sut.diagnostics.size(), 1U) << text << '\n' << messages(sut);
    EXPECT_THAT(messages(sut), HasSubstr(message));
  }
  EXPECT_THAT(
      wrong("FUNCTION Q : INT VAR_INPUT a : INT; END_VAR Q := a; END_FUNCTION PROGRAM Main VAR q, i : INT; END_VAR "
            "i := Q(1); END_PROGRAM"),
      HasSubstr("the variable 'q' of in.st:1:83 hides the function Q, rename one of them"));
  EXPECT_EQ(wrong(head + "t := T#25h15m; t := T#1h59m59s999ms; {region 'a++'} i.%X3 := t > T#1s; END_PROGRAM"), "");
}

TEST(PlcMistakes, A_block_is_drawn_as_what_it_is_declared) {
  const auto drawn = [](const std::string& type, const std::string& name) {
    return wrong(R"(<?xml version="1.0"?><project xmlns="http://www.plcopen.org/xml/tc6_0201"><types><dataTypes/><pous>
<pou name="Base" pouType="functionBlock"><interface><outputVars><variable name="q"><type><BOOL/></type></variable>
</outputVars></interface><body><ST><xhtml xmlns="http://www.w3.org/1999/xhtml">q := TRUE;</xhtml></ST></body></pou>
<pou name="main" pouType="program"><interface><localVars><variable name="t"><type><derived name="TON"/></type></variable>
<variable name="b"><type><derived name="Base"/></type></variable></localVars></interface><body><FBD>
<block localId="1" typeName=")" +
                     type + "\" instanceName=\"" + name + R"("><position x="9" y="9"/><inputVariables/>
<inOutVariables/><outputVariables/></block></FBD></body></pou></pous></types><instances><configurations/></instances></project>)",
                 "in.xml");
  };
  EXPECT_EQ(drawn("TON", "t"), "");
  EXPECT_EQ(drawn("base", "b"), "");
  EXPECT_THAT(drawn("TOF", "t"), HasSubstr("block t: main: this is drawn as a TOF, but declared as a TON; draw that"));
  EXPECT_THAT(drawn("TONX", "t"), HasSubstr("this is drawn as a TONX, but declared as a TON"));
  EXPECT_THAT(drawn("CTU", "b"), HasSubstr("this is drawn as a CTU, but declared as a Base"));
}

TEST(PlcMistakes, One_mistake_is_one_message) {
  struct Row {
    const char* text;
    const char* message;
  };
  for (const auto& [text, message] : {
           Row{"PROGRAM Main VAR a, IF, b : INT; c : BOOL; END_VAR a := 1; b := 2; c := TRUE; END_PROGRAM",
               "expected the name of a variable, found 'IF', which is a word of the language"},
           Row{"PROGRAM Main VAR a, b : INT; END_VAR\nIF a = 1 THAN\nb := 2;\nELSIF a = 2 THEN\nb := 3;\nEND_IF;\n"
               "b := 4;\nEND_PROGRAM",
               "expected 'THEN' after the condition, found 'THAN'"},
           Row{"TYPE U : UNION a : BOOL; b : INT; END_UNION END_TYPE PROGRAM Main VAR u : U; END_VAR u.b := 3; "
               "END_PROGRAM",
               "a UNION has no BOOL"},
           Row{"PROGRAM Main VAR n : INT; END_VAR\nINITIAL_STEP S0: END_STEP STEP S1: END_STEP\n"
               "TRANSITION FROM S0 TO nowhere := n > 3; END_TRANSITION TRANSITION FROM S1 TO S0 := n > 4; "
               "END_TRANSITION END_PROGRAM",
               "there is no step 'nowhere'"},
       }) {
    const Compiled sut = compiled(text);
    EXPECT_FALSE(sut.ok) << text;
    const auto errors = std::count_if(sut.diagnostics.begin(), sut.diagnostics.end(), [](const auto& one) {
      return one.severity == base::Diagnostic::Severity::Error;
    });
    EXPECT_EQ(errors, 1) << text << '\n' << messages(sut);
    EXPECT_THAT(messages(sut), HasSubstr(message));
  }
}

TEST(PlcMistakes, The_condition_of_a_transition_is_a_BOOL) {
  const auto chart = [](const std::string& condition) {
    return "PROGRAM Main VAR x : BOOL; n : INT; END_VAR INITIAL_STEP A: END_STEP STEP B: END_STEP\n"
           "TRANSITION FROM A TO B := " +
           condition + "; END_TRANSITION\nTRANSITION FROM B TO A := x; END_TRANSITION END_PROGRAM";
  };
  for (const char* condition : {"5", "n", "n + 1"}) {
    EXPECT_THAT(wrong(chart(condition)), HasSubstr("error: Main: the condition of a transition is a BOOL, not an INT"))
        << condition;
  }
  EXPECT_EQ(wrong(chart("n > 5 AND x")), "");
}

TEST(PlcMistakes, Properties_of_tasks_are_said_one_by_one) {
  const auto task = [](const std::string& properties) {
    return "PROGRAM Main VAR x : BOOL; END_VAR x := NOT x; END_PROGRAM CONFIGURATION c VAR_GLOBAL g : BOOL; END_VAR "
           "RESOURCE r ON pc TASK t (" +
           properties + "); PROGRAM p WITH t : Main; END_RESOURCE END_CONFIGURATION";
  };
  struct Row {
    const char* properties;
    const char* message;
  };
  for (const auto& [properties, message] : {
           Row{"INTERVAL := T#0s, PRIORITY := 1", "INTERVAL is 0 and SINGLE is not given, so this task never runs"},
           Row{"INTERVAL := 10, PRIORITY := 1", "INTERVAL is a time such as T#10ms"},
           Row{"INTERVAL := T#-1s, PRIORITY := 1", "INTERVAL is a time such as T#10ms"},
           Row{"INTERVAL := T#1s, PRIORITY := -1", "PRIORITY is a whole number from 0"},
           Row{"INTERVAL := T#1s, PRIORITY := 1.5", "PRIORITY is a whole number from 0"},
           Row{"SINGLE := 3, INTERVAL := T#1s", "SINGLE is a global variable or an address"},
           Row{"INTERVAL := T#1s, FOO := 1", "a task has no 'FOO', only INTERVAL, PRIORITY and SINGLE"},
       }) {
    const Compiled sut = compiled(task(properties));
    EXPECT_FALSE(sut.ok) << properties;
    EXPECT_EQ(sut.diagnostics.size(), 1U) << properties << '\n' << messages(sut);
    EXPECT_THAT(messages(sut), HasSubstr(message));
  }
  const Compiled events = compiled(task("SINGLE := g, INTERVAL := T#0s, PRIORITY := 1"));
  ASSERT_TRUE(events.ok) << "IEC 61131-3, 6.8.2: of events only" << messages(events);
  EXPECT_THAT(written(events), HasSubstr("sporadic</operationtype>\n    <deadline>10ms</deadline>"))
      << "without it no node takes the module";
}

TEST(PlcMistakes, Globals_with_a_mistake_are_no_further_ones_where_they_are_used) {
  struct Row {
    const char* text;
    const char* message;
  };
  const std::string main = "PROGRAM Main VAR i : INT; END_VAR i := N + 1; END_PROGRAM";
  for (const auto& [text, message] : {
           Row{"VAR_GLOBAL CONSTANT N : INT := M + 1; M : INT := N; END_VAR ",
               "a constant cannot need its own value: N -> M -> N"},
           Row{"VAR_GLOBAL N : STRUCT a : INT; END_STRUCT; END_VAR ", "a STRUCT needs a name"},
           Row{"VAR_GLOBAL N : INT := 'a'; END_VAR ", "is not converted"},
       }) {
    const Compiled sut = compiled(text + main);
    EXPECT_FALSE(sut.ok) << text;
    EXPECT_EQ(sut.diagnostics.size(), 1U) << text << '\n' << messages(sut);
    EXPECT_THAT(messages(sut), HasSubstr(message));
  }
}

TEST(PlcMistakes, Instances_of_an_unknown_block_are_no_further_ones_where_they_are_used) {
  const Compiled sut = compiled(
      "PROGRAM Main VAR f : Unknown; i : INT; END_VAR f(a := 1); i := f.Go(x := 1) + f.out; IF f.Go() THEN f.x := i; "
      "END_IF; END_PROGRAM");
  EXPECT_EQ(sut.diagnostics.size(), 1U) << messages(sut);
  EXPECT_THAT(messages(sut), HasSubstr("there is no type and no function block 'Unknown'"));
}

TEST(PlcMistakes, A_type_may_say_who_sees_it) {
  EXPECT_EQ(
      wrong("TYPE INTERNAL Light : (Red, Green); END_TYPE TYPE internal : INT; END_TYPE PROGRAM Main VAR l : Light; "
            "k : internal; END_VAR l := Green; k := 1; END_PROGRAM"),
      "");
}

TEST(PlcMistakes, Places_of_an_array_are_no_variables_of_their_own) {
  const std::string rest = " list[2] := x; END_PROGRAM";
  EXPECT_THAT(wrong("PROGRAM Main VAR list AT %MW10 : ARRAY[0..9] OF INT; x AT %MW12 : INT; END_VAR" + rest),
              HasSubstr("'x' and 'list' at %MW10 share places"));
  EXPECT_THAT(wrong("PROGRAM Main VAR x AT %MW12 : INT; list AT %MW10 : ARRAY[0..9] OF INT; END_VAR" + rest),
              HasSubstr("'list' and 'x' at %MW12 share places"));
  EXPECT_EQ(wrong("PROGRAM Main VAR x AT %MW20 : INT; list AT %MW10 : ARRAY[0..9] OF INT; END_VAR" + rest), "");
}

TEST(PlcMistakes, What_is_named_from_outside_is_there_and_fits) {
  struct Row {
    const char* text;
    const char* message;
  };
  const auto program = [](const std::string& access, const std::string& connections, const std::string& task) {
    return "VAR_GLOBAL number : REAL; code : INT; END_VAR PROGRAM P VAR_INPUT k : INT; END_VAR VAR i AT %IW0 : INT; t "
           ": "
           "TON; list : ARRAY[1..3] OF INT; END_VAR VAR_TEMP now : INT; END_VAR now := k + i + list[1]; t(IN := now > "
           "3); END_PROGRAM CONFIGURATION c " +
           (access.empty() ? "" : "VAR_ACCESS " + access + " END_VAR ") + "RESOURCE r ON pc TASK t (" + task +
           "); PROGRAM p WITH t : P" + (connections.empty() ? "" : " (" + connections + ")") +
           "; END_RESOURCE END_CONFIGURATION";
  };
  const std::string every = "INTERVAL := T#1ms";
  for (const auto& [text, message] : {
           Row{"a : p.zz : INT;", "P has no variable 'zz'"},
           Row{"a : q.k : INT;", "there is no program or global"},
           Row{"a : p.k : DINT;", "the variable is an INT"},
           Row{"a : p : INT;", "is a program"},
           Row{"a : p.t : TON;", "cannot be seen from outside"},
           Row{"a : p.now : INT;", "is there only while P runs"},
           Row{"a : p.list[4] : INT;", "outside of 1..3"},
           Row{"a : p.k[1] : INT;", "no array"},
           Row{"a : p.i : INT READ_WRITE;", "an input is not written"},
           Row{"code : p.k : INT;", "there is a variable 'code' already"},
           Row{"a : p.k : INT; a : p.k : INT;", "there is a variable 'a' already"},
       }) {
    EXPECT_THAT(wrong(program(text, "", every)), HasSubstr(message)) << text;
  }
  for (const auto& [text, message] : {
           Row{"z := code", "P has no input 'z'"},
           Row{"k := number", "a REAL is not given to an INT"},
           Row{"k := 5.5", "5.5 does not fit INT"},
           Row{"k := code, k := 5", "connected twice"},
           Row{"t WITH t", "a task of its own for a function block"},
           Row{"k => code", "P has no output 'k'"},
       }) {
    EXPECT_THAT(wrong(program("", text, every)), HasSubstr(message)) << text;
  }
  const Compiled sut = compiled(program("", "", "SINGLE := number"));
  EXPECT_EQ(sut.diagnostics.size(), 1U) << messages(sut);
  EXPECT_THAT(messages(sut), HasSubstr("no global variable of this name that is a BOOL"));
}

TEST(PlcMistakes, A_type_that_is_not_there_is_the_only_message_of_who_returns_it) {
  const Compiled sut = compiled(
      "FUNCTION_BLOCK F VAR x : INT; END_VAR PROPERTY P : REFERENCE TO Nothing GET P REF= x; END_GET END_PROPERTY "
      "METHOD M : Nothing M := x; END_METHOD END_FUNCTION_BLOCK "
      "PROGRAM Main VAR f : F; END_VAR f(); END_PROGRAM");
  EXPECT_FALSE(sut.ok);
  EXPECT_THAT(messages(sut), Not(HasSubstr("recursion")));
  EXPECT_THAT(messages(sut), Not(HasSubstr("no SET")));
}

TEST(PlcMistakes, A_text_without_its_end_says_how_it_is_read) {
  const std::string text = "PROGRAM Main\nVAR i : INT; END_VAR\ni := 1;\n";
  EXPECT_THAT(wrong(text), HasSubstr("the PROGRAM of line 1 has no END_PROGRAM; add it"));
  EXPECT_THAT(wrong(text), HasSubstr("--dialect codesys"));
}

TEST(PlcMistakes, A_file_that_is_not_there_is_the_only_message) {
  CompileOptions options;
  options.files = {"in.st", "gone.st"};
  const Compiled sut = compile(options, [](const std::string& name) {
    return name == "in.st" ? glb2idl::ReadResult{"PROGRAM Main VAR m : Motor; END_VAR m(); END_PROGRAM", name, ""}
                           : glb2idl::ReadResult{std::nullopt, name, "there is no such file"};
  });
  EXPECT_FALSE(sut.ok);
  EXPECT_EQ(sut.diagnostics.size(), 1U) << messages(sut);
  EXPECT_THAT(messages(sut), HasSubstr("gone.st: error: cannot read the file: there is no such file"));
}

// Whether 2 is meant for a or for c cannot be known.
TEST(PlcMistakes, A_value_in_the_place_of_an_input_that_was_given_by_name) {
  const std::string text =
      "FUNCTION F : INT VAR_INPUT a, b, c : INT; END_VAR F := a + b + c; END_FUNCTION "
      "PROGRAM Main VAR x : INT; END_VAR x := F(b := 1, 2); END_PROGRAM";
  EXPECT_THAT(wrong(text), HasSubstr("b is given twice, remove one of them"));
}

TEST(PlcMistakes, What_is_missing_or_misused_is_named) {
  const auto main = [](const std::string& variables, const std::string& body) {
    return "PROGRAM Main VAR i : INT; b : BOOL; " + variables + " END_VAR " + body + " END_PROGRAM";
  };
  EXPECT_THAT(wrong(main("p : MC_Power;", "p();")),
              HasSubstr("are in motion.st of share/indurop/plc, name that file too"));
  EXPECT_THAT(wrong(main("", "b := TON(IN := b, PT := T#1s);")),
              HasSubstr("TON is a function block: declare an instance"));
  EXPECT_THAT(wrong(main("", "b := TON(IN := b, PT := T#1s);")), Not(HasSubstr("TAN")));
}

TEST(PlcMistakes, Of_CODESYS_is_taken_what_it_takes) {
  CompileOptions options;
  options.files = {"in.st"};
  options.name = "sut";
  options.dialect = Dialect::Codesys;
  const auto said = [&](const std::string& text) {
    const Compiled made = compile(options, [&](const std::string& name) {
      return glb2idl::ReadResult{text, name, ""};
    });
    return (made.ok ? "fine\n" : "refused\n") + messages(made);
  };
  EXPECT_THAT(said("PROGRAM Main VAR i : INT; s : STRING; t : Standard.TON; END_VAR i := 10#500 + Standard.LEN(s); "
                   "t(IN := TRUE); i := 2 ** 3; END_PROGRAM"),
              HasSubstr("fine"));
  EXPECT_THAT(said("TYPE Nothing : STRUCT END_STRUCT END_TYPE PROGRAM Main VAR n, m : Nothing; END_VAR n := m; "
                   "END_PROGRAM"),
              ::testing::AllOf(HasSubstr("fine"), HasSubstr("Nothing has no fields")));
  EXPECT_THAT(said("PROGRAM Main VAR i : INT; END_VAR FOR i := 1 TO 9 DO IF i = 5 THEN i := 9; END_IF; END_FOR; "
                   "END_PROGRAM"),
              ::testing::AllOf(HasSubstr("fine"), HasSubstr("this changes the variable of the FOR at in.st:1:35")));
}

}  // namespace
}  // namespace indurop::plc
