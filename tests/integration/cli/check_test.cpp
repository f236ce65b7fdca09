// SPDX-License-Identifier: Apache-2.0
// check and plan on configurations.
#include <filesystem>

#include "fixture.h"

namespace indurop::test {
namespace {

std::string module(const std::string& name, const std::string& period, int priority) {
  return "<module><filename>./" + name +
         ".so</filename><moduletype>thread</moduletype><operationtype>periodic</operationtype><period>" + period +
         "</period><priority>" + std::to_string(priority) + "</priority></module>\n";
}

class Configurations : public CommandLine {
 protected:
  std::string write(const std::string& modules) {
    const std::string file = (scratch() / "module.xml").string();
    put(file, "<?xml version=\"1.0\"?>\n<root>\n" + modules + "</root>\n");
    return file;
  }
};

TEST_F(Configurations, Plan_works_without_the_modules) {
  const std::string file = write(module("a", "1ms", 2) + module("b", "2ms", 1));
  const auto text = indurop({"plan", file});
  EXPECT_EQ(text.code, 0) << text.err;
  EXPECT_THAT(text.out, HasSubstr("b > a"));
  const auto json = json_of(indurop({"plan", file, "-o", "json"}));
  EXPECT_EQ(json["basic_period_ns"], 1'000'000);
  EXPECT_EQ(json["slots"].size(), 2U);
  EXPECT_EQ(json["slots"][0]["modules"], nlohmann::json::parse(R"(["b","a"])"));
  EXPECT_THAT(indurop({"plan", file, "-o", "svg"}).out, HasSubstr("<svg"));
  EXPECT_THAT(indurop({"plan", file, "-o", "csv"}).out, Not(IsEmpty()));
}

TEST_F(Configurations, Plan_writes_a_picture) {
  const std::string file = write(module("a", "1ms", 2));
  const std::string picture = (scratch() / "plan.svg").string();
  EXPECT_EQ(indurop({"plan", file, "--svg", picture}).code, 0);
  EXPECT_TRUE(std::filesystem::exists(picture));
  EXPECT_EQ(indurop({"plan", file, "--svg", "/nowhere/plan.svg"}).code, 1);
}

TEST_F(Configurations, Check_reports_every_mistake_with_its_place) {
  const std::string file = write(module("missing", "1ms", 2) + module("b", "0", 1) + "<modul/>\n");
  const auto sut = indurop({"check", file});
  EXPECT_EQ(sut.code, 4);
  EXPECT_THAT(sut.out, ContainsRegex("module.xml:4:[0-9]+: error: "));
  EXPECT_THAT(sut.out, ContainsRegex("module.xml:5:[0-9]+: error: "));
  EXPECT_THAT(sut.out, HasSubstr("FAILED  "));
  const auto json = json_of(indurop({"check", file, "-o", "json"}));
  EXPECT_EQ(json["ok"], false);
  EXPECT_GE(json["diagnostics"].size(), 2U);
  EXPECT_EQ(json["diagnostics"][0]["severity"], "error");
}

TEST_F(Configurations, Check_without_a_file_says_so) {
  const auto missing = indurop({"check", "/nowhere/module.xml"});
  EXPECT_EQ(missing.code, 1);
  EXPECT_THAT(missing.err, HasSubstr("/nowhere/module.xml"));
}

}  // namespace
}  // namespace indurop::test
