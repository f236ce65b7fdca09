// SPDX-License-Identifier: Apache-2.0
// One board in a deployment: every way out of it.

#include "deploy/transaction/board_transaction.h"

#include <gmock/gmock.h>

namespace indurop::deploy {
namespace {

using Do = BoardTransaction::Do;
using testing::HasSubstr;

constexpr std::chrono::milliseconds kMs{1};
constexpr std::chrono::seconds kSecond{1};
constexpr std::chrono::nanoseconds kOneNs{1};

class Board : public testing::Test {
 protected:
  Order order(Step step, std::uint64_t deployer = 7) const {
    Order out;
    out.deployer = deployer;
    out.host = "desk";
    out.deployment = "d1";
    out.generation = 3;
    out.boards = {"a", "b"};
    out.step = step;
    out.health_ns = std::chrono::nanoseconds(kSecond).count();
    out.said_at_ns = rt::to_ns(wall_);
    out.switch_at_ns = rt::to_ns(wall_ + 300 * kMs);
    return out;
  }
  Do hear(Step step, std::uint64_t deployer = 7) { return sut_.receive(order(step, deployer), now_, wall_); }
  // Advances the time in steps, as an agent does.
  Do listen_for(std::chrono::nanoseconds time) {
    for (const rt::MonoTime end = now_ + time; now_ < end;) {
      now_ += 100 * kMs;
      if (const Do what = sut_.time(now_); what != Do::Nothing) {
        return what;
      }
    }
    return Do::Nothing;
  }
  void prepare() {
    ASSERT_EQ(hear(Step::Prepare), Do::Fetch);
    ASSERT_EQ(sut_.fetched(""), Do::Check);
    ASSERT_EQ(sut_.checked("", now_), Do::Nothing);
    ASSERT_EQ(sut_.phase(), Phase::Prepared);
  }
  void switch_over() {
    prepare();
    ASSERT_EQ(hear(Step::Switch), Do::Nothing);
    now_ += 300 * kMs;
    ASSERT_EQ(sut_.time(now_), Do::Switch);
    ASSERT_EQ(sut_.phase(), Phase::Trial);
  }
  void become_healthy() {
    switch_over();
    now_ += kSecond;
    ASSERT_EQ(sut_.node("", "", now_), Do::Nothing);
    ASSERT_EQ(sut_.phase(), Phase::Healthy);
  }

