// SPDX-License-Identifier: Apache-2.0
// The plan of a board as text, and what becomes of it when the node is restarted.

#include "deploy/transaction/board_plan.h"

#include <gmock/gmock.h>

namespace indurop::deploy {
namespace {

using Act = ModulePlan::Act;

TEST(BoardPlan, Comes_out_of_its_text_as_it_was) {
  BoardPlan sut;
  sut.restart = "board a, module \"x\": <period> was 1ms";
  sut.tick = ~std::uint64_t{0};
  sut.left_out = 3;
  sut.schedule_tick = 5;
  for (const Act act : {Act::Kept, Act::Exchanged, Act::Fresh, Act::Open, Act::Rescheduled, Act::Added, Act::Ended,
                        Act::Restarted, Act::Refused}) {
    sut.modules.push_back({"m", act, "w\n"});
  }
  sut.pools = {{"n::eye", Act::Added, "sent to b"}, {"n::left", Act::Ended, ""}};
  const auto read = parse_board_plan(text_of(sut));
  ASSERT_TRUE(read);
  EXPECT_EQ(read->restart, sut.restart);
  EXPECT_EQ(read->tick, sut.tick);
  EXPECT_EQ(read->left_out, sut.left_out);
  EXPECT_EQ(read->schedule_tick, sut.schedule_tick);
  ASSERT_EQ(read->modules.size(), sut.modules.size());
  for (std::size_t i = 0; i < sut.modules.size(); ++i) {
    EXPECT_EQ(read->modules[i].act, sut.modules[i].act);
    EXPECT_EQ(read->modules[i].why, "w\n");
  }
  ASSERT_EQ(read->pools.size(), 2U);
  EXPECT_EQ(read->pools[0].pool, "n::eye");
  EXPECT_EQ(read->pools[0].act, Act::Added);
  EXPECT_EQ(read->pools[0].why, "sent to b");
  EXPECT_EQ(read->pools[1].act, Act::Ended);
}

TEST(BoardPlan, Of_an_earlier_release_says_nothing_about_pools) {
  const auto read = parse_board_plan(R"({"restart":"","tick":1,"left_out":0,"schedule_tick":0,"modules":[]})");
  ASSERT_TRUE(read);
  EXPECT_TRUE(read->pools.empty());
}

TEST(BoardPlan, What_is_no_plan_is_none) {
  for (const char* text :
       {"", "{}", "[]", R"({"restart":"","tick":-1,"left_out":0,"schedule_tick":0})",
        R"({"restart":"","tick":1,"left_out":0,"schedule_tick":0,"modules":[{"module":"m","act":"blown up"}]})",
        R"({"restart":"","tick":1,"left_out":0,"schedule_tick":0,"modules":[{"act":"kept"}]})",
        R"({"restart":"","tick":1,"left_out":0,"schedule_tick":0,"modules":[],"pools":[{"act":"kept"}]})"}) {
    EXPECT_FALSE(parse_board_plan(text)) << text;
  }
}

TEST(BoardPlan, A_restart_spares_no_module) {
  const BoardPlan sut = restarted(
      {"why", {{"a", Act::Kept, ""}, {"b", Act::Fresh, "x"}, {"c", Act::Added, ""}, {"d", Act::Rescheduled, "x"}}});
  EXPECT_EQ(sut.modules[0].act, Act::Restarted);
  EXPECT_EQ(sut.modules[1].act, Act::Restarted);
  EXPECT_EQ(sut.modules[1].why, "");
  EXPECT_EQ(sut.modules[2].act, Act::Added);
  EXPECT_EQ(sut.modules[3].act, Act::Restarted);
}

}  // namespace
}  // namespace indurop::deploy
