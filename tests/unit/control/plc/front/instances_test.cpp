// SPDX-License-Identifier: Apache-2.0
// What of instances is shared: RETAIN of them and in them, AT %I* in function blocks; instances as inputs; programs
// that others use by their names.

#include <gmock/gmock.h>

#include "tests/unit/control/plc/front/compiled.h"

namespace indurop::plc {
namespace {

using testing::compiled;
using ::testing::HasSubstr;
using testing::messages;
using ::testing::Not;
using testing::written;
using testing::wrong;

constexpr const char* kPump = R"(FUNCTION_BLOCK Pump
VAR_INPUT go : BOOL R_EDGE; END_VAR
VAR_OUTPUT starts : INT; END_VAR
VAR RETAIN hours : DINT := 7; END_VAR
VAR NON_RETAIN last : BOOL; END_VAR
VAR level AT %IW* : INT; open AT %Q* : BOOL; END_VAR
  IF go THEN starts := starts + 1; hours := hours + level; END_IF;
  open := starts > 3;
  last := go;
END_FUNCTION_BLOCK
)";

Compiled codesys(const std::string& text) {
  CompileOptions options;
  options.files = {"in.st"};
  options.name = "sut";
  options.dialect = Dialect::Codesys;
  return compile(options, [&](const std::string& name) { return glb2idl::ReadResult{text, name, ""}; });
}

TEST(PlcInstances, What_is_RETAIN_in_a_function_block_is_kept_for_each_instance) {
  const Compiled sut = compiled(std::string(kPump) + R"(PROGRAM Main
VAR one : Pump; more : ARRAY[-1..0] OF Pump; END_VAR
  one(go := TRUE);
  more[0](go := one.starts > 3);
  more[-1](go := FALSE);
END_PROGRAM
)");
  ASSERT_TRUE(sut.ok) << messages(sut);
  EXPECT_THAT(sut.glb, HasSubstr("int32_t Main_one_hours @retain = 7;"));
  EXPECT_THAT(sut.glb, HasSubstr("int32_t Main_more_m1_hours @retain = 7;"));
  EXPECT_THAT(sut.glb, HasSubstr("int32_t Main_more_0_hours @retain = 7;"));
  EXPECT_THAT(sut.glb, Not(HasSubstr("starts")));
  EXPECT_THAT(sut.modules.at(0).cpp,
              HasSubstr("SharedWord{&INDUROP_TYPEOF(::sut::Main_more_m1_hours)::tag_type::ref(), "
                        "&instance_Main.more[0].hours}"));
}

TEST(PlcInstances, AT_a_place_to_be_given_is_a_shared_variable_of_each_instance) {
  const Compiled sut = compiled(std::string(kPump) + R"(VAR_GLOBAL all : Pump; END_VAR
PROGRAM Main
VAR one : Pump; END_VAR
  one(go := TRUE);
  all(go := FALSE);
END_PROGRAM
)");
  ASSERT_TRUE(sut.ok) << messages(sut);
  EXPECT_THAT(sut.glb, HasSubstr("int16_t Main_one_level;  // %I*"));
  EXPECT_THAT(sut.glb, HasSubstr("bool all_open;  // %Q*"));
  const std::string& cpp = sut.modules.at(0).cpp;
  EXPECT_THAT(cpp, HasSubstr("(::sut::all_level)::tag_type::ref(), &plc::all.level}"));
  EXPECT_THAT(cpp, HasSubstr("(::sut::Main_one_open)::tag_type::ref(), &instance_Main.one.open}"));
  EXPECT_THAT(cpp, HasSubstr("iec::SharedWords<std::uint8_t, 2, 2> words_1{table_1};")) << "both are written";
  EXPECT_THAT(cpp, HasSubstr("iec::SharedWords<std::uint16_t, 2, 0> words_2{table_2};")) << "none is written";
}

// VAR_CONFIG of the configuration, or as CODESYS has it.
TEST(PlcInstances, The_configuration_gives_places_and_initial_values) {
  const std::string program = std::string(kPump) + R"(PROGRAM Main
VAR one : Pump; own AT %IX* : BOOL; limit : INT := 1; last AT %Q* : BOOL; direct : BOOL; END_VAR
  one(go := own);
  last := one.starts > limit;
  direct := %QX2.0;
END_PROGRAM
)";
  const std::string resource = "RESOURCE r ON pc TASK t (INTERVAL := T#1ms); PROGRAM plc WITH t : Main; END_RESOURCE ";
  const Compiled sut = compiled(program + "CONFIGURATION c " + resource +
                                "VAR_CONFIG r.plc.own AT %IX1.0 : BOOL; plc.limit : INT := 7; r.plc.one.level AT %IW3 "
                                ": INT; plc.one.open AT %QX2.0 : BOOL; END_VAR END_CONFIGURATION");
  ASSERT_TRUE(sut.ok) << messages(sut);
  EXPECT_THAT(sut.glb, HasSubstr("bool own;  // %IX1.0"));
  EXPECT_THAT(sut.glb, HasSubstr("int16_t IW3;  // %IW3"));
  EXPECT_THAT(sut.glb, HasSubstr("bool QX2_0;  // %QX2.0"));
  EXPECT_THAT(sut.glb, Not(HasSubstr("plc_one_level")));
  EXPECT_THAT(sut.glb, Not(HasSubstr("plc_one_open")));
  EXPECT_THAT(written(sut), HasSubstr("limit = std::int16_t{7};"));
  EXPECT_THAT(written(sut), HasSubstr("(::sut::IW3)::tag_type::ref(), &instance_plc.one.level}"));
  const auto refused = [&](const std::string& entry) {
    return wrong(program + "CONFIGURATION c " + resource + "VAR_CONFIG " + entry + " END_VAR END_CONFIGURATION");
  };
  EXPECT_THAT(refused("r.plc.limit AT %IW0 : INT;"), HasSubstr("limit gets a place of %I only if it is declared as"));
  EXPECT_THAT(refused("r.plc.own AT %QX0.0 : BOOL;"), HasSubstr("own gets a place of %Q only if it is declared as"));
  EXPECT_THAT(refused("r.plc.none AT %QX0.0 : BOOL;"), HasSubstr("Main has no variable 'none'"));
  EXPECT_THAT(refused("r.plc.limit : REAL := 1.0;"), HasSubstr("limit is an INT where it is declared"));
  EXPECT_THAT(refused("r.other.limit : INT := 1;"),
              HasSubstr("there is no program 'r', write resource.program.variab"));
  EXPECT_THAT(refused("r.plc.limit.x : INT := 1;"), HasSubstr("limit is no instance of a function block"));
  EXPECT_THAT(refused("r.plc.one.level AT %IW3 : INT := 3;"), HasSubstr("level gets its place here, and its initial"));
  const auto two = [&](const std::string& entry) {
    return wrong(program +
                 "CONFIGURATION c RESOURCE r ON pc TASK t (INTERVAL := T#1ms); PROGRAM plc WITH t : Main; "
                 "PROGRAM again WITH t : Main; END_RESOURCE VAR_CONFIG " +
                 entry + " END_VAR END_CONFIGURATION");
  };
  EXPECT_THAT(two("r.plc.limit : INT := 7;"), HasSubstr("plc and again are of one program")) << "both would begin so";
  EXPECT_THAT(two("r.again.own AT %IX1.0 : BOOL;"), HasSubstr("again and plc are of one program"));
  EXPECT_EQ(two("r.plc.one.level AT %IW3 : INT; r.again.one.level AT %IW4 : INT;"), "");
  const Compiled editor = codesys(program + "VAR_CONFIG Main.one.level AT %IW5 : INT; END_VAR");
  ASSERT_TRUE(editor.ok) << messages(editor);
  EXPECT_THAT(editor.glb, HasSubstr("int16_t IW5;  // %IW5"));
}

