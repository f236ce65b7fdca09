// SPDX-License-Identifier: Apache-2.0
// The deployer: what it tells the boards, and what it makes of their answers.

#include "deploy/transaction/plant_transaction.h"

#include <gmock/gmock.h>

namespace indurop::deploy {
namespace {

using Verdict = PlantTransaction::Verdict;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Key;
using testing::Pair;

constexpr std::chrono::seconds kPlantSecond{1};
constexpr std::chrono::nanoseconds kPlantOneNs{1};

Order make_order() {
  Order order;
  order.deployer = 7;
  order.deployment = "new";
  order.generation = 4;
  order.boards = {"a", "b"};
  order.health_ns = std::chrono::nanoseconds(kPlantSecond).count();
  return order;
}

class Deployer : public testing::Test {
 protected:
  BoardReport report(const std::string& board, Phase phase) const {
    BoardReport out;
    out.board = board;
    out.agent = board == "a" ? 1 : 2;
    out.deployer = 7;
    out.phase = phase;
    out.node = NodeCondition::Running;
    out.current = "old";
    out.generation = 3;
    return out;
  }
  void say(const BoardReport& report) { sut_.receive(report, now_); }
  void all(Phase phase) {
    say(report("a", phase));
    say(report("b", phase));
  }
  bool time() { return sut_.time(now_, wall_); }
  // Advances the time in steps, as a deployer does.
  void listen_for(std::chrono::nanoseconds duration) {
    for (const rt::MonoTime end = now_ + duration; now_ < end;) {
      now_ += std::chrono::milliseconds{100};
      time();
    }
  }
  void to_trial() {
    all(Phase::Prepared);
    ASSERT_TRUE(time());
    ASSERT_EQ(sut_.order().step, Step::Switch);
    all(Phase::Trial);
  }

