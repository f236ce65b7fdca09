// SPDX-License-Identifier: Apache-2.0
// RETAIN instances of a PLC program over a restart of the node.
#include "fixture.h"

namespace indurop::test {
namespace {

class PlcRetain : public CommandLine {
 protected:
  static std::string file(const std::string& name) { return (scratch() / name).string(); }
  static void run() {
    const Outcome ran = indurop({"run", file("keep/module.xml"), "-q", "--node", "keep", "--duration", "200ms"});
    ASSERT_EQ(ran.code, 0) << ran.err;
  }
  static long long value(const std::string& name) {
    return std::stoll("0" + indurop({"get", "--node", "keep", name}).out);
  }
};

TEST_F(PlcRetain, Counters_and_timers_go_on_where_they_were) {
  put(file("keep.st"),
      "FUNCTION_BLOCK Meter VAR RETAIN hours : DINT; END_VAR VAR passing : DINT; END_VAR\n"
      "hours := hours + 1; passing := passing + 1; END_FUNCTION_BLOCK\n"
      "PROGRAM main\n"
      "VAR RETAIN c : CTU; t : TON; END_VAR VAR m : Meter; pulse : BOOL; scans AT %MD0 : DINT; END_VAR\n"
      "pulse := NOT pulse; scans := scans + 1;\n"
      "c(CU := pulse, PV := 10000); t(IN := TRUE, PT := T#1h); m();\n"
      "END_PROGRAM\n");
  const Outcome built = indurop({"plc", "build", file("keep.st"), "-o", file("keep")});
  ASSERT_EQ(built.code, 0) << built.err;
  put(file("keep/module.xml"), "<root>\n" + built.out + "</root>\n");
  run();
  const long long counted = value("main_c_CV");
  const long long passed = value("main_t_ET");
  const long long hours = value("main_m_hours");
  EXPECT_GT(counted, 0);
  EXPECT_GT(passed, 0);
  EXPECT_EQ(hours, value("scans"));
  ASSERT_EQ(indurop({"clean", "--node", "keep"}).code, 0) << "what is left is in files";
  run();
  const long long scans = value("scans");
  EXPECT_EQ(value("main_m_hours"), hours + scans);
  EXPECT_GE(value("main_c_CV"), counted + scans / 2 - 1) << "it goes on";
  EXPECT_LE(value("main_c_CV"), counted + scans / 2 + 1) << "and counts each pulse once";
  EXPECT_GT(value("main_t_ET"), passed);
  EXPECT_LT(value("main_t_ET"), passed + 60'000'000'000) << "the time without the node is none of its";
}

TEST_F(PlcRetain, Values_go_on_in_variables_of_another_type) {
  const auto program = [](const std::string& variables, const std::string& body) {
    put(file("keep.st"),
        "TYPE Part : STRUCT n : INT; END_STRUCT; Mode : (Idle, Busy); END_TYPE\nPROGRAM main\nVAR RETAIN " + variables +
            " END_VAR\n" + body + "END_PROGRAM\n");
    const Outcome built = indurop({"plc", "build", file("keep.st"), "-o", file("keep")});
    EXPECT_EQ(built.code, 0) << built.err;
    put(file("keep/module.xml"), "<root>\n" + built.out + "</root>\n");
    return built.err;
  };
  program(
      "count : INT; text : STRING[5]; list : ARRAY[1..3] OF INT; part : Part; mode : Mode; large : DINT; gone : INT;",
      "count := 7; text := 'abc'; list[2] := 5; part.n := 3; mode := Busy; large := 70000; gone := 1;\n");
  run();
  const std::string said = program(
      "count : LINT; text : STRING[20]; list : ARRAY[1..9] OF DINT; part : Part; mode : Mode; large : INT;", ";\n");
  EXPECT_THAT(said, HasSubstr("retained keep::main_gone: is no longer there; its node keeps the value"));
  EXPECT_THAT(said,
              HasSubstr("retained keep::main_large: was int32_t, is int16_t; a node keeps of its value what fits"));
  EXPECT_THAT(said, Not(HasSubstr("main_part")));
  for (const bool again : {false, true}) {
    if (again) {  // from the files that the first run of the new version wrote
      ASSERT_EQ(indurop({"clean", "--node", "keep"}).code, 0);
    }
    const Outcome ran = indurop({"run", file("keep/module.xml"), "--node", "keep", "--duration", "200ms"});
    ASSERT_EQ(ran.code, 0) << ran.err;
    EXPECT_EQ(value("main_count"), 7);
    EXPECT_EQ(indurop({"get", "--node", "keep", "--quiet", "main_text"}).out, "\"abc\"\n");
    EXPECT_EQ(value("main_list[1]"), 5);
    EXPECT_EQ(value("main_part.n"), 3);
    EXPECT_EQ(indurop({"get", "--node", "keep", "--quiet", "main_mode"}).out, "Busy\n");
    EXPECT_EQ(value("main_large"), 0);
    const std::string status = indurop({"status", "--node", "keep"}).out;
    for (const std::string& shown : {ran.err, status}) {
      EXPECT_EQ(shown.find("keep::main_large: 70000 is no value of int16_t, starts with its initial value") !=
                    std::string::npos,
                !again)
          << shown;
      EXPECT_THAT(shown, HasSubstr("values are kept for variables that this configuration does not declare retain: "
                                   "keep::main_gone\n"));
      EXPECT_EQ(shown.find("retain.before.") != std::string::npos, !again) << shown;
    }
  }
}

// The folder of the state is not one yet, as a disk that is full or was not mounted.
TEST_F(PlcRetain, Values_that_cannot_be_saved_are_reported_until_they_are) {
  put(file("keep.st"), "PROGRAM main VAR RETAIN count : DINT; END_VAR count := count + 1; END_PROGRAM\n");
  const Outcome built = indurop({"plc", "build", file("keep.st"), "-o", file("keep")});
  ASSERT_EQ(built.code, 0) << built.err;
  put(file("keep/module.xml"), "<root>\n" + built.out + "</root>\n");
  put(file("disk"), "");
  Environment blocked;
  blocked.variables = {"INDUROP_STATE_DIR=" + file("disk") + "/state"};
  Program node(indurop_command({"run", file("keep/module.xml"), "-q", "--node", "keep"}), blocked);
  ASSERT_TRUE(node.says("error: retained variables cannot be saved: "));
  const Outcome failing = indurop({"status", "--node", "keep", "--check"});
  EXPECT_EQ(failing.code, 4);
  EXPECT_THAT(failing.out, HasSubstr("wrong     retained variables cannot be saved: "));
  std::filesystem::remove(file("disk"));
  ASSERT_TRUE(node.says("retained variables are saved again, after "));
  const Outcome saving = indurop({"status", "--node", "keep", "--check"});
  EXPECT_EQ(saving.code, 0) << saving.out;
  EXPECT_TRUE(std::filesystem::exists(file("disk") + "/state/keep/retain.a"));
  node.signal(SIGTERM);
  EXPECT_EQ(node.wait(), 0) << node.err();
}

}  // namespace
}  // namespace indurop::test