TEST(PlcInstances, Inputs_of_instances_are_not_written) {
  EXPECT_THAT(wrong("FUNCTION_BLOCK F VAR x AT %I* : INT; END_VAR x := 1; END_FUNCTION_BLOCK\n"
                    "PROGRAM Main VAR f : F; END_VAR f(); END_PROGRAM"),
              HasSubstr("is an input, which only the world outside changes"));
}

TEST(PlcInstances, Places_are_refused_where_an_instance_has_none) {
  EXPECT_THAT(wrong(std::string(kPump) + "FUNCTION_BLOCK F VAR_STAT p : Pump; END_VAR p(); END_FUNCTION_BLOCK\n"
                                         "PROGRAM Main VAR f : F; END_VAR f(); END_PROGRAM"),
              HasSubstr("Pump has variables AT %I* or %Q*, which only an instance in VAR"));
  EXPECT_THAT(wrong("FUNCTION F : INT VAR x AT %I* : INT; END_VAR F := x; END_FUNCTION\n"
                    "PROGRAM Main VAR k : INT; END_VAR k := F(); END_PROGRAM"),
              HasSubstr("AT %I* has no place in a call"));
}

TEST(PlcInstances, Instances_can_be_RETAIN) {
  const Compiled sut = compiled(std::string(kPump) + R"(VAR_GLOBAL RETAIN meter : CTU := (PV := 9); END_VAR
PROGRAM Main
VAR RETAIN timer : TON; pump : Pump; END_VAR
  timer(IN := TRUE, PT := T#1h);
  pump(go := timer.Q);
  meter(CU := pump.starts > 2);
END_PROGRAM
)");
  ASSERT_TRUE(sut.ok) << messages(sut);
  EXPECT_THAT(sut.glb, HasSubstr("int64_t Main_timer_ET @unit(\"ns\") @retain;"));
  EXPECT_THAT(sut.glb, HasSubstr("int16_t meter_PV @retain = 9;"));
  EXPECT_THAT(sut.glb, HasSubstr("int16_t Main_pump_starts @retain;"));
  EXPECT_THAT(sut.glb, Not(HasSubstr("last")));
  const std::string& cpp = sut.modules.at(0).cpp;
  EXPECT_THAT(cpp, HasSubstr("iec::restore(instance_Main.timer, scan);"));
  EXPECT_THAT(cpp, HasSubstr("iec::restore(plc::meter, scan);"));
  EXPECT_THAT(cpp, HasSubstr("instance_Main.pump.go_before = instance_Main.pump.go;"));
}

TEST(PlcInstances, An_inherited_variable_can_be_RETAIN) {
  const Compiled sut = compiled(R"(FUNCTION_BLOCK Base
VAR RETAIN n : INT; END_VAR
METHOD PUBLIC Go n := n + 1; END_METHOD
END_FUNCTION_BLOCK
FUNCTION_BLOCK Wide EXTENDS Base
VAR RETAIN m : INT; END_VAR
  Go();
  m := n;
END_FUNCTION_BLOCK
PROGRAM Main VAR w : Wide; END_VAR w(); END_PROGRAM
)");
  ASSERT_TRUE(sut.ok) << messages(sut);
  EXPECT_THAT(sut.glb, HasSubstr("int16_t Main_w_n @retain;"));
  EXPECT_THAT(sut.glb, HasSubstr("int16_t Main_w_m @retain;"));
}

TEST(PlcInstances, What_cannot_be_kept_is_said) {
  EXPECT_THAT(wrong("PROGRAM Main VAR RETAIN p : POINTER TO INT; END_VAR p := NULL; END_PROGRAM"),
              HasSubstr("a POINTER TO INT cannot be kept over a restart"));
  EXPECT_THAT(messages(compiled("PROGRAM Main VAR RETAIN p : PID; END_VAR p(AUTO := TRUE); END_PROGRAM")),
              HasSubstr("warning: of PID only inputs and outputs are kept over a restart"));
}

TEST(PlcInstances, An_input_that_is_an_instance_is_not_called) {
  EXPECT_THAT(wrong("FUNCTION_BLOCK F VAR_INPUT t : TON; END_VAR t(IN := TRUE); END_FUNCTION_BLOCK\n"
                    "PROGRAM Main VAR f : F; t : TON; END_VAR f(t := t); END_PROGRAM"),
              HasSubstr("'t' is an input, a copy of the instance that was given"));
  EXPECT_THAT(wrong("FUNCTION_BLOCK F VAR_INPUT t : TON; END_VAR VAR x : BOOL; END_VAR x := t.Q; END_FUNCTION_BLOCK\n"
                    "PROGRAM Main VAR f : F; t : TP; END_VAR f(t := t); END_PROGRAM"),
              HasSubstr("t needs an instance of TON, not a TP"));
}

constexpr const char* kPrograms = R"(PROGRAM Helper
VAR_INPUT step : INT; END_VAR
VAR n : INT; END_VAR
  n := n + step;
END_PROGRAM
PROGRAM Main
VAR k : INT; END_VAR
  Helper(step := 2);
  k := Helper.n;
END_PROGRAM
)";

