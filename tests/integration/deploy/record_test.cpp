// SPDX-License-Identifier: Apache-2.0
// Boards that are recorded from a desk, by their agents: what comes into the file, and what is left when desk, agent,
// recorder or node end in the middle.

#include "agents_fixture.h"

namespace indurop::test {
namespace {

using testing::HasSubstr;

class Record : public AgentsTest {
 protected:
  Record() { std::filesystem::copy_file(TWO_BOARDS "/table.so", folder() / "table.so"); }
  void start_boards() {
    start_agent("a");
    start_agent("b");
    plant_ = manifest("v1.xml", {{"a", "table"}, {"b", "steady"}});
    const Outcome done = deploy(plant_);
    ASSERT_EQ(done.code, 0) << done.err;
  }
  [[nodiscard]] std::vector<std::string> words(const std::string& file, std::vector<std::string> more = {}) const {
    more.insert(more.begin(), {"record", "--plant", plant_, "--remote", "-o", path(file)});
    return more;
  }
  // Of that board, the only one there is.
  [[nodiscard]] std::filesystem::path recording(const std::string& name) const {
    std::error_code none;
    for (const auto& entry : std::filesystem::directory_iterator(path("state/" + board(name) + "/recordings"), none)) {
      if (entry.path().extension() == ".mcap") {
        return entry.path();
      }
    }
    return {};
  }
  bool begun() {
    return wait_until([&] { return !recording("a").empty() && !recording("b").empty(); });
  }
  Json info(const std::string& file) { return indurop_here({"recording", "info", file, "-o", "json"}).json(); }
  // Values of a variable in the order of the file.
  std::vector<std::string> values(const std::string& file, const std::string& variable) {
    const Outcome done = indurop_here({"recording", "export", file, variable, "--csv", path("values.csv")});
    EXPECT_EQ(done.code, 0) << done.err;
    std::ifstream in(path("values.csv"));
    std::vector<std::string> all;
    for (std::string line; std::getline(in, line);) {
      all.push_back(line.substr(line.find(',') + 1));
    }
    all.erase(all.begin());
    std::filesystem::remove(path("values.csv"));
    return all;
  }
  std::string plant_;
};

// The reference is a recorder on the same host.
TEST_F(Record, Boards_elsewhere_come_into_one_file_with_what_they_did) {
  start_boards();
  Program& local = start({INDUROP_PROGRAM, "record", "--node", board("a"), "--past", "-o", path("near.mcap")});
  ASSERT_TRUE(wait_until([&] { return std::filesystem::exists(path("near.mcap")); }));
  const Outcome done = indurop(words("remote.mcap", {"--duration", "1s"}));
  EXPECT_EQ(done.code, 0) << done.err;
  EXPECT_THAT(done.err, HasSubstr("messages of " + board("a") + ", " + board("b")));
  local.signal(SIGINT);
  ASSERT_EQ(local.wait(), 130);

  const Json remote = info(path("remote.mcap"));
  std::map<std::string, std::uint64_t> runs;
  for (const Json& module : remote["modules"]) {
    EXPECT_EQ(module["lost_runs"], 0) << module;
    runs[module["board"]] = module["runs"];
  }
  EXPECT_GE(runs[board("a")], 400U) << remote["modules"];
  EXPECT_GE(runs[board("b")], 400U) << remote["modules"];
  const auto here = values(path("near.mcap"), "cell::encoder");
  const auto there = values(path("remote.mcap"), board("a") + "/cell::encoder");
  ASSERT_GE(there.size(), 100U);
  EXPECT_NE(std::search(here.begin(), here.end(), there.begin(), there.end()), here.end());
  EXPECT_FALSE(std::filesystem::exists(path("remote.mcap.parts")));
  EXPECT_TRUE(recording("a").empty()) << "it was fetched";
  EXPECT_EQ(indurop(words("remote.mcap", {"--duration", "1s"})).code, 1) << "it is there already";
}

TEST_F(Record, A_recorded_variable_may_be_on_one_board_only) {
  start_boards();
  const Outcome one = indurop(words("one.mcap", {"cell::encoder", "--duration", "300ms"}));
  EXPECT_EQ(one.code, 0) << one.err;
  EXPECT_EQ(info(path("one.mcap"))["nodes"].size(), 1U);
  const Outcome none = indurop(words("none.mcap", {"cell::encoder", "cell::nothing"}));
  EXPECT_EQ(none.code, 1);
  EXPECT_THAT(none.err, HasSubstr("no board has a variable 'cell::nothing'"));
  EXPECT_FALSE(std::filesystem::exists(path("none.mcap")));
  EXPECT_FALSE(std::filesystem::exists(path("none.mcap.parts")));
  EXPECT_TRUE(recording("a").empty());
}

TEST_F(Record, Ctrl_C_ends_it_and_a_desk_that_was_killed_leaves_whole_files) {
  start_boards();
  Program& desk = start_indurop(words("run.mcap"));
  ASSERT_TRUE(begun());
  desk.signal(SIGINT);
  const Outcome done = desk.finish();
  EXPECT_EQ(done.code, 130) << done.err;
  EXPECT_EQ(info(path("run.mcap"))["nodes"].size(), 2U);

  Program& killed = start_indurop(words("killed.mcap"));
  ASSERT_TRUE(begun());
  killed.signal(SIGKILL);
  (void)killed.wait();
  for (const char* name : {"a", "b"}) {
    EXPECT_TRUE(wait_until([&] { return info(recording(name))["closed"] == true; })) << name;
  }
  EXPECT_EQ(indurop(words("next.mcap", {"--duration", "300ms"})).code, 0) << "the next one begins";
  EXPECT_TRUE(recording("a").empty());
}

TEST_F(Record, Boards_that_fail_meanwhile_give_what_they_have_and_are_named) {
  start_boards();
  Program& desk = start_indurop(words("run.mcap"));
  ASSERT_TRUE(begun());
  stop_agent("a", SIGKILL);
  start_agent("a");
  ASSERT_TRUE(wait_until([&] { return !report("a").is_null() && info(recording("a"))["closed"] == true; }));
  kill_node(board("b"));
  ASSERT_TRUE(wait_until([&] { return info(recording("b"))["closed"] == true; }));
  desk.signal(SIGINT);
  const Outcome done = desk.finish();
  EXPECT_EQ(done.code, 1);
  EXPECT_THAT(done.err, HasSubstr("board " + board("a") + ": its agent"));
  // Its agent may not have noticed yet that the recorder has ended.
  EXPECT_THAT(done.err, HasSubstr("board " + board("b") + ": "));
  EXPECT_THAT(done.err, HasSubstr("node " + board("b") + " crashed or was killed"));
  EXPECT_EQ(info(path("run.mcap"))["nodes"].size(), 2U);
}

TEST_F(Record, Boards_that_cannot_be_recorded_are_named) {
  start_boards();
  stop_agent("b", SIGTERM);
  ASSERT_TRUE(wait_until([&] { return report("b").is_null(); }));
  const Outcome part = indurop(words("part.mcap", {"--duration", "300ms"}));
  EXPECT_EQ(part.code, 6);
  EXPECT_THAT(part.err, HasSubstr("board " + board("b") + " is not in the recording: its agent was not heard"));
  EXPECT_EQ(info(path("part.mcap"))["nodes"].size(), 1U);
  plant_ = manifest("v2.xml", {{"a", "table"}});
  std::filesystem::rename(plant_, path("other.xml"));
  std::ifstream in(path("other.xml"));
  std::string text{std::istreambuf_iterator<char>(in), {}};
  text.replace(text.find("name=\""), 6, "name=\"other");
  std::ofstream(plant_) << text;
  const Outcome other = indurop(words("other.mcap", {"--duration", "300ms"}));
  EXPECT_EQ(other.code, 1);
  EXPECT_THAT(other.err, HasSubstr("it runs plant p"));
  EXPECT_FALSE(std::filesystem::exists(path("other.mcap.parts")));
}

}  // namespace
}  // namespace indurop::test