  rt::MonoTime now_{50 * kPlantSecond};
  rt::WallTime wall_{1'000 * kPlantSecond};
  PlantTransaction sut_{make_order(), 5 * kPlantSecond, now_};
};

TEST_F(Deployer, Switches_when_all_are_prepared_and_commits_when_all_are_healthy) {
  EXPECT_EQ(sut_.order().step, Step::Prepare);
  say(report("a", Phase::Prepared));
  EXPECT_FALSE(time());
  say(report("b", Phase::Prepared));
  EXPECT_TRUE(time());
  EXPECT_EQ(sut_.order().step, Step::Switch);
  EXPECT_EQ(sut_.order().switch_at_ns, rt::to_ns(wall_ + PlantTransaction::kSwitchAhead));
  say(report("a", Phase::Healthy));
  say(report("b", Phase::Trial));
  EXPECT_FALSE(time());
  say(report("b", Phase::Healthy));
  EXPECT_TRUE(time());
  EXPECT_EQ(sut_.order().step, Step::Commit);
  EXPECT_FALSE(sut_.finished());
  for (const char* board : {"a", "b"}) {
    BoardReport done = report(board, Phase::Steady);
    done.current = "new";
    done.generation = 4;
    say(done);
  }
  time();
  EXPECT_TRUE(sut_.finished());
  EXPECT_EQ(sut_.verdict(), Verdict::Committed);
  EXPECT_TRUE(sut_.unconfirmed().empty());
}

TEST_F(Deployer, A_board_that_cannot_prepare_leaves_everything_as_it_was) {
  say(report("a", Phase::Prepared));
  BoardReport failed = report("b", Phase::Failed);
  failed.stage = Phase::Fetching;
  failed.message = "disk full";
  say(failed);
  time();
  EXPECT_EQ(sut_.order().step, Step::Abort);
  all(Phase::Steady);
  time();
  EXPECT_TRUE(sut_.finished());
  EXPECT_EQ(sut_.verdict(), Verdict::Refused);
  EXPECT_THAT(sut_.reasons(), ElementsAre(Pair("b", "disk full")));
}

TEST_F(Deployer, A_check_that_fails_on_a_board_is_distinguished) {
  BoardReport failed = report("b", Phase::Failed);
  failed.stage = Phase::Checking;
  say(failed);
  EXPECT_EQ(sut_.verdict(), Verdict::CheckFailed);
}

TEST_F(Deployer, A_fault_in_the_trial_rolls_all_boards_back) {
  to_trial();
  BoardReport failed = report("b", Phase::Failed);
  failed.stage = Phase::Trial;
  failed.message = "module x faulted";
  say(failed);
  EXPECT_EQ(sut_.order().step, Step::Abort);
  EXPECT_EQ(sut_.verdict(), Verdict::RolledBack);
  say(report("a", Phase::Trial));
  time();
  EXPECT_FALSE(sut_.finished());
  BoardReport restarting = report("a", Phase::Steady);
  restarting.node = NodeCondition::Starting;
  say(restarting);
  say(report("b", Phase::Steady));
  time();
  EXPECT_FALSE(sut_.finished()) << "the old node of a is not up again";
  say(report("a", Phase::Steady));
  time();
  EXPECT_TRUE(sut_.finished());
}

TEST_F(Deployer, A_board_that_dies_in_the_trial_rolls_all_boards_back) {
  to_trial();
  sut_.board_lost("b", 99, now_);
  listen_for(2 * PlantTransaction::kLost);
  EXPECT_EQ(sut_.order().step, Step::Switch) << "another agent";
  sut_.board_lost("b", 2, now_);
  listen_for(PlantTransaction::kLost);
  EXPECT_EQ(sut_.order().step, Step::Switch) << "it may come back";
  now_ += kPlantOneNs;
  time();
  EXPECT_EQ(sut_.verdict(), Verdict::RolledBack);
  time();
  EXPECT_FALSE(sut_.finished()) << "a has not gone back yet";
  say(report("a", Phase::Steady));
  time();
  EXPECT_TRUE(sut_.finished()) << "b goes back on its own";
}

TEST_F(Deployer, A_board_that_is_lost_for_a_moment_ends_nothing) {
  to_trial();
  all(Phase::Healthy);
  sut_.board_lost("b", 2, now_);
  time();
  EXPECT_EQ(sut_.order().step, Step::Switch) << "its state is not known";
  listen_for(PlantTransaction::kLost);
  say(report("b", Phase::Healthy));
  listen_for(2 * PlantTransaction::kLost);
  EXPECT_EQ(sut_.verdict(), Verdict::Committed);
}

TEST_F(Deployer, What_the_deployer_slept_itself_is_no_silence_of_a_board) {
  to_trial();
  sut_.board_lost("b", 2, now_);
  now_ += 2 * PlantTransaction::kLost;
  time();
  EXPECT_EQ(sut_.order().step, Step::Switch);
}

TEST_F(Deployer, A_board_that_is_heard_again_is_waited_for) {
  to_trial();
  sut_.board_lost("b", 2, now_);
  listen_for(2 * PlantTransaction::kLost);
  say(report("b", Phase::Trial));
  say(report("a", Phase::Steady));
  time();
  EXPECT_FALSE(sut_.finished());
  say(report("b", Phase::Steady));
  time();
  EXPECT_TRUE(sut_.finished());
}

TEST_F(Deployer, An_agent_that_was_started_again_does_not_count_as_the_same) {
  all(Phase::Fetching);
  BoardReport again = report("b", Phase::Steady);
  again.agent = 5;
  say(again);
  EXPECT_EQ(sut_.order().step, Step::Abort);
  EXPECT_THAT(sut_.reasons().at("b"), HasSubstr("again"));
}

TEST_F(Deployer, A_board_that_gives_up_ends_it) {
  all(Phase::Prepared);
  BoardReport steady = report("b", Phase::Steady);
  steady.message = "not heard";
  say(steady);
  EXPECT_EQ(sut_.order().step, Step::Abort);
}

TEST_F(Deployer, After_the_commit_was_said_nothing_takes_it_back) {
  to_trial();
  all(Phase::Healthy);
  time();
  BoardReport failed = report("b", Phase::Failed);
  say(failed);
  sut_.board_lost("b", 2, now_);
  sut_.give_up(now_);
  EXPECT_EQ(sut_.verdict(), Verdict::Committed);
  now_ += PlantTransaction::kWindUp + kPlantOneNs;
  time();
  EXPECT_TRUE(sut_.finished());
  EXPECT_THAT(sut_.unconfirmed(), ElementsAre("a", "b"));
}

TEST_F(Deployer, Boards_of_another_deployer_are_busy_after_a_while) {
  BoardReport other = report("b", Phase::Trial);
  other.deployer = 3;
  other.deployer_host = "desk";
  other.proposed = "0123456789abcdef";
  say(other);
  time();
  EXPECT_EQ(sut_.order().step, Step::Prepare);
  now_ += PlantTransaction::kBusy + kPlantOneNs;
  time();
  EXPECT_EQ(sut_.verdict(), Verdict::Busy);
  EXPECT_EQ(sut_.reasons().at("b"), "busy with deployment 0123456789ab of desk");
}

TEST_F(Deployer, Of_two_at_once_the_earlier_goes_on) {
  Order rival = make_order();
  rival.deployer = 8;
  rival.boards = {"b", "c"};
  sut_.rival(rival, now_);
  EXPECT_EQ(sut_.verdict(), Verdict::Open);
  rival.deployer = 6;
  rival.boards = {"c"};
  sut_.rival(rival, now_);
  EXPECT_EQ(sut_.verdict(), Verdict::Open) << "no board in common";
  rival.boards = {"b"};
  sut_.rival(rival, now_);
  EXPECT_EQ(sut_.verdict(), Verdict::Busy);
}

// No board is known to follow the order yet, so it ends at once; boards that do follow it must receive its end.
TEST_F(Deployer, What_ends_before_any_board_answered_is_published_all_the_same) {
  EXPECT_FALSE(sut_.time(now_, wall_));
  Order rival = make_order();
  rival.deployer = 6;
  sut_.rival(rival, now_);
  EXPECT_TRUE(sut_.time(now_, wall_));
  EXPECT_EQ(sut_.order().step, Step::Abort);
  EXPECT_FALSE(sut_.time(now_, wall_)) << "it is published once";
}

TEST_F(Deployer, Nothing_happening_ends_it) {
  say(report("a", Phase::Prepared));
  now_ += 5 * kPlantSecond + kPlantOneNs;
  time();
  EXPECT_EQ(sut_.verdict(), Verdict::Refused);
  EXPECT_THAT(sut_.reasons(), ElementsAre(Key("b")));
}

TEST_F(Deployer, Bytes_that_come_are_something_happening) {
  BoardReport fetching = report("a", Phase::Fetching);
  for (int i = 0; i < 5; ++i) {
    fetching.bytes_done += 100;
    say(fetching);
    now_ += 4 * kPlantSecond;
    time();
  }
  EXPECT_EQ(sut_.verdict(), Verdict::Open);
}

TEST_F(Deployer, A_board_that_refuses_the_deployer_ends_it) {
  BoardReport other = report("b", Phase::Steady);
  other.refused = 8;
  say(other);
  EXPECT_EQ(sut_.verdict(), Verdict::Open) << "it refused another one";
  other.refused = 7;
  other.refusal = "not signed";
  say(other);
  EXPECT_EQ(sut_.verdict(), Verdict::Refused);
  EXPECT_THAT(sut_.reasons(), ElementsAre(Pair("b", "not signed")));
}

TEST_F(Deployer, The_user_may_give_up) {
  to_trial();
  sut_.give_up(now_);
  EXPECT_EQ(sut_.order().step, Step::Abort);
  EXPECT_EQ(sut_.verdict(), Verdict::Interrupted);
}

class ExchangingPlant : public Deployer {
 protected:
  static Order order_of(Way way) {
    Order order = make_order();
    order.way = way;
    return order;
  }
  BoardReport ready(const std::string& board, Way way, std::int64_t grid_ns) const {
    BoardReport out = report(board, Phase::Prepared);
    out.way = way;
    out.grid_ns = grid_ns;
    return out;
  }
};

TEST_F(ExchangingPlant, Exchanges_where_the_macro_periods_of_all_boards_begin) {
  PlantTransaction sut(order_of(Way::Exchange), 5 * kPlantSecond, now_);
  wall_ += std::chrono::nanoseconds(1);
  sut.receive(ready("a", Way::Exchange, 4'000'000), now_);
  sut.receive(ready("b", Way::Exchange, 6'000'000), now_);
  EXPECT_TRUE(sut.time(now_, wall_));
  EXPECT_EQ(sut.order().step, Step::Switch);
  EXPECT_EQ(sut.order().way, Way::Exchange);
  const std::int64_t earliest = rt::to_ns(wall_ + PlantTransaction::kSwitchAhead);
  EXPECT_EQ(sut.order().switch_at_ns % 12'000'000, 0);
  EXPECT_GE(sut.order().switch_at_ns, earliest);
  EXPECT_LT(sut.order().switch_at_ns, earliest + 12'000'000);
}

TEST_F(ExchangingPlant, A_board_that_cannot_restarts_all) {
  PlantTransaction sut(order_of(Way::Exchange), 5 * kPlantSecond, now_);
  sut.receive(ready("a", Way::Exchange, 4'000'000), now_);
  sut.receive(ready("b", Way::Restart, 0), now_);
  sut.time(now_, wall_);
  EXPECT_EQ(sut.order().step, Step::Switch);
  EXPECT_EQ(sut.order().way, Way::Restart);
}

TEST_F(ExchangingPlant, Macro_periods_without_a_common_multiple_below_a_second_are_not_waited_for) {
  PlantTransaction sut(order_of(Way::Exchange), 5 * kPlantSecond, now_);
  sut.receive(ready("a", Way::Exchange, 999'999'937), now_);
  sut.receive(ready("b", Way::Exchange, 999'999'929), now_);
  sut.time(now_, wall_);
  EXPECT_LE(sut.order().switch_at_ns, rt::to_ns(wall_ + PlantTransaction::kSwitchAhead + kPlantSecond));
}

TEST_F(ExchangingPlant, A_comparison_ends_before_anything_is_changed) {
  PlantTransaction sut(order_of(Way::Compare), 5 * kPlantSecond, now_);
  sut.receive(ready("a", Way::Exchange, 4'000'000), now_);
  sut.receive(ready("b", Way::Restart, 0), now_);
  sut.time(now_, wall_);
  EXPECT_EQ(sut.order().step, Step::Abort);
  sut.receive(report("a", Phase::Steady), now_);
  sut.receive(report("b", Phase::Steady), now_);
  sut.time(now_, wall_);
  EXPECT_TRUE(sut.finished());
  EXPECT_EQ(sut.verdict(), Verdict::Compared);
}

TEST_F(ExchangingPlant, A_board_that_misses_the_tick_takes_all_back_and_is_named) {
  PlantTransaction sut(order_of(Way::Exchange), 5 * kPlantSecond, now_);
  sut.receive(ready("a", Way::Exchange, 4'000'000), now_);
  sut.receive(ready("b", Way::Exchange, 4'000'000), now_);
  sut.time(now_, wall_);
  sut.receive(report("a", Phase::Trial), now_);
  BoardReport late = report("b", Phase::Failed);
  late.stage = Phase::Prepared;
  late.message = "it missed the tick of the exchange";
  sut.receive(late, now_);
  EXPECT_EQ(sut.order().step, Step::Abort);
  EXPECT_EQ(sut.verdict(), Verdict::RolledBack);
  EXPECT_THAT(sut.reasons(), ElementsAre(Pair("b", "it missed the tick of the exchange")));
}

}  // namespace
}  // namespace indurop::deploy