TEST(PlcInstances, A_program_is_called_by_its_name_in_CODESYS) {
  const Compiled sut = codesys(kPrograms);
  ASSERT_TRUE(sut.ok) << messages(sut);
  EXPECT_THAT(sut.modules.at(0).cpp, HasSubstr("instance_Main(scan);"));
  EXPECT_THAT(sut.modules.at(0).cpp, Not(HasSubstr("instance_Helper")));  // Main runs it
  EXPECT_THAT(wrong(kPrograms), HasSubstr("Helper is not a function"));
}

TEST(PlcInstances, Programs_of_two_tasks_do_not_use_each_other_by_name) {
  const Compiled sut =
      codesys(std::string("PROGRAM Helper VAR n : INT; END_VAR n := n + 1; END_PROGRAM\n"
                          "PROGRAM Main VAR k : INT; END_VAR k := Helper.n; END_PROGRAM\n"
                          "CONFIGURATION c RESOURCE r ON pc\n"
                          "TASK fast (INTERVAL := T#1ms); TASK slow (INTERVAL := T#9ms);\n"
                          "PROGRAM h WITH fast : Helper; PROGRAM m WITH slow : Main;\n"
                          "END_RESOURCE END_CONFIGURATION"));
  EXPECT_FALSE(sut.ok);
  EXPECT_THAT(messages(sut), HasSubstr("the tasks fast and slow both use the program Helper by its name"));
}

