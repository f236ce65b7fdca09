// SPDX-License-Identifier: Apache-2.0
// FMUs that misbehave, are damaged, or do not fit their configuration.

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <indurop/testing.h>
#include <unistd.h>

#include <csignal>
#include <fstream>

#include "core/base/exit_code.h"
#include "core/base/read_file.h"
#include "tests/integration/fmi/model.h"
#include "tests/support/program.h"
#include "tests/support/wait_until.h"

namespace indurop::fmi {
namespace {

namespace fs = std::filesystem;
using irp::testing::Plant;
using ::testing::HasSubstr;

#if defined(__SANITIZE_THREAD__)
constexpr bool kFollowsCrashes = false;
#else
constexpr bool kFollowsCrashes = true;
#endif

// Values of the parameter "fault" of lag.c.
enum { Fail = 1, Refuse, Crash, Die, End, Nan, Chatter, Hang, Early, CrashAtStart, FailAtStart };

test::Outcome run(const std::vector<std::string>& command) {
  test::Program program(command);
  return program.finish();
}

class FmuFault : public ::testing::TestWithParam<int> {
 protected:
  // The fault happens in the third step, which is that of tick 3.
  static std::string device(int fault, const std::string& attributes = {}) {
    return fmt::format(R"(<device name="lag" driver="fmu" file="{}" variables="lag" {}>
      <set at="fault" value="{}"/><set at="at" value="3"/></device>)",
                       lag(GetParam()), attributes, fault);
  }
  static std::string failsafe() { return R"(<failsafe variable="lag::lag_y">-7</failsafe>)"; }
  // What the module's fault says.
  static std::string fault_of(int fault) {
    const Model model(device(fault), types_module(), failsafe());
    Plant plant(model.file());
    plant.set("lag::u", 1.0);
    plant.step(3);
    EXPECT_EQ(plant.module("model").faults, 0U) << plant.printed();
    EXPECT_GT(plant.get<double>("lag::lag_y"), 0);
    plant.step();
    EXPECT_EQ(plant.module("model").faults, 1U) << plant.printed();
    EXPECT_EQ(plant.get<double>("lag::lag_y"), -7) << "fail-safe";
    const auto runs = plant.module("types_copy").runs;
    plant.step(5);
    EXPECT_EQ(plant.module("types_copy").runs, runs + 5) << "the others go on";
    EXPECT_EQ(plant.get<double>("lag::lag_y"), -7);
    EXPECT_EQ(plant.module("model").faults, 1U);
    return plant.module("model").last_fault + "\n" + plant.printed();
  }
};

// What is printed in a tick is read in a later one.
bool prints(Plant& plant, const std::string& text) {
  return test::wait_until([&] {
    plant.step();
    return plant.printed().find(text) != std::string::npos;
  });
}

TEST_P(FmuFault, A_step_that_fails_says_what_when_and_why) {
  const std::string word = GetParam() == 2 ? "fmi2" : "fmi3";
  EXPECT_THAT(fault_of(Fail),
              HasSubstr(fmt::format("at 0.02 s: {0}DoStep failed ({0}Error): the solver does not converge", word)));
  EXPECT_THAT(fault_of(Refuse), HasSubstr(fmt::format("at 0.02 s: {0}DoStep failed ({0}Discard)", word)));
  EXPECT_THAT(fault_of(Die), HasSubstr(fmt::format("{0}DoStep failed ({0}Fatal): out of licences", word)));
  EXPECT_THAT(fault_of(End), HasSubstr("at 0.02 s: the FMU has ended the simulation"));
}

TEST_P(FmuFault, A_crash_is_that_of_a_module) {
  if (!kFollowsCrashes) {
    GTEST_SKIP() << "ThreadSanitizer does not follow a jump out of a crashed module";
  }
  EXPECT_THAT(fault_of(Crash), HasSubstr("SIGSEGV"));
}

TEST_P(FmuFault, Messages_are_printed_and_cannot_change_a_terminal) {
  const Model model(device(Chatter));
  Plant plant(model.file());
  EXPECT_TRUE(prints(plant, "lag: near a singularity?[2J"));
  EXPECT_THAT(plant.printed(), ::testing::Not(HasSubstr("of it")));
  const Model all(device(Chatter, "log=\"on\""));
  Plant loud(all.file());
  EXPECT_TRUE(prints(loud, "lag: events: 100%s of it"));
}

// Why a node with this configuration does not start.
std::string start_problem(const Model& model) {
  try {
    const Plant plant(model.file());
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "it has started";
}

TEST_P(FmuFault, A_start_that_fails_prevents_the_run) {
  EXPECT_THAT(start_problem(Model(device(FailAtStart))), HasSubstr("no equilibrium was found"));
  if (kFollowsCrashes) {
    EXPECT_THAT(start_problem(Model(device(CrashAtStart))), HasSubstr("SIGSEGV"));
  }
}

TEST_P(FmuFault, Nothing_is_left_in_the_folder_for_temporary_files) {
  const Model model(device(0));
  {
    Plant plant(model.file());
    plant.step(5);
    ASSERT_EQ(model.unpacked().size(), 1U);
  }
  EXPECT_TRUE(model.unpacked().empty());
  const Model crashing(device(kFollowsCrashes ? Crash : Fail));
  {
    Plant plant(crashing.file());
    plant.step(5);
  }
  EXPECT_TRUE(crashing.unpacked().empty());
}

TEST_P(FmuFault, The_next_FMU_removes_what_a_killed_node_has_left) {
  const Model model(device(0));
  const std::string name = fmt::format("fmu-killed-{}", ::getpid());  // this test runs for both versions at once
  test::Program node({INDUROP, "run", model.file().string(), "--sim", "--speed", "1", "--node", name});
  ASSERT_TRUE(test::wait_until([&model] { return model.unpacked().size() == 1; })) << node.out() << node.err();
  Plant other(model.file());
  ASSERT_EQ(model.unpacked().size(), 2U) << "that of a node that runs stays";
  node.kill();
  EXPECT_EQ(model.unpacked().size(), 2U);
  const Plant next(model.file());
  EXPECT_EQ(model.unpacked().size(), 2U);
  EXPECT_EQ(run({INDUROP, "clean", "--node", name, "-q"}).code, 0);
}

INSTANTIATE_TEST_SUITE_P(Fmi, FmuFault, ::testing::Values(2, 3));

TEST(FmuFault3, An_early_return_that_is_not_allowed_is_a_fault) {
  const Model model(fmt::format(R"(<device name="lag" driver="fmu" file="{}" variables="lag">
      <set at="fault" value="9"/><set at="at" value="3"/></device>)",
                                lag(3)));
  Plant plant(model.file());
  plant.step(4);
  EXPECT_THAT(plant.module("model").last_fault + plant.printed(), HasSubstr("must not return early"));
}

TEST(FmuCheck, All_errors_are_reported_at_once_with_their_places) {
  const Model model(fmt::format(R"(<device name="lag" driver="fmu" file="{}">
<set at="mass" value="1"/>
<set at="T" value="fast"/>
<set at="columns" value="2"/>
<set at="choice" value="medium"/>
<set at="lag.y" value="1"/>
<set at="vector" value="1 2"/>
<output variable="kinds::in.f64" at="lag.y"/>
<output variable="kinds::in.f64" at="T"/>
<output variable="kinds::in.f64" at="u"/>
<output variable="kinds::in.f32" at="u"/>
<input variable="kinds::in.i8" at="lag.z"/>
<input variable="kinds::in.i16" at="text"/>
<input variable="kinds::in.i32" at="vector[3,1]"/>
<input variable="kinds::in.nothing" at="lag.y"/>
</device>
<device name="none" driver="fmu" file="none.fmu" variables="no name"><input variable="kinds::in.u8" at="x"/></device>)",
                                lag(3)),
                    types_module());
  const test::Outcome outcome = run({INDUROP, "check", model.file().string()});
  EXPECT_EQ(outcome.code, kCheckFailed);
  std::string text = outcome.out + outcome.err;
  for (std::size_t at = text.find(model.folder().string()); at != std::string::npos;
       at = text.find(model.folder().string())) {
    text.replace(at, model.folder().string().size() + 1, "");
  }
  for (const char* expected : {
           "ioconfig.xml:3:10: error: at: ",
           "has no variable 'mass'; `indurop io import` lists them",
           "ioconfig.xml:4:20: error: <set>: 'T' is a Float64, not 'fast'",
           "ioconfig.xml:5:10: error: <set>: 'columns' is a structural parameter",
           "ioconfig.xml:6:25: error: <set>: 'choice' is an Enumeration with 'slow run' and 'fast', not 'medium'",
           "ioconfig.xml:7:10: error: <set>: 'lag.y' is of causality output and has no start value that can be set",
           "ioconfig.xml:8:25: error: <set>: 'vector' is 6 elements of Float64; write all of them, or one for all",
           "ioconfig.xml:9:38: error: at: 'lag.y' is of causality output; an <output> goes to an input",
           "ioconfig.xml:10:38: error: at: 'T' is a parameter that does not change while the FMU runs",
           "ioconfig.xml:12:38: error: 'u' is written by the output in line 11 already",
           "has no variable 'lag.z'; did you mean 'lag.y'?",
           "ioconfig.xml:14:18: error: 'kinds::in.i16' is int16_t; for a text it must be one, char[80] for example",
           "has no variable 'vector[3,1]'",
           "kinds::in has no field 'nothing'",
           "variables: 'no name' is no namespace",
           "file: 'none.fmu' is no FMU that can be used",
           "none.fmu: error: no such file",
       }) {
    EXPECT_THAT(text, HasSubstr(expected));
  }
}

