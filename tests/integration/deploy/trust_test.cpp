// SPDX-License-Identifier: Apache-2.0
// Keys that are replaced or revoked while a plant runs, without a file that is copied to a board: by `indurop keys
// send`, and from board to board.

#include "agents_fixture.h"

namespace indurop::test {
namespace {

using testing::HasSubstr;

class Trust : public AgentsTest {
 protected:
  void SetUp() override {
    first_ = manifest("v1.xml", {{"a", "steady"}, {"b", "steady"}});
    second_ = manifest("v2.xml", {{"a", "other"}, {"b", "steady"}});
    bring_keys(first_, {"a", "b"});
    ASSERT_EQ(keys({"add", "--user", "anna"}).code, 0);
    start_agent("a");
    start_agent("b");
    // The keys of a deployer as one had them who does not follow what happens later.
    std::filesystem::copy(path("keys/deployer"), path("stolen"), std::filesystem::copy_options::recursive);
    speak_with_keys(path("keys"));
    const Outcome done = deploy(first_);
    ASSERT_EQ(done.code, 0) << done.err;
  }
  Outcome keys(std::vector<std::string> words) {
    words.insert(words.begin(), "keys");
    words.insert(words.end(), {"--dir", path("keys")});
    return indurop_here(words);
  }
  Outcome send() { return indurop({"keys", "send", "--dir", path("keys"), "--keys", path("keys")}); }
  Outcome deploy_with(const std::string& keys, const std::string& file, const std::string& patience = "10s") {
    return indurop({"deploy", file, "--health", "500ms", "--timeout", patience, "--keys", keys, "-o", "json"});
  }
  // A board has taken a list from another one.
  bool is_passed_on() {
    const Json log = audit();
    return std::any_of(log.begin(), log.end(), [](const Json& entry) {
      return entry["action"] == "set valid keys" && entry["from"] == "another board";
    });
  }
  const std::string& first() const { return first_; }
  const std::string& second() const { return second_; }

