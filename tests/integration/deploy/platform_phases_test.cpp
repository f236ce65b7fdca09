// SPDX-License-Identifier: Apache-2.0
// Agents, nodes and desks killed in each phase of an update of the platform: in the end all boards run the same
// release, the old one or the new one, and no user has to help.

#include <random>

#include "deploy/disk/last_switch.h"
#include "held_check.h"
#include "platform_fixture.h"

namespace indurop::test {
namespace {

using testing::AnyOf;
using testing::HasSubstr;

class PlatformPhases : public PlatformTest {
 protected:
  // Updates until board a has some pieces of the release, and stops the desk there.
  Program& update_until_fetching() {
    const std::string prefix = installation("large");
    std::ofstream(prefix + "/bin/indurop-node", std::ios::app) << std::string(60U << 20U, 'x');
    Program& desk = start_update(packed("9.1", prefix));
    EXPECT_TRUE(wait_until([&] { return has_pieces(); }));
    desk.signal(SIGSTOP);
    return desk;
  }
  [[nodiscard]] bool has_pieces() const {
    std::error_code error;
    const std::filesystem::directory_iterator parts(platform_folder("a") / "parts", error);
    return !error && parts != std::filesystem::directory_iterator();
  }
  Program& update_until(const std::string& phase, const std::string& health) {
    Program& desk = start_update(packed("9.1"), {"--health", health});
    EXPECT_TRUE(in_phase("a", phase)) << agent("a").err();
    return desk;
  }
  void kill_desk(Program& desk) {
    desk.signal(SIGKILL);
    (void)desk.finish();
  }
  // When board b opens a file of a deployment, which it does in its check.
  HeldCheck b_check_{"/" + board("b") + "/platform/deployments/", path("hold")};
};

TEST_F(PlatformPhases, A_board_killed_while_it_fetches) {
  Program& desk = update_until_fetching();
  restart("a");
  desk.signal(SIGCONT);
  EXPECT_EQ(desk.finish().code, 1);
  EXPECT_EQ(common_release(), kInstalled);
}

TEST_F(PlatformPhases, A_desk_killed_while_boards_fetch) {
  kill_desk(update_until_fetching());
  EXPECT_EQ(common_release(), kInstalled);
  EXPECT_EQ(update(path("9.1.release")).code, 0) << "the next one finds the boards free";
}

TEST_F(PlatformPhases, A_board_killed_while_it_checks_and_one_that_is_prepared) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "the library that holds files cannot be loaded before that of the sanitizer";
#endif
  b_check_.hold();
  Program& desk = update_until("prepared", "500ms");
  stop_agent("b", SIGKILL);
  b_check_.release();
  start_agent("b");
  EXPECT_EQ(desk.finish().code, 1);
  EXPECT_EQ(common_release(), kInstalled);

  b_check_.hold();
  Program& again = start_update(path("9.1.release"));
  ASSERT_TRUE(in_phase("a", "prepared"));
  restart("a", true);
  b_check_.release();
  // The desk learns of it before b is ready, or after its command to switch.
  const Outcome said = again.finish();
  EXPECT_THAT(said.code, AnyOf(1, 5)) << said.out << said.err;
  EXPECT_EQ(common_release(), kInstalled);
}

TEST_F(PlatformPhases, A_desk_killed_while_boards_check) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "the library that holds files cannot be loaded before that of the sanitizer";
#endif
  b_check_.hold();
  kill_desk(update_until("prepared", "500ms"));
  b_check_.release();
  EXPECT_EQ(common_release(), kInstalled);
}

// The agent that comes back finds in the board's folder that the trial goes on.
TEST_F(PlatformPhases, An_agent_killed_in_the_trial_goes_on) {
  Program& desk = update_until("trial", "10s");
  restart("a");
  EXPECT_EQ(desk.finish().code, 0);
  EXPECT_EQ(common_release(), "9.1");
}

TEST_F(PlatformPhases, A_board_that_loses_its_power_in_the_trial_goes_on) {
  Program& desk = update_until("trial", "10s");
  restart("a", true);
  EXPECT_EQ(desk.finish().code, 0);
  EXPECT_EQ(common_release(), "9.1");
}