TEST(FmuCheck, A_node_in_real_time_refuses_an_FMU) {
  const Model model(fmt::format(R"(<device name="lag" driver="fmu" file="{}" variables="lag"/>)", lag(2)));
  const test::Outcome outcome =
      run({INDUROP, "run", model.file().string(), "--duration", "100ms", "--node", "fmu-real"});
  EXPECT_NE(outcome.code, 0);
  EXPECT_THAT(outcome.out + outcome.err, HasSubstr("runs in simulations only"));
  (void)run({INDUROP, "clean", "--node", "fmu-real"});
}

TEST(FmuCheck, A_check_for_a_simulation_accepts_it) {
  const Model model(fmt::format(R"(<device name="lag" driver="fmu" file="{}" variables="lag"/>)", lag(2)));
  const test::Outcome outcome = run({INDUROP, "check", "--sim", model.file().string()});
  EXPECT_EQ(outcome.code, 0) << outcome.out << outcome.err;
}

TEST(FmuTool, Writes_what_a_configuration_and_modules_need) {
  const Model model("");
  const fs::path io = model.folder() / "ioconfig.xml";
  fs::remove(io);
  const std::string glb = (model.folder() / "lag3.glb").string();
  const test::Outcome listed = run({INDUROP, "io", "import", lag(3)});
  EXPECT_EQ(listed.code, 0) << listed.err;
  EXPECT_THAT(listed.out, HasSubstr("lag.y"));
  EXPECT_THAT(listed.out, HasSubstr("Float64[2,3]"));
  const test::Outcome written = run({INDUROP, "io", "import", lag(3), "--write", io.string(), "--glb", glb});
  EXPECT_EQ(written.code, 0) << written.err;
  const std::string device = base::read_file(io).value();
  EXPECT_THAT(device, HasSubstr("<device name=\"lag3\" driver=\"fmu\" file=\""));
  EXPECT_THAT(device, HasSubstr("<!-- <set at=\"T\" value=\"0.1\"/> s -->"));
  EXPECT_EQ(run({INDUROP, "check", "--sim", model.file().string()}).code, 0);
  Plant plant(model.file());
  plant.set("lag3::u", 1.0);
  plant.step(2);
  EXPECT_GT(plant.get<double>("lag3::lag_y"), 0);
  const std::string declared = base::read_file(glb).value();
  EXPECT_THAT(declared, HasSubstr("double u @unit(\"mm\") @range(-10, 10) = 0;  // Set point\n"));
  EXPECT_THAT(declared, HasSubstr("double vector[2][3];\n"));
  EXPECT_THAT(declared, HasSubstr("// not possible, the name is a type: int8_t int8 = 0;\n"));
  const test::Outcome compiled = run({GLB2IDL, "--out-dir", model.folder().string(), glb});
  EXPECT_EQ(compiled.code, 0) << compiled.err;
  const test::Outcome again = run({INDUROP, "io", "import", lag(3), "--write", io.string()});
  EXPECT_NE(again.code, 0);
  EXPECT_THAT(again.out + again.err, HasSubstr("a second device 'lag3'"));
}

}  // namespace
}  // namespace indurop::fmi
