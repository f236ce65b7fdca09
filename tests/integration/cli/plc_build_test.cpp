// SPDX-License-Identifier: Apache-2.0
// plc build where g++ does not do what it should: what who wrote the PLC program gets to read.
#include "fixture.h"

namespace indurop::test {
namespace {

class PlcBuild : public CommandLine {
 protected:
  void SetUp() override {
    CommandLine::SetUp();
    if (!IsSkipped()) {
      put(file("motor.st"), "PROGRAM main VAR x : INT; END_VAR x := 1; END_PROGRAM\n");
    }
  }
  static std::string file(const std::string& name) { return (scratch() / name).string(); }
  // Builds with a compiler that says this and fails.
  static Outcome build(const std::string& said) {
    put(file("compiler"), "#!/bin/sh\necho '" + said + "' >&2\nexit 1\n");
    std::filesystem::permissions(file("compiler"), std::filesystem::perms::owner_all);
    return indurop({"plc", "build", file("motor.st"), "-o", file("out")}, {.variables = {"CXX=" + file("compiler")}});
  }
};

TEST_F(PlcBuild, Code_that_does_not_compile_is_an_internal_error_to_be_reported) {
  const Outcome result = build("out/motor.cpp:17:3: error: no matching function for call to add(long int, int)");
  EXPECT_EQ(result.code, 1);
  EXPECT_THAT(result.err,
              HasSubstr("internal error: what indurop plc made of " + file("motor.st") + " does not compile."));
  EXPECT_THAT(result.err, HasSubstr("please report it with the program, " + file("out/motor.cpp")));
  EXPECT_THAT(result.err, Not(HasSubstr("no matching function")));
  std::ifstream log(file("out/motor.log"));
  const std::string kept((std::istreambuf_iterator<char>(log)), std::istreambuf_iterator<char>());
  EXPECT_THAT(kept, HasSubstr("no matching function"));
}

TEST_F(PlcBuild, Names_of_files_are_those_of_a_configuration_in_the_working_directory) {
  const auto filename = [](const std::string& folder) {
    const auto enter = [] { return ::chdir(scratch().c_str()) == 0; };
    return indurop({"plc", "build", file("motor.st"), "--only-sources", "-o", folder}, {.prepare = enter}).out;
  };
  EXPECT_THAT(filename("."), HasSubstr("<filename>./motor.so</filename>"));
  EXPECT_THAT(filename("out/"), HasSubstr("<filename>./out/motor.so</filename>"));
  EXPECT_THAT(filename("out/../b"), HasSubstr("<filename>./b/motor.so</filename>"));
  EXPECT_THAT(filename(file("out")), HasSubstr("<filename>" + file("out/motor.so</filename>")));
}

TEST_F(PlcBuild, Other_failures_of_the_compiler_are_shown) {
  const Outcome result = build("fatal error: error writing to /tmp/x.s: No space left on device");
  EXPECT_EQ(result.code, 1);
  EXPECT_THAT(result.err, HasSubstr("No space left on device"));
  EXPECT_THAT(result.err, HasSubstr("compiler failed with exit code 1"));
  EXPECT_THAT(result.err, Not(HasSubstr("internal error")));
}

TEST_F(PlcBuild, What_check_refuses_is_not_exported) {
  put(file("wrong.st"), "PROGRAM main VAR x : INT; END_VAR x := y; END_PROGRAM\n");
  const Outcome result = indurop({"plc", "export", file("wrong.st"), "-o", file("wrong.xml")});
  EXPECT_EQ(result.code, 4);
  EXPECT_THAT(result.err, HasSubstr("'y' is not declared"));
  EXPECT_FALSE(std::filesystem::exists(file("wrong.xml")));
  EXPECT_EQ(indurop({"plc", "export", file("motor.st"), "-o", file("motor.xml")}).code, 0);
}

// A third-party project refers to, or is a link to, files elsewhere: nothing of them is read or shown.
TEST_F(PlcBuild, A_project_takes_no_files_from_outside_of_its_folder) {
  namespace fs = std::filesystem;
  fs::create_directories(file("foreign/pous"));
  put(file("foreign/project.json"), R"({"meta": {}, "data": {"dataTypes": [], "pous": [], "configuration": {}}})");
  put(file("secret"), "topsecret : word\n");
  put(file("elsewhere.st"), "PROGRAM topsecret END_PROGRAM\n");
  for (const char* target : {"secret", "elsewhere.st"}) {
    fs::remove(file("foreign/pous/a.st"));
    fs::create_symlink(file(target), file("foreign/pous/a.st"));
    for (const char* verb : {"check", "build", "print", "export"}) {
      const Outcome result = indurop({"plc", verb, file("foreign/project.json")});
      EXPECT_EQ(result.code, 4) << verb;
      EXPECT_THAT(result.err, HasSubstr("this link leads out of the folder of"));
      EXPECT_THAT(result.err + result.out, Not(HasSubstr("topsecret")));
    }
  }
  fs::remove(file("foreign/pous/a.st"));
  fs::create_symlink(file("secret"), file("foreign/pous/a.st"));
  const Outcome link = indurop({"plc", "check", file("foreign/pous/a.st")});
  EXPECT_EQ(link.code, 4);
  EXPECT_THAT(link.err, HasSubstr("this is a link to a file of another kind"));
  EXPECT_THAT(link.err, Not(HasSubstr("topsecret")));
  put(file("foreign/a.plcproj"),
      R"(<Project><ItemGroup><Compile Include="..\elsewhere.TcPOU"/></ItemGroup></Project>)");
  put(file("elsewhere.TcPOU"), "topsecret");
  const Outcome named = indurop({"plc", "check", file("foreign/a.plcproj")});
  EXPECT_EQ(named.code, 4);
  EXPECT_THAT(named.err, HasSubstr("which lies outside of its folder"));
}

}  // namespace
}  // namespace indurop::test
