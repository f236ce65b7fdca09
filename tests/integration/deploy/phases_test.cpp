// SPDX-License-Identifier: Apache-2.0
// Boards and deployers killed in each phase of a deployment: in the end all boards run the same, and it is either what
// was committed or, once one board has committed the next, that. (The trial: faults_test.cpp.)

#include "core/rt/clock.h"
#include "deploy/link/command_link.h"
#include "deploy/link/deploy_link.h"
#include "deploy/transaction/write_words.h"
#include "phases_fixture.h"

namespace indurop::test {
namespace {

using testing::AnyOf;
using testing::HasSubstr;

TEST_F(Phases, A_board_killed_while_it_fetches_resumes_and_fetches_on) {
  Program& deployer = deploy_until_fetching();
  lose("a");
  deployer.signal(SIGCONT);
  const Outcome outcome = deployer.finish();
  EXPECT_EQ(outcome.code, 1) << outcome.err;
  EXPECT_THAT(outcome.err, HasSubstr(board("a") + ": it no longer reports"));
  const std::uintmax_t there = fetched();
  EXPECT_GT(there, 0U) << "what came is kept";
  start_agent("a");
  EXPECT_TRUE(both_run_the_committed());
  EXPECT_GE(fetched(), there);
  const Outcome again = deploy(next_);
  ASSERT_EQ(again.code, 0) << again.err;
  EXPECT_TRUE(both_run(again.json()["deployment"]));
}

TEST_F(Phases, A_deployer_killed_while_boards_fetch_changes_nothing) {
  Program& deployer = deploy_until_fetching();
  deployer.signal(SIGKILL);
  (void)deployer.finish();
  EXPECT_TRUE(both_run_the_committed());
  EXPECT_THAT(report("a")["message"].get<std::string>(), HasSubstr("deployer"));
  EXPECT_EQ(deploy(next_).code, 0) << "the next one finds the boards free";
}

TEST_F(Phases, A_board_killed_while_it_checks_resumes) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "the library that holds files cannot be loaded before that of the sanitizer";
#endif
  b_check_.hold();
  Program& deployer = deploy_until_checking();
  lose("b");
  const Outcome outcome = deployer.finish();
  EXPECT_EQ(outcome.code, 1) << outcome.err;
  EXPECT_THAT(outcome.err, HasSubstr(board("b") + ": it no longer reports"));
  b_check_.release();
  start_agent("b");
  EXPECT_TRUE(both_run_the_committed());
}

TEST_F(Phases, A_board_killed_while_it_is_prepared_resumes) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "the library that holds files cannot be loaded before that of the sanitizer";
#endif
  b_check_.hold();
  Program& deployer = deploy_until_checking();
  lose("a");
  b_check_.release();
  const Outcome outcome = deployer.finish();
  EXPECT_THAT(outcome.code, AnyOf(1, 5)) << "b may have begun its trial when a is missed: " << outcome.err;
  EXPECT_THAT(outcome.err, HasSubstr(board("a") + ": it no longer reports"));
  start_agent("a");
  EXPECT_TRUE(both_run_the_committed());
}

TEST_F(Phases, A_deployer_killed_while_one_board_checks_and_the_other_is_prepared_changes_nothing) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "the library that holds files cannot be loaded before that of the sanitizer";
#endif
  b_check_.hold();
  Program& deployer = deploy_until_checking();
  deployer.signal(SIGKILL);
  (void)deployer.finish();
  EXPECT_TRUE(wait_until([&] { return runs("a", committed_); })) << "it does not wait for b";
  b_check_.release();
  EXPECT_TRUE(both_run_the_committed());
  EXPECT_EQ(deploy(next_).code, 0) << "the next one finds the boards free";
}

// Another participant in the network of agents: boards that it has lost, the others have lost, too.
class Witness {
 public:
  explicit Witness(int domain) {
    deploy::LinkSettings settings;
    settings.network.domain = domain;
    settings.network.one_host = true;
    settings.self = deploy::new_session();
    auto opened = deploy::DeployLink::open(settings);
    EXPECT_TRUE(opened);
    link_ = std::move(opened->link);
  }
  bool loses_a_deployer() {
    const auto news = link_->take_orders();
    return std::any_of(news.begin(), news.end(), [](const auto& one) { return one.gone; });
  }
  bool loses(const std::string& board) {
    const auto news = link_->take_boards();
    return std::any_of(news.begin(), news.end(),
                       [&](const auto& one) { return one.gone && one.report.board == board; });
  }

 private:
  std::unique_ptr<deploy::DeployLink> link_;
};