TEST(PlcInstances, The_end_of_a_POU_may_miss_in_CODESYS) {
  const std::string text = "PROGRAM Main\nVAR k : INT; END_VAR\nk := k + 1;\n";
  const Compiled sut = codesys(text);
  EXPECT_TRUE(sut.ok) << messages(sut);
  EXPECT_THAT(messages(sut), HasSubstr("warning: Main has no END_PROGRAM"));
  EXPECT_THAT(wrong(text), HasSubstr("the PROGRAM of line 1 has no END_PROGRAM"));
}

TEST(PlcInstances, Initial_values_wherever_the_function_block_stands) {
  const std::string text =
      "VAR_GLOBAL g : ARRAY[1..2] OF Motor := [(speed := 5), (speed := 6)]; END_VAR "
      "PROGRAM Main VAR m : Motor := (speed := 7); END_VAR m(); g[1](); g[2](); END_PROGRAM "
      "FUNCTION_BLOCK Motor VAR_INPUT speed : INT; END_VAR VAR_OUTPUT o : INT; END_VAR o := speed; END_FUNCTION_BLOCK ";
  const Compiled sut = compiled(text);
  EXPECT_TRUE(sut.ok) << messages(sut);
  EXPECT_THAT(wrong("VAR_GLOBAL h : Motor := (sped := 5); END_VAR " + text), HasSubstr("Motor has no field 'sped'"));
}

// Timers and edges in it would be those of another one: only where CODESYS does so, too.
TEST(PlcInstances, A_STRUCT_with_function_blocks_is_no_value_and_is_not_shared) {
  const std::string head =
      "TYPE Axis : STRUCT t : ARRAY[1..2] OF TON; n : INT; END_STRUCT; END_TYPE\n"
      "VAR_GLOBAL g : Axis; END_VAR\n"
      "PROGRAM Main VAR a, b : Axis; END_VAR\n"
      "a.t[1](IN := TRUE, PT := T#1s); b.t[2](IN := TRUE, PT := T#1s); g.t[1](IN := a.t[1].Q);\n";
  const Compiled sut = compiled(head + "g.n := a.n; END_PROGRAM");
  EXPECT_TRUE(sut.ok) << messages(sut);
  EXPECT_THAT(written(sut), Not(HasSubstr("Axis g;")));
  const Compiled whole = compiled(head + "a := b; END_PROGRAM");
  EXPECT_THAT(messages(whole), HasSubstr("an Axis contains or is a function block, which is not assigned as a whole"));
  EXPECT_EQ(whole.diagnostics.size(), 1U) << messages(whole);
  EXPECT_THAT(wrong(head + "a(); END_PROGRAM"), HasSubstr("Axis has no body, call a method or a function block in it"));
  EXPECT_THAT(wrong("TYPE Axis : STRUCT t : TON; END_STRUCT := (m := 3); END_TYPE PROGRAM Main VAR a : Axis; END_VAR "
                    "a.t(); END_PROGRAM"),
              HasSubstr("Axis has no field 'm' to begin with"));
}

TEST(PlcInstances, Values_of_variables_begin_others_in_the_dialect_of_CODESYS_only) {
  const std::string text =
      "FUNCTION_BLOCK F VAR_INPUT a : INT; END_VAR VAR b : INT := a; END_VAR VAR_OUTPUT c : INT; END_VAR c := b; "
      "END_FUNCTION_BLOCK PROGRAM Main VAR f : F; i : INT; END_VAR f(); i := f.c; END_PROGRAM";
  EXPECT_TRUE(codesys(text).ok) << messages(codesys(text));
  EXPECT_THAT(wrong(text), HasSubstr("an initial value must be known now"));
}

}  // namespace
}  // namespace indurop::plc
