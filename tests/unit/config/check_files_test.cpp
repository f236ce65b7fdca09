// SPDX-License-Identifier: Apache-2.0
// Module files that are missing, wrong, or disagree about their variables.

#include <sys/stat.h>
#include <unistd.h>

#include <fstream>

#include "configuration.h"
#include "module_file.h"
#include "tests/support/unprivileged.h"

namespace indurop::config {
namespace {

using testing::AllOf;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

class CheckFiles : public testing::Test {
 protected:
  std::vector<std::string> check_lines(const std::string& modules) {
    return check(root(modules), CheckOptions{}, folder_ / "module.xml").lines();
  }
  void write(const std::string& name, const ModuleSpec& spec) { write_module(folder_ / name, spec); }

  ModuleFolder folder_;
};

TEST_F(CheckFiles, Complete_configuration_has_nothing_to_complain_about) {
  write("a.so", {});
  write("s.so", {});
  write("p.exe", {.program = true, .exports = {}, .imports = {"_ZN3irp10waitPeriodEv"}});
  write("n.exe", {.program = true, .abi = 0, .exports = {}});
  EXPECT_THAT(check_lines(periodic("a.so", "1ms", 1) + sporadic("s.so", "thread", 1) + sporadic("p.exe", "process", 2) +
                          non_real("n.exe")),
              IsEmpty());
}

TEST_F(CheckFiles, A_missing_file_is_reported_with_the_nearest_name) {
  write("control.so", {});
  EXPECT_THAT(check_lines(periodic("contrl.so", "1ms", 1)),
              ElementsAre(AllOf(HasSubstr("module.xml:2:19: error: no such file: 'contrl.so'"),
                                HasSubstr("did you mean 'control.so'?"))));
  EXPECT_THAT(check_lines(periodic("build/control.so", "1ms", 1)), ElementsAre(HasSubstr("there is no folder")));
  const std::string deep = "/" + std::string(240, 'f') + "/" + std::string(90, 'g') + "/";
  EXPECT_THAT(check_lines(periodic(deep + "control.so", "1ms", 1)),
              ElementsAre(HasSubstr("g/control.so'; there is no folder '\u2026f")));
  EXPECT_THAT(check_lines(periodic("x.so", "1ms", 1)), ElementsAre(HasSubstr("build it, or correct <filename>")));
}

TEST_F(CheckFiles, What_is_no_module_is_refused) {
  std::ofstream(folder_ / "text.so") << "hello";
  std::ofstream(folder_ / "empty.so").close();
  std::filesystem::create_directory(folder_ / "folder.so");
  EXPECT_THAT(
      check_lines(periodic("text.so", "1ms", 1) + periodic("empty.so", "1ms", 2) + periodic("folder.so", "1ms", 3)),
      ElementsAre(HasSubstr("'text.so' cannot be used"), HasSubstr("'empty.so' cannot be used"),
                  HasSubstr("'folder.so' is a directory")));
}

TEST_F(CheckFiles, A_pipe_is_refused_and_not_waited_for) {
  ASSERT_EQ(::mkfifo((folder_ / "pipe.exe").c_str(), 0755), 0);
  EXPECT_THAT(check_lines("<module><filename>pipe.exe</filename><moduletype>process</moduletype>"
                          "<operationtype>non-real</operationtype></module>"),
              Contains(HasSubstr("'pipe.exe' is not an ordinary file")));
}

TEST_F(CheckFiles, An_unreadable_file_is_reported) {
  write("a.so", {});
  ::chmod((folder_ / "a.so").c_str(), 0);
  ::chmod((folder_ / ".").c_str(), 0755);
  const test::WithoutRoot user;
  ASSERT_TRUE(user.held());
  EXPECT_THAT(check_lines(periodic("a.so", "1ms", 1)), ElementsAre(HasSubstr("is not readable by this user")));
}

TEST_F(CheckFiles, Other_machine_and_other_abi_are_refused) {
  write("arm.so", {.machine = EM_ARM});
  write("old.so", {.abi = 77});
  EXPECT_THAT(check_lines(periodic("arm.so", "1ms", 1) + periodic("old.so", "1ms", 2)),
              ElementsAre(HasSubstr("is built for 32-bit ARM"), HasSubstr("is built for InduRoP ABI 77")));
}

TEST_F(CheckFiles, Kind_of_file_must_fit_the_module_type) {
  write("program", {.program = true});
  write("library.so", {});
  EXPECT_THAT(check_lines(periodic("program", "1ms", 1) + non_real("library.so")),
              ElementsAre(HasSubstr("error: 'program' is a program, not a shared library"),
                          HasSubstr("warning: 'library.so' is a shared library, not a program")));
}

TEST_F(CheckFiles, Thread_module_needs_something_to_run) {
  write("none.so", {.exports = {"main", "helper"}});
  write("c.so", {.abi = 0, .exports = {"run"}});
  write("cpp.so", {.abi = 0, .exports = {"_Z3runv"}});
  EXPECT_THAT(check_lines(periodic("none.so", "1ms", 1) + periodic("c.so", "1ms", 2) + periodic("cpp.so", "1ms", 3)),
              ElementsAre(HasSubstr("'none.so' has no run function")));
}

TEST_F(CheckFiles, Sporadic_thread_needs_a_condition) {
  write("none.so", {.exports = {"run"}});
  write("c.so", {.exports = {"condition", "run"}});
  write("cpp.so", {.exports = {"_Z3runv", "_Z9conditionv"}});
  EXPECT_THAT(
      check_lines(sporadic("none.so", "thread", 1) + sporadic("c.so", "thread", 2) + sporadic("cpp.so", "thread", 3)),
      ElementsAre(HasSubstr("'none.so' has no condition()")));
}

TEST_F(CheckFiles, Process_must_be_executable_and_know_when_to_run) {
  write("a.exe", {.program = true, .exports = {}, .imports = {"_ZN3irp10waitPeriodEv"}});
  ::chmod((folder_ / "a.exe").c_str(), 0644);
  write("legacy.exe", {.program = true, .abi = 0, .exports = {}});
  std::ofstream(folder_ / "script") << "#!/bin/sh\n";
  ::chmod((folder_ / "script").c_str(), 0755);
  EXPECT_THAT(
      check_lines(sporadic("a.exe", "process", 1) + sporadic("legacy.exe", "process", 2)),
      ElementsAre(HasSubstr("chmod +x a.exe"), HasSubstr("neither calls irp::waitPeriod() nor has a <signal>")));
  EXPECT_THAT(
      check_lines(sporadic("legacy.exe", "process", 1, "<signal>USR1</signal>") +
                  sporadic("script", "process", 2, "<signal>USR1</signal>") + non_real("./script", "<name>n</name>")),
      IsEmpty());
}

TEST_F(CheckFiles, Layouts_that_differ_are_reported_with_variable_and_both_modules) {
  ModuleSpec a;
  a.schema.variables = {variable("knu::Robot::speed")};
  ModuleSpec b;
  b.schema.variables = {variable("knu::Robot::speed", schema::Base::Float, "old/knuRobot.glb:3")};
  write("modify.so", a);
  write("output.so", b);
  write("third.so", a);
  EXPECT_THAT(
      check_lines(periodic("modify.so", "1ms", 1) + periodic("output.so", "1ms", 2) + periodic("third.so", "1ms", 3)),
      ElementsAre(AllOf(HasSubstr("module.xml:3:19: error: variable 'knu::Robot::speed' differs between modify"),
                        HasSubstr("and output (old/knuRobot.glb:3): double / float"))));
}

TEST_F(CheckFiles, A_damaged_description_is_reported) {
  ModuleSpec a;
  a.schema.variables = {variable("knu::Robot::speed")};
  std::string bytes = ElfWriter(a).bytes();
  bytes.replace(bytes.find("{\""), 2, "{{");
  std::ofstream(folder_ / "a.so", std::ios::binary) << bytes;
  EXPECT_THAT(check_lines(periodic("a.so", "1ms", 1)), Contains(HasSubstr("damaged description")));
}

TEST_F(CheckFiles, Calling_shared_functions_without_an_implementation_is_a_warning) {
  write("caller.so", {.imports = {"indurop_call"}});
  EXPECT_THAT(check_lines(periodic("caller.so", "1ms", 1)),
              ElementsAre(HasSubstr("warning: caller calls shared functions")));
  write("server.so", {.imports = {"indurop_offer_function"}});
  EXPECT_THAT(check_lines(periodic("caller.so", "1ms", 1) + periodic("server.so", "1ms", 2)), IsEmpty());
}

TEST_F(CheckFiles, Facts_are_in_the_order_of_the_modules) {
  ModuleSpec b;
  b.schema.variables = {variable("x")};
  b.reads = {"x"};
  write("b.so", b);
  const Checked sut = check(root(periodic("missing.so", "1ms", 1) + periodic("b.so", "1ms", 2)), CheckOptions{},
                            folder_ / "module.xml");
  ASSERT_EQ(sut.result.facts.size(), 2U);
  EXPECT_THAT(sut.result.facts[0].schema->variables, IsEmpty());
  EXPECT_EQ(sut.result.facts[1].schema->variables.size(), 1U);
  EXPECT_EQ(sut.result.schema.variables.size(), 1U);
  EXPECT_FALSE(sut.result.ok());
}

}  // namespace
}  // namespace indurop::config
