// SPDX-License-Identifier: Apache-2.0
// What goes wrong on one board is kept on all of the plant, and the boxes tell of the same time.

#include "agents_fixture.h"

namespace indurop::test {
namespace {

using testing::HasSubstr;

class Boxes : public AgentsTest {
 protected:
  Boxes() {
    for (const char* module : {"late_fault", "late_overruns"}) {
      std::filesystem::copy_file(std::string(MODULE_FOLDER) + "/" + module + ".so",
                                 folder() / (std::string(module) + ".so"));
    }
    std::filesystem::copy_file(TWO_BOARDS "/table.so", folder() / "table.so");
  }
  void run_plant(const char* module) {
    start_agent("a");
    start_agent("b");
    const Outcome done = deploy(manifest("v1.xml", {{"a", module}, {"b", "steady"}}));
    ASSERT_EQ(done.code, 0) << done.err;
  }
  // The newest box of a board whose reason has this word; null while there is none.
  Json box(const std::string& name, const std::string& word) {
    const Json all = indurop_here({"blackbox", "--node", board(name), "-o", "json"}).json();
    for (const Json& one : all["boxes"]) {
      if (one["reason"].get<std::string>().find(word) != std::string::npos) {
        return one;
      }
    }
    return {};
  }
  // CLOCK_REALTIME of its first and last message.
  std::pair<std::int64_t, std::int64_t> span(const Json& box) {
    const Json info = indurop_here({"recording", "info", box["file"], "-o", "json"}).json();
    return {info["begin_ns"], info["end_ns"]};
  }
  void expect_same_time(const Json& one, const Json& other) {
    const auto a = span(one);
    const auto b = span(other);
    EXPECT_LT(std::max(a.first, b.first), std::min(a.second, b.second));
  }
};

TEST_F(Boxes, A_fault_on_one_board_is_kept_on_both) {
  run_plant("late_fault");
  ASSERT_TRUE(wait_until([&] { return !box("a", "fault of module").is_null() && !box("b", "faulted near").is_null(); }))
      << indurop_here({"blackbox"}).out;
  const Json other = box("b", "faulted near");
  EXPECT_THAT(other["reason"], HasSubstr("a module of board " + board("a")));
  expect_same_time(box("a", "fault of module"), other);
}

TEST_F(Boxes, Many_overruns_on_one_board_are_kept_on_both) {
  run_plant("late_overruns");
  ASSERT_TRUE(wait_until([&] { return !box("a", "overruns within").is_null() && !box("b", "had").is_null(); }))
      << indurop_here({"blackbox"}).out;
  expect_same_time(box("a", "overruns within"), box("b", "had"));
}

TEST_F(Boxes, A_user_may_want_one) {
  run_plant("steady");
  const Outcome kept = indurop_here({"blackbox", "keep", "the drill broke", "--node", board("a")});
  EXPECT_EQ(kept.code, 0) << kept.err;
  EXPECT_TRUE(wait_until([&] { return !box("a", "the drill broke").is_null(); }));
}

// The same list and the same messages as in the boards' own files.
TEST_F(Boxes, Those_of_all_boards_come_into_one_file) {
  run_plant("late_fault");
  ASSERT_TRUE(wait_until([&] { return !box("a", "fault of module").is_null() && !box("b", "faulted near").is_null(); }))
      << indurop_here({"blackbox"}).out;
  Json messages;
  for (const char* name : {"a", "b"}) {
    const Json remote = indurop({"blackbox", "--board", board(name), "-o", "json"}).json()["boxes"];
    const Json near = indurop_here({"blackbox", "--node", board(name), "-o", "json"}).json()["boxes"];
    ASSERT_EQ(remote.size(), near.size());
    for (std::size_t i = 0; i < near.size(); ++i) {
      EXPECT_EQ(remote[i]["reason"], near[i]["reason"]);
      EXPECT_EQ(remote[i]["bytes"], near[i]["bytes"]);
      EXPECT_EQ(remote[i]["file"], std::filesystem::path(near[i]["file"].get<std::string>()).filename().string());
    }
    const Json info = indurop_here({"recording", "info", near[0]["file"], "-o", "json"}).json();
    for (const Json& channel : info["channels"]) {
      messages[board(name) + "/" + channel["channel"].get<std::string>()] = channel["messages"];
    }
  }
  const Outcome fetched = indurop({"blackbox", "fetch", path("moment.mcap"), "--remote"});
  ASSERT_EQ(fetched.code, 0) << fetched.err;
  const Json joined = indurop_here({"recording", "info", path("moment.mcap"), "-o", "json"}).json();
  for (const Json& channel : joined["channels"]) {
    EXPECT_EQ(channel["messages"], messages[channel["channel"].get<std::string>()]) << channel["channel"];
  }
  EXPECT_EQ(joined["channels"].size(), messages.size());
  EXPECT_EQ(indurop_here({"blackbox", "fetch", path("here.mcap")}).code, 0) << "the nodes are of this host";
  const Json here = indurop_here({"recording", "info", path("here.mcap"), "-o", "json"}).json();
  EXPECT_EQ(here["channels"].size(), messages.size());
  EXPECT_EQ(indurop({"blackbox", "fetch", path("moment.mcap"), "--remote"}).code, 1) << "it is there already";
  EXPECT_EQ(indurop({"blackbox", "fetch", path("x.mcap"), "--remote", "--at", "../nothing.mcap"}).code, 1);
}

TEST_F(Boxes, A_condition_of_a_user_keeps_those_of_all_boards) {
  run_plant("table");
  Program& sut = start_indurop({"blackbox", "keep", "--when", "cell::torque", "--node", board("a"), "--remote"});
  EXPECT_EQ(indurop_here({"set", "--node", board("a"), "cell::torque", "1"}).code, 0);
  EXPECT_EQ(sut.wait(), 0) << sut.err();
  EXPECT_TRUE(wait_until([&] { return !box("a", "cell::torque").is_null() && !box("b", "cell::torque").is_null(); }));
}

TEST_F(Boxes, A_user_may_want_one_of_all_boards) {
  run_plant("steady");
  const Outcome kept = indurop({"blackbox", "keep", "the drill broke", "--remote"});
  EXPECT_EQ(kept.code, 0) << kept.err;
  EXPECT_TRUE(
      wait_until([&] { return !box("a", "the drill broke").is_null() && !box("b", "the drill broke").is_null(); }));
  stop_agent("b", SIGTERM);
  EXPECT_TRUE(wait_until([&] { return report("b").is_null(); }));
  const Outcome part = indurop({"blackbox", "fetch", path("part.mcap"), "--remote"});
  EXPECT_EQ(part.code, 1);
  EXPECT_THAT(part.err, HasSubstr("board " + board("b") + " has no black box of that moment"));
}

}  // namespace
}  // namespace indurop::test