TEST_F(Phases, A_deployer_that_stands_still_until_the_network_loses_it_goes_on) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "the library that holds files cannot be loaded before that of the sanitizer";
#endif
  b_check_.hold();
  Witness witness(link_domain());
  Program& deployer = deploy_until_checking();
  (void)witness.loses_a_deployer();
  deployer.signal(SIGSTOP);
  EXPECT_TRUE(wait_until([&] { return witness.loses_a_deployer(); }));
  deployer.signal(SIGCONT);
  b_check_.release();
  const Outcome outcome = deployer.finish();
  EXPECT_EQ(outcome.code, 0) << outcome.err << agent("a").err() << agent("b").err();
  EXPECT_NE(new_one(), "");
}

TEST_F(Phases, A_board_that_stands_still_until_the_network_loses_it_goes_on) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "the library that holds files cannot be loaded before that of the sanitizer";
#endif
  b_check_.hold();
  Witness witness(link_domain());
  Program& deployer = deploy_until_checking();
  (void)witness.loses(board("a"));
  agent("a").signal(SIGSTOP);
  EXPECT_TRUE(wait_until([&] { return witness.loses(board("a")); }));
  agent("a").signal(SIGCONT);
  b_check_.release();
  const Outcome outcome = deployer.finish();
  EXPECT_EQ(outcome.code, 0) << outcome.err << agent("a").err() << agent("b").err();
  EXPECT_NE(new_one(), "");
}

// Sends one command to a board and returns its answer, the text of it.
std::string answer_to(deploy::Command command, const std::string& board, int domain) {
  deploy::LinkSettings settings;
  settings.network.domain = domain;
  settings.network.one_host = true;
  settings.self = command.commander = deploy::new_session();
  const auto opened = deploy::DeployLink::open(settings);
  const auto commands = opened ? deploy::CommandLink::open(*opened->link, deploy::CommandSide::Commander)
                               : base::Problem{"there is no link"};
  EXPECT_TRUE(commands);
  std::optional<std::string> answer;
  EXPECT_TRUE(wait_until([&] {
    for (const auto& news : opened->link->take_boards()) {
      if (news.report.board == board) {
        command.board = board;
        command.agent = news.report.agent;
        command.plant = news.report.plant;
      }
    }
    (*commands)->send(command);
    opened->link->wait(rt::MonoClock::now() + 100ms);
    for (const deploy::CommandReply& reply : (*commands)->take_replies()) {
      if (reply.commander == command.commander && reply.outcome == deploy::Outcome::Nonce) {
        command.nonce = reply.nonce;
      } else if (reply.commander == command.commander) {
        answer = reply.text;
      }
    }
    return answer.has_value();
  }));
  return answer.value_or("");
}

TEST_F(Phases, A_lease_is_renewed_while_a_deployment_is_under_way) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "the library that holds files cannot be loaded before that of the sanitizer";
#endif
  b_check_.hold();
  Program& deployer = deploy_until_checking();
  deploy::Command command;
  command.action = deploy::Action::Force;
  deploy::WriteOrder force;
  force.lines = {"x=1"};
  command.target = text_of(force);
  EXPECT_EQ(answer_to(command, board("a"), link_domain()), "a deployment is under way");
  deploy::WriteOrder renewal;
  renewal.for_ns = 1;
  renewal.renew = true;
  command.target = text_of(renewal);
  EXPECT_EQ(answer_to(command, board("a"), link_domain()), "this lease no longer exists") << "it was looked up";
  b_check_.release();
  EXPECT_EQ(deployer.finish().code, 0);
}

TEST_F(Phases, A_board_killed_while_it_is_healthy_takes_all_back) {
  Program& deployer = deploy_until_healthy();
  lose("a");
  const Outcome outcome = deployer.finish();
  EXPECT_EQ(outcome.code, 5) << outcome.err;
  start_agent("a");
  let_b_start();
  EXPECT_TRUE(both_run_the_committed());
}

TEST_F(Phases, A_deployer_killed_before_all_are_healthy_is_no_commit) {
  Program& deployer = deploy_until_healthy();
  deployer.signal(SIGKILL);
  (void)deployer.finish();
  let_b_start();
  EXPECT_TRUE(both_run_the_committed());
}

TEST_F(Phases, A_board_killed_at_the_commit_ends_with_what_the_others_run) {
  Program& deployer = deploy_until_committed();
  lose("b");
  const Outcome outcome = deployer.finish();
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  start_agent("b");
  EXPECT_EQ(outcome.json()["deployment"], new_one());
}

TEST_F(Phases, A_deployer_killed_at_the_commit_leaves_all_boards_with_the_same) {
  Program& deployer = deploy_until_committed();
  deployer.signal(SIGKILL);
  (void)deployer.finish();
  EXPECT_NE(new_one(), "");
  const Json past = indurop({"history", "-o", "json"}).json();
  EXPECT_EQ(past["deployments"].back()["current"], true);
}

}  // namespace
}  // namespace indurop::test