TEST_F(PlatformPhases, A_node_killed_in_the_trial_takes_all_back) {
  Program& desk = update_until("trial", "15s");
  ASSERT_TRUE(wait_until([&] {
    const Json b = platform()[board("b")];
    return b.is_object() && b["phase"] == "trial" && b["state"] == "running";
  }));
  kill_node(board("b"));
  EXPECT_EQ(desk.finish().code, 5);
  EXPECT_EQ(common_release(), kInstalled);
}

TEST_F(PlatformPhases, A_board_that_stays_away_in_the_trial_takes_all_back) {
  Program& desk = update_until("trial", "60s");
  stop_agent("b", SIGKILL);
  kill_node(board("b"));
  EXPECT_EQ(desk.wait(kLong + kLong), 5);
  start_agent("b");
  EXPECT_EQ(common_release(), kInstalled);
}

// A board without a battery for its clock starts in 1970. The kernel would end each of its three starts only after the
// longest time of a trial.
TEST_F(PlatformPhases, A_board_whose_clock_is_set_back_in_the_trial_takes_all_back) {
  Program& desk = update_until("trial", "60s");
  stop_agent("b", SIGKILL);
  kill_node(board("b"));
  auto last = deploy::load_switch(platform_folder("b"));
  ASSERT_TRUE(last.has_value());
  last->begun_ns += std::chrono::nanoseconds(std::chrono::hours(1)).count();
  ASSERT_TRUE(deploy::save_switch(platform_folder("b"), *last).ok());
  start_agent("b");
  EXPECT_EQ(desk.wait(kLong), 5);
  EXPECT_EQ(common_release(), kInstalled);
  EXPECT_THAT(agent("b").err(), HasSubstr("the clock was set back"));
}

TEST_F(PlatformPhases, A_desk_killed_in_the_trial) {
  kill_desk(update_until("trial", "60s"));
  EXPECT_EQ(common_release(), kInstalled);
}

// One board has committed and the other cannot have heard of it.
TEST_F(PlatformPhases, A_desk_killed_at_the_commit) {
  Program& desk = start_update(packed("9.1"));
  const auto committed = platform_folder("a") / "committed.json";
  ASSERT_TRUE(wait_until([&] { return std::filesystem::exists(committed); }));
  desk.signal(SIGKILL);
  stop_agent("b", SIGKILL);
  (void)desk.finish();
  start_agent("b");
  EXPECT_EQ(common_release(), "9.1");
}

// Board b lost its power just before its commit, for longer than a trial may last.
TEST_F(PlatformPhases, A_long_loss_of_power_at_the_commit) {
  ASSERT_EQ(update(packed("9.1")).code, 0);
  stop_agent("b", SIGKILL);
  kill_node(board("b"));
  std::filesystem::remove(platform_folder("b") / "committed.json");
  auto last = deploy::load_switch(platform_folder("b"));
  ASSERT_TRUE(last.has_value());
  last->begun_ns -= std::chrono::nanoseconds(std::chrono::hours(1)).count();
  ASSERT_TRUE(deploy::save_switch(platform_folder("b"), *last).ok());
  start_agent("b");
  EXPECT_TRUE(both_run("9.1")) << agent("b").err();
}

// Whatever is killed, at whatever moment.
TEST_F(PlatformPhases, At_any_moment) {
  const std::string file = packed("9.1");
  std::mt19937 random(static_cast<unsigned>(::getpid()));
  for (int round = 0; round < 4; ++round) {
    Program& desk = start_update(file, {"--older"});
    const auto moment = std::chrono::milliseconds(random() % 4000);
    const auto victim = random() % 3;
    SCOPED_TRACE(testing::Message() << "round " << round << ": " << victim << " after " << moment.count() << " ms");
    (void)wait_until([] { return false; }, moment);
    if (victim == 2) {
      desk.signal(SIGKILL);
    } else {
      restart(victim == 0 ? "a" : "b", random() % 2 == 0);
    }
    (void)desk.finish();
    const std::string common = common_release();
    EXPECT_THAT(common, AnyOf(kInstalled, "9.1"));
    if (common == "9.1") {
      const Outcome back = indurop({"platform", "back", "--health", "500ms"});
      ASSERT_EQ(back.code, 0) << back.err;
    }
  }
}

}  // namespace
}  // namespace indurop::test
