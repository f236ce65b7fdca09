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

TEST_F(PlcBuild, Other_failures_of_the_compiler_are_shown) {
  const Outcome result = build("fatal error: error writing to /tmp/x.s: No space left on device");
  EXPECT_EQ(result.code, 1);
  EXPECT_THAT(result.err, HasSubstr("No space left on device"));
  EXPECT_THAT(result.err, HasSubstr("compiler failed with exit code 1"));
  EXPECT_THAT(result.err, Not(HasSubstr("internal error")));
}

}  // namespace
}  // namespace indurop::test
