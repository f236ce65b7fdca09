// SPDX-License-Identifier: Apache-2.0
// check and plan on configurations and on manifests of plants.
#include <algorithm>
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
  const auto json = indurop({"plan", file, "-o", "json"}).json();
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
  const auto json = indurop({"check", file, "-o", "json"}).json();
  EXPECT_EQ(json["ok"], false);
  EXPECT_GE(json["diagnostics"].size(), 2U);
  EXPECT_EQ(json["diagnostics"][0]["severity"], "error");
}

TEST_F(Configurations, Check_without_a_file_says_so) {
  const auto missing = indurop({"check", "/nowhere/module.xml"});
  EXPECT_EQ(missing.code, 1);
  EXPECT_THAT(missing.err, HasSubstr("/nowhere/module.xml"));
}

// The example two_boards as it was built.
const std::filesystem::path kTwoBoards = std::filesystem::path(TWO_BOARDS) / "plant.xml";

TEST_F(Configurations, Check_shows_the_boards_of_a_plant_and_what_travels) {
  const auto sut = indurop({"check", kTwoBoards});
  EXPECT_EQ(sut.code, 0) << sut.out << sut.err;
  EXPECT_THAT(sut.out, ContainsRegex("\nsensor +1 +1 ms +1 ms"));
  EXPECT_THAT(sut.out, ContainsRegex("\ncell::encoder +cell::Encoder +sensor +table@sensor +controller@control +2 ms"));
  EXPECT_THAT(sut.out, ContainsRegex("note: controller@control gets cell::encoder from table@sensor up to 2 ms old"));
  EXPECT_THAT(sut.out, ContainsRegex("\nOK  2 boards, 2 modules, [0-9]+ shared variables, [0-9]+ between boards"));
  const auto json = indurop({"check", kTwoBoards, "-o", "json"}).json();
  EXPECT_EQ(json["schema_version"], 1);
  EXPECT_EQ(json["ok"], true);
  EXPECT_EQ(json["plant"], "two_boards");
  EXPECT_EQ(json["boards"][1]["name"], "control");
  EXPECT_EQ(json["boards"][1]["basic_period_ns"], 1'000'000);
  const auto& routes = json["routes"];
  const auto encoder = std::find_if(routes.begin(), routes.end(),
                                    [](const auto& route) { return route["variable"] == "cell::encoder"; });
  ASSERT_NE(encoder, routes.end());
  EXPECT_EQ((*encoder)["owner"], "sensor");
  EXPECT_EQ((*encoder)["to"], nlohmann::json::parse(R"(["control"])"));
  EXPECT_EQ((*encoder)["readers"], nlohmann::json::parse(R"(["controller@control"])"));
  EXPECT_EQ((*encoder)["oldest_ns"], 2'000'000);
  EXPECT_THAT(indurop({"check", kTwoBoards, "-o", "csv"}).out, StartsWith("variable,type,owner,to,"));
  const auto quiet = indurop({"check", "-q", kTwoBoards});
  EXPECT_THAT(quiet.out, Not(HasSubstr("RUNS/S")));
}

class Plants : public Configurations {
 protected:
  std::string write_plant(const std::string& content) {
    const std::string file = (scratch() / "plant.xml").string();
    put(file, "<plant name=\"cell\">\n" + content + "</plant>\n");
    return file;
  }
};

TEST_F(Plants, Check_reports_every_mistake_of_all_boards) {
  const std::string file = write_plant("<board name=\"a\">" + module("missing", "1ms", 1) +
                                       "</board>\n<board name=\"b\">" + module("absent", "10us", 1) + "</board>\n");
  const auto sut = indurop({"check", file});
  EXPECT_EQ(sut.code, 4);
  EXPECT_THAT(sut.out, ContainsRegex("plant.xml:2:[0-9]+: error: no such file: './missing.so'"));
  EXPECT_THAT(sut.out, ContainsRegex("plant.xml:4:[0-9]+: error: no such file: './absent.so'"));
  EXPECT_THAT(sut.out, ContainsRegex("plant.xml:4:[0-9]+: error: the basic period"));
  EXPECT_THAT(sut.out, HasSubstr("FAILED  3 errors"));
  const auto wrong = indurop({"check", write_plant("<bord/>\n"), "-o", "json"});
  EXPECT_EQ(wrong.code, 4);
  EXPECT_EQ(wrong.json()["ok"], false);
  EXPECT_EQ(wrong.json()["boards"].size(), 0U);
}

TEST_F(Plants, Plan_shows_every_board) {
  const std::string file =
      write_plant("<board name=\"a\">" + module("x", "1ms", 2) + module("y", "2ms", 1) +
                  "</board>\n<board name=\"b\">" + module("x", "5ms", 1) + "</board>\n<board name=\"viewer\"/>\n");
  const auto text = indurop({"plan", file});
  EXPECT_EQ(text.code, 0) << text.err;
  EXPECT_THAT(text.out, StartsWith("Board a\n"));
  EXPECT_THAT(text.out, HasSubstr("\nBoard b\n"));
  EXPECT_THAT(text.out, HasSubstr("y > x"));
  const auto json = indurop({"plan", file, "-o", "json"}).json();
  EXPECT_EQ(json["boards"].size(), 3U);
  EXPECT_EQ(json["boards"][1]["name"], "b");
  EXPECT_EQ(json["boards"][1]["macro_period_ns"], 5'000'000);
  EXPECT_EQ(json["boards"][0]["slots"][0]["modules"], nlohmann::json::parse(R"(["y","x"])"));
  EXPECT_THAT(indurop({"plan", file, "-o", "csv"}).out, HasSubstr("\nb,0,0,x\n"));
  EXPECT_THAT(indurop({"plan", file, "-o", "svg"}).out, HasSubstr("Schedule of board b"));
}

TEST_F(Plants, A_plant_is_found_where_there_is_no_module_xml) {
  const std::filesystem::path folder = scratch() / "found";
  std::filesystem::create_directory(folder);
  const auto here = std::filesystem::current_path();
  std::filesystem::current_path(folder);
  const auto none = indurop({"plan"});
  put("plant.xml", "<plant name=\"cell\"><board name=\"only\"/></plant>");
  const auto sut = indurop({"plan"});
  std::filesystem::current_path(here);
  EXPECT_EQ(none.code, 2);
  EXPECT_THAT(none.err, HasSubstr("there is no module.xml or plant.xml here"));
  EXPECT_EQ(sut.code, 0);
  EXPECT_THAT(sut.out, StartsWith("Board only\n"));
}

}  // namespace
}  // namespace indurop::test
