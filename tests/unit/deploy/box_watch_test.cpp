// SPDX-License-Identifier: Apache-2.0
#include "deploy/agent/box_watch.h"

#include <gmock/gmock.h>

namespace indurop::deploy {
namespace {

using testing::HasSubstr;

BoardReport report(std::uint64_t tick, std::uint64_t faults = 0, std::uint64_t overruns = 0) {
  BoardReport one;
  one.board = "sensor";
  one.agent = 7;
  one.node = NodeCondition::Running;
  one.tick = tick;
  one.faults = faults;
  one.overruns = overruns;
  return one;
}

TEST(BoxWatch, Tells_of_new_faults_and_of_many_overruns) {
  BoxWatch sut;
  EXPECT_EQ(sut.note_report(report(100, 3, 500)), std::nullopt) << "how old those are is not known";
  EXPECT_EQ(sut.note_report(report(600, 3, 509)), std::nullopt);
  EXPECT_THAT(sut.note_report(report(1100, 4, 509)).value_or(""), HasSubstr("board sensor faulted near its tick 1100"));
  EXPECT_EQ(sut.note_report(report(1600, 4, 509)), std::nullopt);
  EXPECT_THAT(sut.note_report(report(2100, 4, 519)).value_or(""), HasSubstr("10 overruns"));
}

TEST(BoxWatch, A_restarted_node_is_no_fault_and_one_that_died_is) {
  BoxWatch sut;
  EXPECT_EQ(sut.note_report(report(1000, 0)), std::nullopt);
  EXPECT_EQ(sut.note_report(report(10, 2)), std::nullopt) << "another run, with figures of its own";
  BoardReport dead = report(0);
  dead.node = NodeCondition::Restarting;
  dead.message = "was ended by signal 11";
  EXPECT_THAT(sut.note_report(dead).value_or(""), HasSubstr("signal 11"));
  EXPECT_EQ(sut.note_report(dead), std::nullopt) << "once";
}

TEST(BoxWatch, A_board_that_left_while_its_node_ran_is_reported_once) {
  BoxWatch sut;
  EXPECT_EQ(sut.gone(report(5)), std::nullopt) << "it was never there";
  EXPECT_EQ(sut.note_report(report(1000)), std::nullopt);
  EXPECT_THAT(sut.gone(report(1000)).value_or(""), HasSubstr("no longer reports"));
  EXPECT_EQ(sut.gone(report(1000)), std::nullopt);
}

}  // namespace
}  // namespace indurop::deploy
