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

}  // namespace
}  // namespace indurop::test
