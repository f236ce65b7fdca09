// SPDX-License-Identifier: Apache-2.0
// indurop scope: every tick of a running node, from its tape.

#include <nlohmann/json.hpp>

#include "node_fixture.h"

namespace indurop::test {
namespace {

class Scope : public NodeTest {
 protected:
  Outcome scope(std::vector<std::string> words) const {
    words.insert(words.begin(), "scope");
    words.insert(words.end(), {"--node", node()});
    return indurop(words);
  }
  const std::vector<Module> kModules = {{.file = "counter.so", .name = "counter", .priority = 1},
                                        {.file = "walker.so", .name = "walker", .period = "2ms", .priority = 2}};
};

TEST_F(Scope, Sees_every_tick) {
  start_and_wait(kModules, {"--sim", "--speed", "1"});
  const Outcome sut = scope({"nt::counted", "nt::walked", "half = nt::counted / 2", "--trigger",
                             "nt::counted % 500 == 0", "--pre", "300", "--post", "600", "-o", "json"});
  ASSERT_EQ(sut.code, 0) << sut.err;
  const auto json = nlohmann::json::parse(sut.out);
  EXPECT_EQ(json["schema_version"], 1);
  EXPECT_EQ(json["rows"], 901);
  EXPECT_EQ(json["trigger_row"], 300);
  EXPECT_EQ(json["lost_runs"], 0);
  EXPECT_EQ(json["period_ns"], 1'000'000);
  const auto counted = json["lines"][0]["values"].get<std::vector<double>>();
  EXPECT_EQ(static_cast<long>(counted[300]) % 500, 0);
  for (std::size_t i = 1; i < counted.size(); ++i) {
    ASSERT_EQ(counted[i], counted[i - 1] + 1) << "row " << i;
  }
  const auto half = json["lines"][2]["values"].get<std::vector<double>>();
  EXPECT_EQ(half[7], counted[7] / 2);
  const auto walked = json["lines"][1]["values"].get<std::vector<double>>();
  EXPECT_TRUE(walked[0] == walked[1] || walked[1] == walked[2]) << "it runs in every second tick";
}

TEST_F(Scope, Makes_a_picture_for_each_trigger) {
  start_and_wait(kModules);
  const Outcome sut = scope({"nt::counted", "--trigger", "nt::counted % 100 == 0", "--pre", "2", "--post", "3",
                             "--mode", "normal", "-n", "3", "-o", "csv", "--save", folder() / "run.svg"});
  EXPECT_EQ(sut.code, 0) << sut.err;
  std::size_t headings = 0;
  for (auto at = sut.out.find("time_ns,nt::counted"); at != std::string::npos; at = sut.out.find("time_ns", at + 1)) {
    ++headings;
  }
  EXPECT_EQ(headings, 3U);
  for (const char* file : {"run.svg", "run-2.svg", "run-3.svg"}) {
    EXPECT_TRUE(std::filesystem::exists(folder() / file)) << file;
  }
}

TEST_F(Scope, Shows_a_picture_without_a_trigger_if_it_may) {
  start_and_wait(kModules);
  const Outcome none = scope({"nt::counted", "--trigger", "nt::sum > 1000", "--timeout", "300ms"});
  EXPECT_EQ(none.code, 6);
  EXPECT_CONTAINS(none.err, "no trigger within 0.3 s, in ");
  const Outcome sut =
      scope({"nt::counted", "--trigger", "nt::sum > 1000", "--mode", "auto", "-n", "1", "--pre", "10", "--post", "20"});
  EXPECT_EQ(sut.code, 0) << sut.err;
  EXPECT_CONTAINS(sut.out, "31 ticks from tick ");
  EXPECT_CONTAINS(sut.out, "without a trigger");
  EXPECT_CONTAINS(scope({"nt::counted", "--pre", "0", "--post", "4"}).out, "5 ticks from tick ");
}

TEST_F(Scope, Saves_what_others_read) {
  Program& node = start_and_wait(kModules);
  const std::string mcap = folder() / "run.mcap";
  const Outcome sut = scope({"nt::counted", "--past", "--save", mcap, "--save", folder() / "run.csv", "-q"});
  EXPECT_EQ(sut.code, 0) << sut.err;
  EXPECT_EQ(std::filesystem::file_size(mcap) > 1000, true);
  EXPECT_EQ(indurop({"chart", folder() / "run.csv"}).code, 0);
  EXPECT_EQ(scope({"nt::counted", "--save", mcap}).code, 1) << "it is there already";
  EXPECT_EQ(scope({"nt::counted", "--save", "run.txt"}).code, 2);
  EXPECT_EQ(scope({"missing"}).code, 1);
  EXPECT_EQ(scope({"nt::counted", "--post", "1000000"}).code, 2);
  node.signal(SIGTERM);
  EXPECT_EQ(node.wait(), 0);
  EXPECT_EQ(scope({"nt::counted"}).code, 6);
}

}  // namespace
}  // namespace indurop::test