 private:
  std::string first_;
  std::string second_;
};

TEST_F(Trust, A_deployer_is_replaced_over_the_network) {
  ASSERT_EQ(keys({"add", "--deployer", "bob"}).code, 0);
  ASSERT_EQ(keys({"revoke", "deployer"}).code, 0);
  EXPECT_NE(deploy_with(path("keys/deployers/bob"), second(), "2s").code, 0) << "the boards do not know bob yet";
  const Outcome sent = send();
  ASSERT_EQ(sent.code, 0) << sent.err;
  for (const char* name : {"a", "b"}) {
    EXPECT_THAT(sent.out, HasSubstr(board(name) + " knows now which keys are valid"));
  }
  ASSERT_TRUE(wait_until([&] { return deploy_with(path("keys/deployers/bob"), second()).code == 0; }))
      << "agents join the network again after they got the list";
  EXPECT_NE(deploy_with(path("stolen"), first(), "2s").code, 0);
  EXPECT_NE(indurop({"stop", "@" + board("a"), "--keys", path("stolen")}).code, 0);
  const Outcome again = send();
  EXPECT_EQ(again.code, 0) << again.err;
  EXPECT_THAT(again.out, HasSubstr("knew already which keys are valid"));
  const Json log = audit();
  EXPECT_TRUE(std::any_of(log.begin(), log.end(), [](const Json& entry) {
    return entry["action"] == "set valid keys" && entry["outcome"] == "done";
  })) << log;
}

// Its deployer is revoked during the trial: he still decides it, so that no board keeps what another one rolls back.
TEST_F(Trust, A_deployment_on_trial_ends_alike_on_all_boards) {
  ASSERT_EQ(keys({"add", "--deployer", "bob"}).code, 0);
  Program& running =
      start_indurop({"deploy", second(), "--health", "8s", "--timeout", "20s", "--keys", path("stolen"), "-o", "json"});
  const auto on_trial = [&](const char* name) {
    const Json one = report(name);
    return one.is_object() && (one["phase"] == "trial" || one["phase"] == "healthy");
  };
  ASSERT_TRUE(wait_until([&] { return on_trial("a") && on_trial("b"); }));
  ASSERT_EQ(keys({"revoke", "deployer"}).code, 0);
  EXPECT_EQ(send().code, 0);
  const Outcome done = running.finish();
  ASSERT_EQ(done.code, 0) << done.err;
  const std::string deployment = done.json()["deployment"];
  EXPECT_TRUE(wait_until([&] { return runs("a", deployment) && runs("b", deployment); }));
  EXPECT_NE(deploy_with(path("stolen"), first(), "2s").code, 0) << "it was his last one";
  EXPECT_EQ(deploy_with(path("keys/deployers/bob"), first()).code, 0);
}

// What it missed is a deployment of a user who is no deployer any longer.
TEST_F(Trust, A_board_that_was_off_asks_for_valid_keys_before_it_takes_a_deployment) {
  ASSERT_EQ(keys({"add", "--deployer", "bob"}).code, 0);
  ASSERT_EQ(send().code, 0);
  const std::string before = report("b")["deployment"];
  stop_agent("b", SIGKILL);
  ASSERT_TRUE(wait_until([&] {
    return indurop({"deploy", second(), "--health", "500ms", "--timeout", "10s", "--allow-missing", "--keys",
                    path("stolen"), "-o", "json"})
               .code == 0;
  }));
  ASSERT_EQ(keys({"revoke", "deployer"}).code, 0);
  EXPECT_EQ(send().code, 6);
  start_agent("b");
  ASSERT_TRUE(wait_until([&] { return is_passed_on(); }));
  // Without the list, it would have begun by now.
  ASSERT_TRUE(wait_until([&] { return report("b").is_object(); }));
  const Json one = report("b");
  EXPECT_EQ(one["phase"], "steady") << one;
  EXPECT_EQ(one["deployment"], before) << one;
}

TEST_F(Trust, A_board_that_was_off_learns_from_another_one_who_is_revoked) {
  stop_agent("b", SIGKILL);
  ASSERT_EQ(keys({"add", "--deployer", "bob"}).code, 0);
  ASSERT_EQ(keys({"revoke", "deployer"}).code, 0);
  const Outcome sent = send();
  EXPECT_EQ(sent.code, 6) << sent.out;
  EXPECT_THAT(sent.err, HasSubstr(board("b") + " was not heard"));
  start_agent("b");
  ASSERT_TRUE(wait_until([&] { return is_passed_on(); })) << "without another keys send";
  ASSERT_TRUE(wait_until([&] { return deploy_with(path("keys/deployers/bob"), second()).code == 0; }));
  stop_agent("a", SIGKILL);
  EXPECT_NE(deploy_with(path("stolen"), first(), "2s").code, 0);
  EXPECT_NE(indurop({"stop", "@" + board("b"), "--keys", path("stolen")}).code, 0);
  // What was received outlives the agent.
  stop_agent("b", SIGKILL);
  start_agent("b");
  ASSERT_TRUE(wait_until([&] { return report("b").is_object(); }));
  EXPECT_NE(indurop({"stop", "@" + board("b"), "--keys", path("stolen")}).code, 0);
}

TEST_F(Trust, A_revoked_user_and_a_revoked_viewer_are_refused) {
  ASSERT_EQ(
      indurop_here({"users", "add", "anna", "--role", "program", "--no-password", "--file", path("users.xml")}).code,
      0);
  ASSERT_EQ(indurop({"users", "send", "--file", path("users.xml"), "--keys", path("keys")}).code, 0);
  ASSERT_EQ(keys({"add", "--viewer", "eve"}).code, 0);
  const auto as = [&](const std::string& whose, const std::vector<std::string>& words) {
    std::vector<std::string> all = words;
    all.insert(all.end(), {"--keys", path(whose)});
    return indurop(all);
  };
  EXPECT_EQ(as("keys/users/anna", {"restart", "@" + board("a")}).code, 0);
  EXPECT_THAT(as("keys/viewers/eve", {"boards"}).out, HasSubstr(board("a")));
  // They keep what they have.
  std::filesystem::copy(path("keys/users/anna"), path("anna"), std::filesystem::copy_options::recursive);
  std::filesystem::copy(path("keys/viewers/eve"), path("eve"), std::filesystem::copy_options::recursive);
  ASSERT_EQ(keys({"revoke", "anna", "eve"}).code, 0);
  ASSERT_EQ(send().code, 0);
  EXPECT_TRUE(wait_until([&] { return as("anna", {"restart", "@" + board("a")}).code != 0; }));
  EXPECT_TRUE(wait_until([&] { return as("eve", {"boards"}).out.find(board("a")) == std::string::npos; }))
      << "agents that have joined the network again do not speak with her";
  EXPECT_TRUE(wait_until([&] { return report("a").is_object(); })) << "the others are still heard";
}

}  // namespace
}  // namespace indurop::test