  BoardTransaction sut_{"a"};
  rt::MonoTime now_{100 * kSecond};
  rt::WallTime wall_{5'000 * kSecond};
};

TEST_F(Board, Commits_when_all_goes_well) {
  become_healthy();
  EXPECT_EQ(hear(Step::Commit), Do::Commit);
  EXPECT_EQ(sut_.phase(), Phase::Steady);
  EXPECT_EQ(hear(Step::Commit), Do::Nothing);
}

TEST_F(Board, Orders_for_others_are_not_heard) {
  Order other = order(Step::Prepare);
  other.boards = {"b"};
  EXPECT_EQ(sut_.receive(other, now_, wall_), Do::Nothing);
  EXPECT_EQ(sut_.phase(), Phase::Steady);
}

TEST_F(Board, The_first_deployer_wins) {
  prepare();
  EXPECT_EQ(hear(Step::Prepare, 8), Do::Nothing);
  EXPECT_EQ(hear(Step::Abort, 8), Do::Nothing);
  EXPECT_EQ(sut_.order().deployer, 7U);
  EXPECT_EQ(sut_.phase(), Phase::Prepared);
}

TEST_F(Board, Words_said_again_change_nothing) {
  become_healthy();
  EXPECT_EQ(hear(Step::Prepare), Do::Nothing);
  EXPECT_EQ(hear(Step::Switch), Do::Nothing);
  EXPECT_EQ(sut_.phase(), Phase::Healthy);
}

TEST_F(Board, A_failed_fetch_ends_in_failed_and_an_abort_ends_that) {
  ASSERT_EQ(hear(Step::Prepare), Do::Fetch);
  EXPECT_EQ(sut_.fetched("disk full"), Do::Forget);
  EXPECT_EQ(sut_.phase(), Phase::Failed);
  EXPECT_EQ(sut_.stage(), Phase::Fetching);
  EXPECT_EQ(hear(Step::Abort), Do::Nothing);
  EXPECT_EQ(sut_.phase(), Phase::Steady);
  EXPECT_EQ(sut_.message(), "disk full");
  EXPECT_EQ(hear(Step::Prepare), Do::Nothing) << "the same deployer's old words";
  EXPECT_EQ(hear(Step::Prepare, 9), Do::Fetch);
}

TEST_F(Board, A_failed_check_says_so) {
  ASSERT_EQ(hear(Step::Prepare), Do::Fetch);
  ASSERT_EQ(sut_.fetched(""), Do::Check);
  EXPECT_EQ(sut_.checked("wrong processor", now_), Do::Forget);
  EXPECT_EQ(sut_.stage(), Phase::Checking);
}

TEST_F(Board, A_node_that_dies_in_its_trial_goes_back_at_once) {
  switch_over();
  EXPECT_EQ(sut_.node("module x faulted", "", now_), Do::GoBack);
  EXPECT_EQ(sut_.phase(), Phase::Failed);
  EXPECT_EQ(hear(Step::Abort), Do::Nothing);
  EXPECT_EQ(sut_.message(), "module x faulted");
}

TEST_F(Board, A_node_that_is_not_well_by_the_end_of_its_window_goes_back) {
  switch_over();
  now_ += kSecond;
  EXPECT_EQ(sut_.node("", "still starting", now_), Do::Nothing);
  now_ += BoardTransaction::kSlowStart;
  EXPECT_EQ(sut_.node("", "still starting", now_), Do::GoBack);
  EXPECT_EQ(sut_.message(), "still starting");
}

TEST_F(Board, An_abort_in_the_trial_goes_back) {
  switch_over();
  EXPECT_EQ(hear(Step::Abort), Do::GoBack);
  EXPECT_EQ(sut_.phase(), Phase::Steady);
}

TEST_F(Board, A_silent_deployer_is_given_up_in_every_phase) {
  ASSERT_EQ(hear(Step::Prepare), Do::Fetch);
  EXPECT_EQ(listen_for(BoardTransaction::kSilence), Do::Nothing);
  EXPECT_EQ(sut_.time(now_ + kOneNs), Do::Forget);
  EXPECT_EQ(sut_.phase(), Phase::Steady);
}

TEST_F(Board, A_deployer_that_is_silent_in_the_trial_is_no_commit) {
  become_healthy();
  EXPECT_EQ(hear(Step::Switch), Do::Nothing);
  EXPECT_EQ(listen_for(BoardTransaction::kSilence), Do::Nothing);
  EXPECT_EQ(sut_.time(now_ + kOneNs), Do::GoBack);
  EXPECT_THAT(sut_.message(), HasSubstr("deployer"));
}

TEST_F(Board, What_this_board_slept_itself_is_no_silence_of_the_deployer) {
  prepare();
  now_ += 100 * BoardTransaction::kSilence;
  EXPECT_EQ(sut_.time(now_), Do::Nothing) << "words that came meanwhile are not read yet";
  EXPECT_EQ(hear(Step::Prepare), Do::Nothing);
  EXPECT_EQ(listen_for(BoardTransaction::kSilence), Do::Nothing);
  EXPECT_EQ(sut_.phase(), Phase::Prepared);
}

TEST_F(Board, Switches_at_the_instant_by_the_clock_if_clocks_agree) {
  prepare();
  wall_ += 20 * kMs;  // on the way
  Order late = order(Step::Switch);
  late.said_at_ns -= std::chrono::nanoseconds(20 * kMs).count();
  late.switch_at_ns -= std::chrono::nanoseconds(20 * kMs).count();
  ASSERT_EQ(sut_.receive(late, now_, wall_), Do::Nothing);
  EXPECT_EQ(sut_.time(now_ + 279 * kMs), Do::Nothing);
  EXPECT_EQ(sut_.time(now_ + 280 * kMs), Do::Switch);
}

TEST_F(Board, A_clock_an_hour_off_does_not_hold_up_the_switch) {
  prepare();
  ASSERT_EQ(sut_.receive(order(Step::Switch), now_, wall_ + 3600 * kSecond), Do::Nothing);
  EXPECT_THAT(sut_.message(), HasSubstr("+3600.0 s"));
  EXPECT_EQ(sut_.time(now_ + 299 * kMs), Do::Nothing);
  EXPECT_EQ(sut_.time(now_ + 300 * kMs), Do::Switch);
}

TEST_F(Board, Takes_over_what_it_missed_without_a_deployer) {
  BoardReport other;
  other.board = "b";
  other.agent = 42;
  other.current = "d9";
  other.generation = 9;
  other.members = {"a", "b"};
  EXPECT_EQ(sut_.catch_up(other, now_), Do::Fetch);
  EXPECT_EQ(sut_.source(), 42U);
  EXPECT_EQ(sut_.fetched(""), Do::Check);
  EXPECT_EQ(sut_.checked("", now_), Do::Nothing);
  EXPECT_EQ(sut_.time(now_), Do::Switch);
  EXPECT_EQ(sut_.node("", "board b is silent", now_ + BoardTransaction::kJoinHealth), Do::Commit);
  EXPECT_EQ(sut_.order().generation, 9U);
}

TEST_F(Board, What_cannot_be_taken_over_is_not_tried_without_end) {
  BoardReport other;
  other.agent = 42;
  other.generation = 9;
  ASSERT_EQ(sut_.catch_up(other, now_), Do::Fetch);
  EXPECT_EQ(sut_.fetched("disk full"), Do::Forget);
  EXPECT_EQ(sut_.phase(), Phase::Steady);
  EXPECT_EQ(sut_.catch_up(other, now_ + kSecond), Do::Nothing);
  EXPECT_EQ(sut_.catch_up(other, now_ + 60 * kSecond), Do::Fetch);
}

TEST_F(Board, A_deployer_comes_before_taking_over) {
  BoardReport other;
  other.agent = 42;
  other.generation = 9;
  ASSERT_EQ(sut_.catch_up(other, now_), Do::Fetch);
  EXPECT_EQ(hear(Step::Prepare), Do::Fetch);
  EXPECT_FALSE(sut_.joining());
  EXPECT_EQ(sut_.source(), 7U);
}

// The agent that switched ended, as a release of the platform does; this one continues.
class Successor : public Board {
 protected:
  void resume(const std::string& problem = {}, bool joining = false) {
    sut_.resume(order(Step::Prepare), joining, problem, now_);
  }
  BoardReport committed(std::uint64_t generation) const {
    BoardReport report;
    report.current = "d1";
    report.generation = generation;
    return report;
  }
};

TEST_F(Successor, Commits_what_its_predecessor_began) {
  resume();
  EXPECT_EQ(sut_.phase(), Phase::Trial);
  now_ += kSecond;
  EXPECT_EQ(sut_.node("", "", now_), Do::Nothing);
  EXPECT_EQ(sut_.phase(), Phase::Healthy);
  EXPECT_EQ(hear(Step::Commit), Do::Commit);
}

TEST_F(Successor, Waits_longer_until_it_has_heard_the_deployer_once) {
  resume();
  EXPECT_EQ(listen_for(BoardTransaction::kReturn), Do::Nothing);
  EXPECT_EQ(listen_for(kSecond), Do::GoBack);
}

TEST_F(Successor, Waits_as_usual_once_it_has_heard_the_deployer) {
  resume();
  EXPECT_EQ(hear(Step::Switch), Do::Nothing);
  EXPECT_EQ(listen_for(BoardTransaction::kSilence), Do::Nothing);
  EXPECT_EQ(listen_for(kSecond), Do::GoBack);
}

// Its health window may be longer than the time for which it waits for the deployer.
TEST_F(Successor, Commits_what_another_board_has_committed_also_if_its_trial_has_begun_again) {
  resume();
  EXPECT_EQ(sut_.committed_elsewhere(committed(3)), Do::Commit);
  EXPECT_EQ(sut_.phase(), Phase::Steady);
}

TEST_F(Successor, Of_a_board_that_joins_commits_once_it_is_healthy) {
  resume({}, true);
  EXPECT_EQ(sut_.committed_elsewhere(committed(3)), Do::Nothing);
  now_ += kSecond;
  EXPECT_EQ(sut_.node("", "", now_), Do::Commit);
}

TEST_F(Successor, Commits_what_another_board_has_committed_once_it_is_healthy) {
  resume();
  now_ += kSecond;
  EXPECT_EQ(sut_.node("", "", now_), Do::Nothing);
  EXPECT_EQ(sut_.committed_elsewhere(committed(2)), Do::Nothing) << "that was another time";
  EXPECT_EQ(sut_.committed_elsewhere(committed(3)), Do::Commit);
  EXPECT_EQ(sut_.phase(), Phase::Steady);
}

TEST_F(Successor, Reports_that_the_trial_failed_until_the_deployer_knows) {
  resume("it crashed");
  EXPECT_EQ(sut_.phase(), Phase::Failed);
  EXPECT_EQ(sut_.message(), "it crashed");
  EXPECT_EQ(hear(Step::Abort), Do::Nothing);
  EXPECT_EQ(sut_.phase(), Phase::Steady);
}

TEST_F(Successor, Of_a_board_that_joined_does_not_wait_for_a_deployer) {
  resume("it crashed", true);
  EXPECT_EQ(sut_.phase(), Phase::Steady);
  EXPECT_EQ(sut_.message(), "it crashed");
}

class ExchangingBoard : public Board {
 protected:
  Order with(Step step, Way way) const {
    Order out = order(step);
    out.way = way;
    return out;
  }
  Do hear_way(Step step, Way way) { return sut_.receive(with(step, way), now_, wall_); }
  void load(Way way = Way::Exchange) {
    ASSERT_EQ(hear_way(Step::Prepare, way), Do::Fetch);
    ASSERT_EQ(sut_.fetched(""), Do::Check);
    ASSERT_EQ(sut_.checked("", now_), Do::Load);
    ASSERT_EQ(sut_.phase(), Phase::Checking) << "nothing is prepared before it is loaded";
  }
  void get_ready() {
    load();
    ASSERT_EQ(sut_.loaded("", true, now_), Do::Nothing);
    ASSERT_EQ(sut_.phase(), Phase::Prepared);
    ASSERT_EQ(sut_.way(), Way::Exchange);
  }
  void enter() {
    get_ready();
    ASSERT_EQ(hear_way(Step::Switch, Way::Exchange), Do::Enter);
    ASSERT_EQ(sut_.switch_at(), now_ + 300 * kMs);
  }
};

TEST_F(ExchangingBoard, Enters_at_the_instant_and_commits) {
  enter();
  EXPECT_EQ(hear_way(Step::Switch, Way::Exchange), Do::Nothing) << "once";
  now_ += 400 * kMs;
  EXPECT_EQ(sut_.time(now_), Do::Nothing) << "the node says when";
  EXPECT_EQ(sut_.phase(), Phase::Prepared);
  EXPECT_EQ(sut_.exchanged("", now_), Do::Nothing);
  EXPECT_EQ(sut_.phase(), Phase::Trial);
  now_ += kSecond;
  EXPECT_EQ(sut_.node("", "", now_), Do::Nothing);
  EXPECT_EQ(hear_way(Step::Commit, Way::Exchange), Do::Commit);
  EXPECT_EQ(sut_.way(), Way::Exchange);
}

TEST_F(ExchangingBoard, A_missed_tick_fails_and_forgets) {
  enter();
  EXPECT_EQ(sut_.exchanged("it missed the tick", now_), Do::Forget);
  EXPECT_EQ(sut_.phase(), Phase::Failed);
  EXPECT_EQ(sut_.message(), "it missed the tick");
  EXPECT_EQ(sut_.exchanged("", now_), Do::Nothing) << "too late";
}

TEST_F(ExchangingBoard, An_abort_before_the_tick_forgets_and_one_after_it_goes_back) {
  enter();
  EXPECT_EQ(hear_way(Step::Abort, Way::Exchange), Do::Forget);
  ASSERT_EQ(sut_.receive(order(Step::Prepare, 9), now_, wall_), Do::Fetch);
  EXPECT_EQ(sut_.way(), Way::Restart) << "of another deployment";
}

TEST_F(ExchangingBoard, A_fault_of_a_new_version_goes_back) {
  enter();
  ASSERT_EQ(sut_.exchanged("", now_), Do::Nothing);
  EXPECT_EQ(sut_.node("module press: the new one faulted", "", now_), Do::GoBack);
  EXPECT_EQ(sut_.way(), Way::Exchange);
}

TEST_F(ExchangingBoard, What_cannot_be_loaded_is_a_failed_check) {
  load();
  EXPECT_EQ(sut_.loaded("start() failed", false, now_), Do::Forget);
  EXPECT_EQ(sut_.stage(), Phase::Checking);
}

TEST_F(ExchangingBoard, Restarts_if_the_deployer_says_so) {
  get_ready();
  EXPECT_EQ(hear_way(Step::Switch, Way::Restart), Do::Nothing);
  now_ += 300 * kMs;
  EXPECT_EQ(sut_.time(now_), Do::Switch);
  EXPECT_EQ(sut_.way(), Way::Restart);
}

TEST_F(ExchangingBoard, A_board_that_has_to_restart_does_not_exchange) {
  load();
  ASSERT_EQ(sut_.loaded("", false, now_), Do::Nothing);
  EXPECT_EQ(sut_.way(), Way::Restart);
  EXPECT_EQ(hear_way(Step::Switch, Way::Exchange), Do::Forget);
  EXPECT_EQ(sut_.phase(), Phase::Failed);
}

TEST_F(ExchangingBoard, Takes_over_what_it_missed_without_a_restart_if_it_can) {
  BoardReport other;
  other.board = "b";
  other.agent = 5;
  other.current = "d2";
  other.generation = 9;
  other.members = {"a", "b"};
  for (const bool exchanges : {true, false}) {
    BoardTransaction sut("a");
    ASSERT_EQ(sut.catch_up(other, now_, Way::Exchange), Do::Fetch);
    ASSERT_EQ(sut.fetched(""), Do::Check);
    ASSERT_EQ(sut.checked("", now_), Do::Load);
    EXPECT_EQ(sut.loaded("", exchanges, now_), exchanges ? Do::Enter : Do::Nothing);
    EXPECT_EQ(exchanges ? sut.exchanged("", now_) : sut.time(now_), exchanges ? Do::Nothing : Do::Switch);
    EXPECT_EQ(sut.phase(), Phase::Trial);
  }
}

}  // namespace
}  // namespace indurop::deploy
