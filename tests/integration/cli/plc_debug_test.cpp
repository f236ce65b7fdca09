// SPDX-License-Identifier: Apache-2.0
// plc debug: a program in simulation that stands, line by line, driven by a script.
#include "fixture.h"

namespace indurop::test {
namespace {

using ::testing::AllOf;

constexpr const char* kProgram =
    "VAR_GLOBAL\n"
    "  go : BOOL;\n"
    "  total : INT;\n"
    "END_VAR\n"
    "FUNCTION Twice : INT\n"
    "VAR_INPUT x : INT; END_VAR\n"
    "VAR y : INT; END_VAR\n"
    "  y := x + x;\n"
    "  Twice := y;\n"
    "END_FUNCTION\n"
    "FUNCTION_BLOCK Motor\n"
    "VAR_INPUT on : BOOL; END_VAR\n"
    "VAR_OUTPUT run : BOOL; n : INT; END_VAR\n"
    "VAR t : TON; END_VAR\n"
    "  t(IN := on, PT := T#20ms);\n"
    "  run := t.Q; n := n + 1;\n"
    "END_FUNCTION_BLOCK\n"
    "PROGRAM main\n"
    "VAR_EXTERNAL go : BOOL; total : INT; END_VAR\n"
    "VAR m : Motor; i : INT; list : ARRAY[1..3] OF INT; END_VAR\n"
    "  m(on := go);\n"
    "  FOR i := 1 TO 3 DO\n"
    "    list[i] := Twice(x := i);\n"
    "  END_FOR;\n"
    "  total := total / (5 - m.n);\n"
    "END_PROGRAM\n";

class PlcDebug : public CommandLine {
 protected:
  void SetUp() override {
    CommandLine::SetUp();
    if (IsSkipped()) {
      return;
    }
    put(file("d.st"), kProgram);
    static const Outcome kBuilt = indurop({"plc", "build", file("d.st"), "-o", file("out"), "--debug"});
    ASSERT_EQ(kBuilt.code, 0) << kBuilt.err;
    put(config(), "<root>\n" + kBuilt.out + "</root>\n");
  }
  static std::string config() { return file("out/module.xml"); }
  static std::string file(const std::string& name) { return (scratch() / name).string(); }
  // With what it says on stderr.
  static Outcome debug(const std::string& script, const std::vector<std::string>& more = {"--run", config()},
                       const std::vector<std::string>& end = {"--until", "1s"}) {
    std::vector<std::string> command{"plc", "debug", file("d.st")};
    command.insert(command.end(), end.begin(), end.end());
    command.insert(command.end(), more.begin(), more.end());
    Program program(indurop_command(command), background());
    program.input(script);
    return program.finish();
  }
};

TEST_F(PlcDebug, It_goes_line_by_line_into_calls_over_them_and_out_again) {
  const Outcome sut = debug("s\np on t.ET\nwhere\no\nn\nn\ns\np x\nup\np i\nq\n");
  EXPECT_EQ(sut.code, 0) << sut.out;
  EXPECT_THAT(sut.out, AllOf(HasSubstr("T#0s  d.st:21 in main  m(on := go);\n"
                                       "T#0s  d.st:15 in Motor  t(IN := on, PT := T#20ms);\n"
                                       "on = FALSE\nt.ET = T#0s\n> Motor\n  main\n"
                                       "T#0s  d.st:22 in main  FOR i := 1 TO 3 DO\n"
                                       "T#0s  d.st:23 in main  list[i] := Twice(x := i);\n"
                                       "T#0s  d.st:23 in main  list[i] := Twice(x := i);\n"
                                       "T#0s  d.st:8 in Twice  y := x + x;\n"
                                       "x = 2\n  Twice\n> main\ni = 2\n")));
}

TEST_F(PlcDebug, Time_stands_while_it_stands_and_scans_pass_one_by_one) {
  const Outcome sut = debug("set go TRUE\nscan\np go m.t.ET\nscan 2\np m.t.ET m.run\nglobals\nq\n");
  EXPECT_EQ(sut.code, 0) << sut.out;
  EXPECT_THAT(sut.out, HasSubstr("T#10ms  d.st:21 in main  m(on := go);\ngo = TRUE\nm.t.ET = T#0s\n"
                                 "T#30ms  d.st:21 in main  m(on := go);\nm.t.ET = T#10ms\nm.run = FALSE\n"
                                 "go = TRUE\ntotal = 0\n"));
}

TEST_F(PlcDebug, It_stands_at_breakpoints_and_where_it_was_sent) {
  const Outcome sut = debug("b 24\nbreaks\nb nowhere\nc\nc\nd\nuntil Motor\np n\nb d.st:16\nc\np n list\nq\n");
  EXPECT_EQ(sut.code, 0) << sut.out;
  EXPECT_THAT(sut.out, AllOf(HasSubstr("there is no code at 'nowhere'"),
                             HasSubstr("T#0s  d.st:25 in main  total := total / (5 - m.n);\n"
                                       "T#10ms  d.st:25 in main  total := total / (5 - m.n);\n"
                                       "T#20ms  d.st:15 in Motor  t(IN := on, PT := T#20ms);\nn = 2\n"),
                             HasSubstr("T#20ms  d.st:16 in Motor  run := t.Q; n := n + 1;\nn = 2\n")));
}

TEST_F(PlcDebug, A_script_does_not_go_on_where_nothing_would_stop_it_again) {
  const Outcome sut = debug("c\nb 24\nc\nq\n", {"--run", config()}, {});
  EXPECT_EQ(sut.code, 0) << sut.out;
  EXPECT_THAT(sut.out, AllOf(HasSubstr("nothing would stop the program again: set a breakpoint"),
                             HasSubstr("T#0s  d.st:25 in main  total := total / (5 - m.n);\n")));
}

TEST_F(PlcDebug, A_fault_shows_its_line_and_the_values_that_led_there) {
  const Outcome sut = debug("c\np m.n list\nc\n");
  EXPECT_EQ(sut.code, 1) << "that of the node";
  EXPECT_THAT(sut.out, HasSubstr("d.st:25:18: division by zero in main\n"
                                 "T#40ms  d.st:25 in main  total := total / (5 - m.n);\n"
                                 "m.n = 5\nlist = [1..3] 2, 4, 6\n"));
}

// Returns the last place that was shown, with the values there, without what is said at the end of the node.
std::string last_place(const std::string& out) {
  const std::string from_place = out.substr(out.rfind("\nT#"));
  return from_place.substr(0, std::min(from_place.find("\nindurop-node"), from_place.find("\nremoved")));
}

TEST_F(PlcDebug, Back_leads_to_the_lines_before_with_the_values_of_then) {
  const std::string values = "p\nglobals\nwhere\nq\n";
  std::string there = "set go TRUE\n";
  for (int steps = 1; steps <= 17; ++steps) {  // over the end of the first scan, and through a loop
    there += "s\n";
    if (steps % 4 != 1) {
      continue;
    }
    const std::string straight = last_place(debug(there + values).out);
    const Outcome sut = debug(there + "s\nset go FALSE\ns\nback\nback\n" + values);
    EXPECT_EQ(sut.code, 0) << sut.out;
    EXPECT_EQ(last_place(sut.out), straight) << steps << "\n" << sut.out;
  }
}

TEST_F(PlcDebug, Back_from_a_breakpoint_a_fault_and_the_beginning) {
  const Outcome loop = debug("b 23\nc\nc\nback\np y\nd\nn\np i\nq\n");
  EXPECT_THAT(loop.out, HasSubstr("T#0s  d.st:9 in Twice  Twice := y;\ny = 2\n"
                                  "T#0s  d.st:23 in main  list[i] := Twice(x := i);\ni = 2\n"));
  const Outcome fault = debug("c\nback\np m.n\nback\nq\n");
  EXPECT_THAT(fault.out, AllOf(HasSubstr("T#40ms  d.st:25 in main  total := total / (5 - m.n);\nm.n = 5\n"),
                               HasSubstr("T#40ms  d.st:9 in Twice  Twice := y;\n")));
  const Outcome begin = debug("back\ns\nq\n");
  EXPECT_THAT(begin.out, HasSubstr("the program has not run an earlier line\nT#0s  d.st:15 in Motor"));
}

TEST_F(PlcDebug, Without_a_configuration_the_program_runs_alone) {
  EXPECT_THAT(debug("scan\nq\n", {}).out, HasSubstr("T#10ms  d.st:21 in main"));
}

TEST_F(PlcDebug, An_empty_program_can_be_stood_in) {
  put(file("empty.st"), "PROGRAM main\nVAR x : INT; END_VAR\nEND_PROGRAM\n");
  Program sut(indurop_command({"plc", "debug", file("empty.st")}), background());
  sut.input("p x\nscan 2\nq\n");
  const Outcome ended = sut.finish();
  EXPECT_EQ(ended.code, 0) << ended.out;
  EXPECT_THAT(ended.out, HasSubstr("T#0s  empty.st:1 in main  PROGRAM main\nx = 0\nT#20ms  empty.st:1 in main"));
}

TEST_F(PlcDebug, Its_node_ends_with_it_even_if_it_is_killed) {
  Program sut(indurop_command({"plc", "debug", file("d.st"), "--run", config()}), background());
  ASSERT_TRUE(sut.prints("d.st:21 in main")) << sut.err();
  const std::string node = "debug" + std::to_string(sut.pid());
  const auto runs = [&] { return indurop({"status", "--node", node}).code == 0; };
  ASSERT_TRUE(runs());
  sut.kill();
  EXPECT_TRUE(wait_until([&] { return !runs(); }));
}

TEST_F(PlcDebug, A_configuration_needs_a_module_built_from_these_files) {
  put(file("d.st"), std::string("\n") + kProgram);
  EXPECT_THAT(debug("scan\nq\n").out, HasSubstr("is not of these files"));
}

}  // namespace
}  // namespace indurop::test
