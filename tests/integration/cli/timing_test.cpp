// SPDX-License-Identifier: Apache-2.0
// jitter, overruns, log.
#include <filesystem>
#include <sstream>

#include "fixture.h"

namespace indurop::test {
namespace {

std::string read(const std::string& path) {
  std::ifstream in(path);
  std::stringstream text;
  text << in.rdbuf();
  return text.str();
}

TEST_F(WithNode, Jitter_has_four_quantities_per_module) {
  const auto sut = indurop({"jitter", "modify"});
  EXPECT_EQ(sut.code, 0);
  EXPECT_THAT(sut.out, ContainsRegex("MODULE +QUANTITY +RUNS +LAST +MIN +MEAN +P50 +P99 +P99.9 +MAX"));
  EXPECT_THAT(sut.out, ContainsRegex("exec +[0-9]+ +20.0 us +20.0 us"));
  EXPECT_THAT(sut.out, Not(HasSubstr("output")));
  EXPECT_EQ(indurop({"jitter", "missing"}).code, 1);
}

TEST_F(WithNode, Jitter_as_json_uses_the_names_of_the_report) {
  const auto json = indurop({"jitter", "-o", "json", "--histogram"}).json();
  ASSERT_EQ(json["modules"].size(), 3U);
  const auto& exec = json["modules"][0]["exec_ns"];
  EXPECT_EQ(exec["min"], 20'000);
  EXPECT_EQ(exec["p99_9"], 20'000);
  std::uint64_t total = 0;
  for (const auto& bin : exec["histogram"]) {
    total += bin[2].get<std::uint64_t>();
  }
  EXPECT_GE(total, exec["count"].get<std::uint64_t>() > 0 ? 1U : 0U);
}

TEST_F(WithNode, Jitter_draws_in_text_and_as_a_picture) {
  EXPECT_THAT(indurop({"jitter", "modify", "--histogram"}).out, HasSubstr("modify  jitter"));
  const std::string file = (scratch() / "jitter.svg").string();
  EXPECT_EQ(indurop({"jitter", "--svg", file}).code, 0);
  EXPECT_THAT(read(file), StartsWith("<svg "));
  const auto refused = indurop({"jitter", "--svg", "/nowhere/x.svg"});
  EXPECT_EQ(refused.code, 1);
  EXPECT_THAT(refused.err, HasSubstr("/nowhere/x.svg"));
}

TEST_F(WithNode, Overruns_name_the_culprit) {
  const auto sut = indurop({"overruns"});
  EXPECT_EQ(sut.code, 0);
  EXPECT_THAT(sut.out, ContainsRegex("41 +1 +output +1.20 ms +30.0 us +modify +2.50 ms"));
  const auto json = indurop({"overruns", "-o", "json"}).json();
  EXPECT_EQ(json["total"], 1);
  EXPECT_EQ(json["overruns"][0]["previous"], "modify");
  EXPECT_EQ(indurop({"overruns", "modify", "-o", "json"}).json()["overruns"].size(), 0U);
}

TEST_F(WithNode, Log_shows_the_newest_runs) {
  const auto json = indurop({"log", "-n", "5", "-o", "json"}).json();
  ASSERT_EQ(json["runs"].size(), 5U);
  EXPECT_EQ(json["runs"][4]["exec_ns"], 20'000);
  EXPECT_GE(json["runs"][4]["tick"], json["runs"][0]["tick"]);
}

TEST_F(WithNode, Log_writes_a_trace_with_one_track_per_module) {
  const std::string file = (scratch() / "trace.json").string();
  EXPECT_EQ(indurop({"log", "--trace", file}).code, 0);
  const auto json = nlohmann::json::parse(read(file), nullptr, false);
  ASSERT_TRUE(json.is_object());
  std::size_t tracks = 0;
  std::size_t slices = 0;
  for (const auto& event : json["traceEvents"]) {
    tracks += event["name"] == "thread_name" ? 1U : 0U;
    slices += event["ph"] == "X" ? 1U : 0U;
  }
  EXPECT_EQ(tracks, 3U);
  EXPECT_GT(slices, 10U);
}

}  // namespace
}  // namespace indurop::test
