// SPDX-License-Identifier: Apache-2.0
// What object orientation refuses: one error, with its place.

#include <gmock/gmock.h>

#include "tests/unit/control/plc/front/compiled.h"

namespace indurop::plc {
namespace {

using testing::compiled;
using ::testing::HasSubstr;
using testing::messages;
using testing::written;
using testing::wrong;

// Lines 1 to 11.
constexpr const char* kDrive = R"(INTERFACE IDrive
  METHOD Start : BOOL VAR_INPUT speed : INT; END_VAR END_METHOD
  PROPERTY Speed : INT GET END_GET END_PROPERTY
END_INTERFACE
FUNCTION_BLOCK Drive IMPLEMENTS IDrive VAR_INPUT in : INT; e : BOOL R_EDGE; END_VAR VAR_OUTPUT out : INT; END_VAR VAR n : INT; END_VAR
  VAR PRIVATE own : INT; END_VAR VAR_IN_OUT io : INT; END_VAR VAR_TEMP tmp : INT; END_VAR
  METHOD Start : BOOL VAR_INPUT speed : INT; END_VAR n := speed; own := n; Start := TRUE; END_METHOD
  METHOD PRIVATE Hidden n := 1; END_METHOD   METHOD PROTECTED Inner Hidden(); END_METHOD   METHOD FINAL Last n := 2; END_METHOD
  PROPERTY Speed : INT GET Speed := n; END_GET END_PROPERTY   PROPERTY Goal : INT SET n := Goal; END_SET END_PROPERTY
  out := in; io := tmp; tmp := BOOL_TO_INT(e);
END_FUNCTION_BLOCK
)";
constexpr const char* kObjectsMain = "PROGRAM Main VAR d : Drive; i : IDrive; x : INT; b : BOOL; END_VAR\n";

struct Row {
  std::string text;
  const char* message;
};

void expect_one_error(const Row& row) {
  const Compiled sut = compiled(kDrive + row.text + "\n");
  std::size_t errors = 0;
  for (const base::Diagnostic& one : sut.diagnostics) {
    errors += one.severity == base::Diagnostic::Severity::Error ? 1U : 0U;
  }
  EXPECT_FALSE(sut.ok) << row.text;
  EXPECT_EQ(errors, 1U) << row.text << '\n' << messages(sut);
  EXPECT_THAT(messages(sut), HasSubstr(row.message)) << row.text;
}

std::string main_with(const std::string& code) {
  return kObjectsMain + code + " END_PROGRAM";
}

// A function block that extends Drive; `code` stands before its body.
std::string derived(const std::string& code) {
  return "FUNCTION_BLOCK Servo EXTENDS Drive\n" + code + "\nEND_FUNCTION_BLOCK\n" + main_with("d(io := x);");
}

TEST(PlcObjects, What_is_there_compiles) {
  const Compiled sut = compiled(kDrive + derived("METHOD Start : BOOL VAR_INPUT speed : INT; END_VAR Start := "
                                                 "SUPER^.Start(speed); Inner(); END_METHOD"));
  EXPECT_TRUE(sut.ok) << messages(sut);
}

TEST(PlcObjects, Calls_that_are_not_possible) {
  for (const Row& row : {
           Row{main_with("d.Strat(3);"), "in.st:13:1: error: Main: Drive has no method 'Strat', did you mean 'Start'?"},
           Row{main_with("i.Stop();"), "IDrive has no method 'Stop'"},
           Row{main_with("b := d.Start();"), ""},
           Row{main_with("d.Start(1, 2);"), "Start has only 1 inputs and outputs"},
           Row{main_with("d.Start(sped := 1);"), "Start has no input 'sped', did you mean 'speed'?"},
           Row{main_with("d.Start(n := 1);"), "Start has no input 'n'"},
           Row{main_with("d.Start(speed := TRUE);"), "a BOOL is not converted to an INT automatically"},
           Row{main_with("x := d.Start(1);"), "a BOOL is not converted to an INT"},
           Row{main_with("d.Hidden();"), "Drive.Hidden is PRIVATE, only Drive itself may use it"},
           Row{main_with("d.Inner();"), "Drive.Inner is PROTECTED, only Drive and what extends it may use it"},
           Row{main_with("d.Speed := 5;"), "the PROPERTY Speed has no SET, so it cannot be written"},
           Row{main_with("x := d.Goal;"), "the PROPERTY Goal has no GET, so it cannot be read"},
           Row{main_with("d.Goal := TRUE;"), "a BOOL is not converted to an INT"},
           Row{main_with("d.Speed.3 := TRUE;"), ""},
           Row{main_with("x := d.Wheels;"), "Drive has no input or output 'Wheels'"},
           Row{main_with("i := x;"), "an INT is not an IDrive, use an instance that implements it, or NULL"},
           Row{"FUNCTION_BLOCK Pump VAR k : INT; END_VAR k := 1; END_FUNCTION_BLOCK\nPROGRAM Main VAR p : Pump; i : "
               "IDrive; "
               "END_VAR i := p; END_PROGRAM",
               "Pump does not implement IDrive, write IMPLEMENTS IDrive in its declaration"},
           Row{main_with("THIS^.x := 1;"), "THIS is for function blocks and their methods"},
           Row{main_with("i();"), ""},
       }) {
    if (row.message[0] != '\0') {
      expect_one_error(row);
    }
  }
}

TEST(PlcObjects, What_extends_and_implements) {
  const std::string main = "\nEND_FUNCTION_BLOCK\n" + main_with("d(io := x);");
  for (const Row& row : {
           Row{"FUNCTION_BLOCK A EXTENDS Drvie" + main,
               "in.st:12:26: error: there is no function block or class 'Drvie', did you mean 'Drive'?"},
           Row{"FUNCTION_BLOCK A EXTENDS IDrive" + main, "of interfaces say IMPLEMENTS, and IDrive is none"},
           Row{"FUNCTION_BLOCK A IMPLEMENTS Drive" + main, "IMPLEMENTS names an INTERFACE, and Drive is none"},
           Row{"FUNCTION_BLOCK A EXTENDS A" + main, "A extends itself, remove this EXTENDS"},
           Row{"FUNCTION_BLOCK FINAL B END_FUNCTION_BLOCK FUNCTION_BLOCK A EXTENDS B" + main,
               "B is FINAL, nothing extends it"},
           Row{"FUNCTION_BLOCK B END_FUNCTION_BLOCK FUNCTION_BLOCK A EXTENDS B, Drive" + main, "A extends B already"},
           Row{"FUNCTION_BLOCK A IMPLEMENTS IDrive" + main,
               "in.st:12:16: error: A does not have the METHOD Start of IDrive, GET of the PROPERTY Speed of IDrive; "
               "write it"},
           Row{"FUNCTION_BLOCK ABSTRACT B METHOD ABSTRACT Go END_METHOD END_FUNCTION_BLOCK FUNCTION_BLOCK A EXTENDS B" +
                   main,
               "A does not have the METHOD Go of B; write it, or declare A as ABSTRACT"},
           Row{"FUNCTION_BLOCK A METHOD ABSTRACT Go END_METHOD" + main,
               "Go is ABSTRACT, so A has to be: FUNCTION_BLOCK ABSTRACT A"},
           Row{"FUNCTION_BLOCK A METHOD Go END_METHOD METHOD go END_METHOD" + main, "'go' is already declared at"},
           Row{"FUNCTION_BLOCK A VAR go : INT; END_VAR METHOD Go END_METHOD" + main,
               "'Go' is the name of the variable at in.st:12:22 too"},
           Row{"FUNCTION_BLOCK A METHOD Go VAR t : TON; END_VAR t(); END_METHOD" + main,
               "a METHOD has no memory for function blocks"},
           Row{"FUNCTION_BLOCK A METHOD Go : INT Go := Back(); END_METHOD METHOD Back : INT Back := THIS^.Go(); "
               "END_METHOD" +
                   main,
               "recursion is not possible: A.Go -> A.Back -> A.Go"},
           Row{"CLASS C METHOD Go END_METHOD END_CLASS FUNCTION_BLOCK A VAR c : C; END_VAR c();" + main,
               "C has no body, call a method"},
           Row{"FUNCTION_BLOCK ABSTRACT B END_FUNCTION_BLOCK FUNCTION_BLOCK A VAR list : ARRAY[1..2] OF B; END_VAR" +
                   main,
               "B is ABSTRACT and has no instances"},
           Row{"INTERFACE I2 METHOD Go Go := 1; END_METHOD END_INTERFACE FUNCTION_BLOCK A" + main,
               "has no statements, because it is of an INTERFACE"},
           Row{"INTERFACE I2 METHOD Speed END_METHOD END_INTERFACE FUNCTION_BLOCK A VAR i : I2; END_VAR IF i = 5 THEN "
               "i.Speed(); END_IF;" +
                   main,
               "cannot be compared"},
       }) {
    expect_one_error(row);
  }
}

TEST(PlcObjects, Values_for_FB_Init) {
  const std::string main = "\nEND_FUNCTION_BLOCK\n" + main_with("d(io := x);");
  for (const Row& row : {
           Row{"FUNCTION_BLOCK A METHOD FB_Init : BOOL VAR_INPUT r : BOOL; END_VAR END_METHOD" + main,
               "FB_Init begins with the inputs bInitRetains : BOOL; bInCopyCode : BOOL;"},
           Row{"FUNCTION_BLOCK B METHOD FB_Init : BOOL VAR_INPUT r, c : BOOL; k : INT; END_VAR END_METHOD "
               "END_FUNCTION_BLOCK FUNCTION_BLOCK A VAR b : B; END_VAR" +
                   main,
               "FB_Init of B wants values where an instance is declared: B(k := ...)"},
           Row{"FUNCTION_BLOCK B METHOD FB_Init : BOOL VAR_INPUT r, c : BOOL; k : INT; END_VAR END_METHOD "
               "END_FUNCTION_BLOCK FUNCTION_BLOCK A EXTENDS B METHOD FB_Init : BOOL VAR_INPUT r, c : BOOL; END_VAR "
               "END_METHOD" +
                   main,
               "FB_Init of B wants 'k', so this one has that input too"},
           Row{"FUNCTION_BLOCK B END_FUNCTION_BLOCK FUNCTION_BLOCK A VAR b : B(5); END_VAR" + main,
               "B has no METHOD FB_Init that takes values"},
           Row{"FUNCTION_BLOCK B METHOD FB_Init : BOOL VAR_INPUT r, c : BOOL; k : INT; END_VAR END_METHOD "
               "END_FUNCTION_BLOCK FUNCTION_BLOCK A VAR b : ARRAY[1..3] OF B[(1), (2)]; END_VAR" +
                   main,
               "values for FB_Init of 2 instances are given, and there are 3"},
           Row{"FUNCTION_BLOCK A VAR b : TON(5); END_VAR" + main, "TON has no METHOD FB_Init that takes values"},
       }) {
    expect_one_error(row);
  }
}

TEST(PlcObjects, What_replaces_is_like_what_it_replaces) {
  for (const Row& row : {
           Row{derived("METHOD Start : INT VAR_INPUT speed : INT; END_VAR Start := 1; END_METHOD"),
               "METHOD Start is not that of Drive that it stands for: there its result is a BOOL"},
           Row{derived("METHOD Start : BOOL VAR_INPUT speed : DINT; END_VAR END_METHOD"),
               "there its parameter speed is an INT"},
           Row{derived("METHOD Start : BOOL VAR_INPUT fast : INT; END_VAR END_METHOD"),
               "there its parameter 1 is speed"},
           Row{derived("METHOD Start : BOOL VAR_IN_OUT speed : INT; END_VAR END_METHOD"),
               "there its parameter 1 is speed"},
           Row{derived("METHOD Start : BOOL VAR_INPUT speed, more : INT; END_VAR END_METHOD"), "there it has no more"},
           Row{derived("METHOD Last END_METHOD"), "METHOD Last of Drive is FINAL"},
           Row{derived("METHOD Hidden END_METHOD"), "METHOD Hidden of Drive is PRIVATE"},
           Row{derived("METHOD OVERRIDE Stop END_METHOD"),
               "OVERRIDE, but nothing that Servo extends has a METHOD Stop"},
           Row{derived("METHOD PRIVATE Inner END_METHOD"), "fewer may call it than that of Drive"},
           Row{derived("VAR n : BOOL; END_VAR"), "'n' is inherited from Drive"},
           Row{derived("VAR Start : BOOL; END_VAR"), "'Start' is inherited from Drive"},
           Row{derived("METHOD Go SUPER^.Hidden(); END_METHOD"), "Drive.Hidden is PRIVATE"},
           Row{derived("own := 1;"), "'own' is PRIVATE of Drive, declare it as PROTECTED there"},
           Row{derived("in := tmp;"), "'tmp' is VAR_TEMP of Drive, which only its body sees"},
           Row{derived("METHOD Go io := 1; END_METHOD"),
               "'io' is VAR_IN_OUT of Drive, which only its body sees; give it to the method as a parameter"},
           Row{derived("METHOD Go IF e THEN n := 1; END_IF; END_METHOD"), "'e' is an input with an edge of Drive"},
           Row{"FUNCTION_BLOCK Alone METHOD Go SUPER^.Go(); END_METHOD END_FUNCTION_BLOCK\n" + main_with("d(io := x);"),
               "Alone extends nothing, so there is no SUPER"},
           Row{"FUNCTION_BLOCK ABSTRACT B METHOD ABSTRACT Go END_METHOD END_FUNCTION_BLOCK FUNCTION_BLOCK A EXTENDS B "
               "METHOD Go "
               "SUPER^.Go(); END_METHOD END_FUNCTION_BLOCK\n" +
                   main_with("d(io := x);"),
               "B.Go is ABSTRACT, there is nothing to call"},
       }) {
    expect_one_error(row);
  }
}

TEST(PlcObjects, A_call_that_runs_no_statement_is_a_warning) {
  const Compiled sut = compiled(std::string(kDrive) +
                                "FUNCTION_BLOCK Servo EXTENDS Drive END_FUNCTION_BLOCK\n"
                                "PROGRAM Main VAR s : Servo; x : INT; END_VAR s(io := x); END_PROGRAM\n");
  EXPECT_TRUE(sut.ok) << messages(sut);
  EXPECT_THAT(messages(sut), HasSubstr("Servo has no statements, so this call runs none; to run those of Drive, write "
                                       "SUPER^(); in Servo"));
}

TEST(PlcObjects, A_property_read_alone_does_what_its_GET_does) {
  const std::string block =
      "FUNCTION_BLOCK M VAR_OUTPUT n : INT; END_VAR PROPERTY Next : INT GET n := n + 1; Next := n; END_GET "
      "END_PROPERTY END_FUNCTION_BLOCK ";
  const Compiled sut = compiled(block + "PROGRAM Main VAR m : M; END_VAR m(); m.Next; END_PROGRAM");
  EXPECT_TRUE(sut.ok) << messages(sut);
  EXPECT_THAT(written(sut), HasSubstr("(m.getter_NEXT());"));
  const std::string nothing = block + "PROGRAM Main VAR m : M; END_VAR m(); m.n; END_PROGRAM";
  EXPECT_THAT(wrong(nothing), HasSubstr("a value alone does nothing"));
  CompileOptions options;
  options.files = {"in.st"};
  options.dialect = Dialect::Codesys;
  const Compiled editor = compile(options, [&](const std::string& name) {
    return glb2idl::ReadResult{nothing, name, ""};
  });
  EXPECT_TRUE(editor.ok) << messages(editor);
  EXPECT_THAT(messages(editor), HasSubstr("warning: Main: a value alone does nothing"));
}

}  // namespace
}  // namespace indurop::plc
