// SPDX-License-Identifier: Apache-2.0
// What is done with existing recordings: shown, exported, cut, played into a node; whole, cut and damaged
// ones.

#include <algorithm>
#include <csignal>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <random>

#include "node_fixture.h"

namespace indurop::test {
namespace {

namespace fs = std::filesystem;

class RecordingTools : public NodeTest {
 protected:
  void SetUp() override {
    const Outcome recorded = run_to_end({{.file = "counter.so", .name = "counter", .priority = 1},
                                         {.file = "walker.so", .name = "walker", .period = "2ms", .priority = 2}},
                                        {"--sim", "--until", "1s", "--record", file()});
    ASSERT_EQ(recorded.code, 0) << recorded.err;
  }
  [[nodiscard]] std::string file() const { return (folder() / "run.mcap").string(); }
  [[nodiscard]] std::string path(const std::string& name) const { return (folder() / name).string(); }
  Outcome recording(std::vector<std::string> words) const {
    words.insert(words.begin(), "recording");
    return indurop(words);
  }
  static std::string text_of(const std::string& name) {
    std::ifstream in(name, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }
};

TEST_F(RecordingTools, Info_counts_runs_and_messages) {
  const Outcome info = recording({"info", file(), "-o", "json"});
  ASSERT_EQ(info.code, 0) << info.err;
  const nlohmann::json all = info.json();
  EXPECT_EQ(all["closed"], true);
  EXPECT_EQ(all["nodes"][0]["node"], node());
  EXPECT_EQ(all["attachments"][0], "module.xml");
  EXPECT_EQ(std::count(all["attachments"].begin(), all["attachments"].end(), "indurop.facts.json"), 1);
  ASSERT_EQ(all["modules"].size(), 2U);
  EXPECT_EQ(all["modules"][0]["module"], "counter");
  EXPECT_EQ(all["modules"][0]["runs"], 1000);
  EXPECT_EQ(all["modules"][1]["last_tick"], 998);
  EXPECT_EQ(all["modules"][1]["lost_runs"], 0);
  std::uint64_t messages = 0;
  for (const auto& channel : all["channels"]) {
    messages += channel["messages"].get<std::uint64_t>();
  }
  EXPECT_EQ(all["messages"], messages);
  EXPECT_CONTAINS(recording({"info", file()}).out, "nt::walked");
  EXPECT_EQ(recording({"info", path("module.xml")}).code, 1);
  EXPECT_EQ(recording({}).code, 2);
}

TEST_F(RecordingTools, Export_writes_values_and_runs) {
  ASSERT_EQ(recording({"export", file(), "nt::counted", "--csv", path("a.csv"), "--trace", path("t.json")}).code, 0);
  const std::string csv = text_of(path("a.csv"));
  EXPECT_EQ(csv.substr(0, csv.find('\n')), "time_ns,nt::counted");
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 1002) << "a heading, the first value, and one for each run";
  EXPECT_TRUE(csv.ends_with(",1000\n"));
  const auto trace = nlohmann::json::parse(text_of(path("t.json")));
  EXPECT_EQ(trace["traceEvents"].size(), 1500U + 3U);
  EXPECT_EQ(indurop({"chart", path("a.csv")}).code, 0) << "chart draws it";
  ASSERT_EQ(recording({"export", file(), "nt::pace", "--csv", path("b.csv"), "--every", "100ms"}).code, 0);
  const std::string rows = text_of(path("b.csv"));
  EXPECT_EQ(rows.substr(0, rows.find('\n')), "time_ns,nt::pace.walked,nt::pace.own");
  EXPECT_LE(std::count(rows.begin(), rows.end(), '\n'), 12);
  EXPECT_CONTAINS(recording({"export", file(), "missing", "--csv", path("c.csv")}).err, "no variable 'missing'");
  EXPECT_EQ(recording({"export", file()}).code, 2);
}

TEST_F(RecordingTools, A_part_is_replayed_as_far_as_it_can_be) {
  ASSERT_EQ(recording({"cut", file(), "--to", "500ms", "-o", path("first.mcap")}).code, 0);
  const Outcome first = indurop({"replay", path("first.mcap"), "--node", node() + "-r"});
  EXPECT_EQ(first.code, 0) << first.err;
  EXPECT_CONTAINS(first.out, "500 ticks, 750 runs, 1500 values: equal");
  const Outcome cut = recording({"cut", file(), "--from", "500ms", "--to", "700ms", "-o", path("middle.mcap")});
  EXPECT_EQ(cut.code, 0) << cut.err;
  EXPECT_CONTAINS(cut.err, "does not begin with the first run");
  const Outcome middle = indurop({"replay", path("middle.mcap"), "--node", node() + "-r"});
  EXPECT_EQ(middle.code, 4) << "walker keeps something inside";
  EXPECT_CONTAINS(middle.err, "its internal state may differ");
  EXPECT_CONTAINS(middle.err, "module walker: nt::pace was");
  const auto runs = recording({"info", path("middle.mcap"), "-o", "json"}).json()["modules"][1]["runs"].get<int>();
  EXPECT_CONTAINS(middle.out,
                  "nt::pace of walker: " + std::to_string(runs) + " of " + std::to_string(runs) + " runs, ");
  EXPECT_FALSE(contains(middle.out, "of counter:")) << "counter does not, its inputs are there: " << middle.out;
  EXPECT_EQ(recording({"cut", file(), "--from", "5s", "-o", path("no.mcap")}).code, 1);
  EXPECT_FALSE(fs::exists(path("no.mcap")));
  EXPECT_EQ(recording({"cut", file(), "--from", "2s", "--to", "1s", "-o", path("no.mcap")}).code, 2);
  EXPECT_EQ(recording({"cut", file(), "-o", path("first.mcap")}).code, 1) << "it is there already";
}

// What came after the part is not known, which is not the same as that nothing ran.
TEST_F(RecordingTools, Explains_a_part_up_to_its_end) {
  ASSERT_EQ(recording({"cut", file(), "--to", "500ms", "-o", path("first.mcap")}).code, 0);
  ASSERT_EQ(recording({"cut", file(), "--from", "500ms", "-o", path("last.mcap")}).code, 0);
  ASSERT_EQ(recording({"cut", path("last.mcap"), "--to", "200ms", "-o", path("middle.mcap")}).code, 0);
  for (const std::string part : {"first.mcap", "middle.mcap"}) {
    const Outcome late = indurop({"explain", "counter", "--from", path(part)});
    EXPECT_CONTAINS(late.out, "counter ran whenever it was due and was not late");
    EXPECT_CONTAINS(indurop({"explain", "nt::counted", "--from", path(part)}).out,
                    "counter changed nt::counted in its last run");
  }
}

TEST_F(RecordingTools, Play_gives_a_running_node_what_no_module_writes) {
  Program& sut = start_and_wait({{.file = "walker.so", .name = "walker", .period = "2ms"}});
  const Outcome played = recording({"play", file(), "--node", node(), "--speed", "4"});
  EXPECT_EQ(played.code, 0) << played.err;
  EXPECT_CONTAINS(played.err, "wrote ");
  EXPECT_EQ(value<std::uint32_t>("nt::counted"), 1000U);
  EXPECT_CONTAINS(recording({"play", file(), "missing", "--node", node()}).err, "none of the recorded variables");
  sut.signal(SIGTERM);
  EXPECT_EQ(sut.wait(), 0);
  EXPECT_EQ(recording({"play", file(), "--node", node()}).code, 1) << "no node runs";
}

TEST_F(RecordingTools, Play_refuses_what_is_forced) {
  Program& sut = start_and_wait({{.file = "walker.so", .name = "walker", .period = "2ms"}});
  ASSERT_EQ(indurop({"force", "nt::counted", "7", "--node", node()}).code, 0);
  const Outcome refused = recording({"play", file(), "--node", node(), "--speed", "100"});
  EXPECT_EQ(refused.code, 1);
  EXPECT_CONTAINS(refused.err, "nt::counted is forced; release it first: indurop unforce");
  EXPECT_FALSE(contains(refused.err, "wrote ")) << refused.err;
  EXPECT_EQ(recording({"play", file(), "nt::kept", "--node", node(), "--speed", "100"}).code, 0);
  sut.signal(SIGTERM);
  EXPECT_EQ(sut.wait(), 0);
}

// Whatever is wrong with a file: a message, no crash, and what was begun is removed.
TEST_F(RecordingTools, Damaged_files_are_reported_and_read_up_to_the_damage) {
  const std::string whole = text_of(file());
  std::mt19937 random(7);
  for (int i = 0; i < 24; ++i) {
    std::string bad = whole;
    if (i % 2 == 0) {
      bad.resize(random() % whole.size());
    }
    for (int n = 0; n < i && !bad.empty(); ++n) {
      bad[random() % bad.size()] = static_cast<char>(random());
    }
    const std::string name = path("bad" + std::to_string(i) + ".mcap");
    std::ofstream(name, std::ios::binary) << bad;
    const std::string out = path("out" + std::to_string(i));
    for (const Outcome& outcome :
         {recording({"info", name}), recording({"export", name, "--csv", out + ".csv", "--trace", out + ".json"}),
          recording({"cut", name, "--from", "100ms", "-o", out + ".mcap"})}) {
      EXPECT_TRUE(outcome.code == 0 || outcome.code == 1) << i << ": " << outcome.code << outcome.err;
      EXPECT_FALSE(outcome.code == 1 && outcome.err.empty()) << i;
    }
  }
}

}  // namespace
}  // namespace indurop::test
