// SPDX-License-Identifier: Apache-2.0
// Users command boards from afar with keys of their own: role and limits of the plant's list decide, whatever name a
// command claims, and the audit log of the board names who did what and who was refused.

#include <algorithm>
#include <fstream>

#include "agents_fixture.h"

namespace indurop::test {
namespace {

using testing::HasSubstr;

class RemoteUsers : public AgentsTest {
 protected:
  void SetUp() override {
    std::filesystem::copy_file(TWO_BOARDS "/table.so", folder() / "table.so");
    const std::string file = manifest("v1.xml", {{"a", "table"}, {"b", "steady"}});
    bring_keys(file, {"a", "b"});
    for (const char* name : {"anna", "ben", "carl"}) {
      ASSERT_EQ(indurop_here({"keys", "add", "--user", name, "--dir", path("keys")}).code, 0);
    }
    start_agent("a");
    start_agent("b");
    speak_with_keys(path("keys"));
    const Outcome done = deploy(file);
    ASSERT_EQ(done.code, 0) << done.err;
  }
  void list(const std::vector<std::vector<std::string>>& users) {
    std::filesystem::remove(path("users.xml"));
    for (std::vector<std::string> words : users) {
      words.insert(words.begin(), {"users", "add"});
      words.insert(words.end(), {"--no-password", "--file", path("users.xml")});
      ASSERT_EQ(indurop_here(words).code, 0);
    }
  }
  Outcome send(const std::string& keys) {
    return indurop({"users", "send", "--file", path("users.xml"), "--keys", keys});
  }
  // A command about board a with the keys of this user.
  Outcome as(const std::string& user, std::vector<std::string> words) {
    words.insert(words.end(), {"--board", board("a"), "--keys", path("keys/users/" + user)});
    return indurop(words);
  }
};

TEST_F(RemoteUsers, Do_what_their_role_allows) {
  const Outcome unknown = as("anna", {"set", "torque=1"});
  EXPECT_EQ(unknown.code, 1) << unknown.out;
  EXPECT_THAT(unknown.err, HasSubstr("anna is not in this board's list of users"));
  list({{"anna", "--role", "operate"},
        {"ben", "--role", "program", "--boards", board("b")},
        {"carl", "--role", "tune", "--variables", "cell::torque"}});
  const Outcome sent = send(path("keys"));
  ASSERT_EQ(sent.code, 0) << sent.err;

  EXPECT_EQ(as("anna", {"set", "torque=1", "--reason", "a trial"}).code, 0);
  const Outcome force = as("anna", {"force", "torque=1"});
  EXPECT_EQ(force.code, 1);
  EXPECT_THAT(force.err, HasSubstr("anna has the role operate, and this needs tune"));
  EXPECT_THAT(as("ben", {"set", "torque=1"}).err, HasSubstr("ben may change boards " + board("b") + " only"));
  EXPECT_EQ(as("carl", {"force", "torque=2", "--for", "60s"}).code, 0);
  EXPECT_THAT(as("carl", {"set", "echo=1"}).err, HasSubstr("carl may change cell::torque only, not cell::echo"));
  EXPECT_THAT(as("carl", {"unforce", "--all"}).err, HasSubstr("carl may change cell::torque only")) << "all is more";
  EXPECT_EQ(as("carl", {"unforce", "torque"}).code, 0);
  EXPECT_THAT(send(path("keys/users/anna")).err, HasSubstr("this needs administer")) << "no user raises himself";

  // Taken back: the next command is refused.
  list({{"ben", "--role", "program"}});
  ASSERT_EQ(send(path("keys")).code, 0);
  EXPECT_THAT(as("anna", {"set", "torque=1"}).err, HasSubstr("anna is not in this board's list of users"));
}

TEST_F(RemoteUsers, Are_named_in_the_audit_log_by_their_certificate) {
  list({{"anna", "--role", "operate"}});
  ASSERT_EQ(send(path("keys")).code, 0);
  ::setenv("LOGNAME", "the-boss", 1);
  ::setenv("USER", "the-boss", 1);
  ASSERT_EQ(as("anna", {"set", "torque=1", "--reason", "a trial"}).code, 0);
  EXPECT_EQ(as("anna", {"lock", "all"}).code, 1);
  ::unsetenv("LOGNAME");
  ::unsetenv("USER");
  const Json log = audit();
  ASSERT_GE(log.size(), 2U) << log;
  const Json& refused = log[log.size() - 1];
  const Json& done = log[log.size() - 2];
  EXPECT_EQ(done["who"], "anna");
  EXPECT_EQ(done["action"], "set");
  EXPECT_THAT(done["what"].get<std::string>(), HasSubstr("torque=1"));
  EXPECT_EQ(done["outcome"], "done");
  EXPECT_EQ(done["reason"], "a trial");
  EXPECT_EQ(refused["who"], "anna");
  EXPECT_EQ(refused["action"], "lock");
  EXPECT_THAT(refused["outcome"].get<std::string>(), HasSubstr("this needs program"));
}

TEST_F(RemoteUsers, Change_nothing_that_the_audit_log_cannot_take) {
  list({{"anna", "--role", "operate"}});
  ASSERT_EQ(send(path("keys")).code, 0);
  ASSERT_EQ(as("anna", {"set", "torque=1"}).code, 0);
  const std::filesystem::path log = path("state/serve/audit.jsonl");
  std::filesystem::remove(log);
  std::filesystem::create_symlink("/dev/full", log);
  for (const bool deployer : {false, true}) {
    const Outcome full =
        deployer ? indurop({"set", "torque=2", "--board", board("a")}) : as("anna", {"set", "torque=2"});
    EXPECT_EQ(full.code, 1) << full.out;
    EXPECT_THAT(full.err, HasSubstr("cannot be logged"));
    EXPECT_THAT(full.err, HasSubstr("No space left on device"));
  }
  EXPECT_EQ(indurop({"stop", "@" + board("a")}).code, 0) << "a full disk does not prevent a stop";
  EXPECT_EQ(indurop({"start", "@" + board("a")}).code, 1) << "a start needs the log";
  std::filesystem::remove(log);
  ASSERT_EQ(indurop({"start", "@" + board("a")}).code, 0);
  EXPECT_EQ(as("anna", {"set", "torque=3"}).code, 0);
  const Json after = audit();
  ASSERT_EQ(after.size(), 4U) << after;  // of the start and the write
  EXPECT_EQ(after[2]["outcome"], "begun");
  EXPECT_EQ(after[3]["outcome"], "done");
}

TEST_F(RemoteUsers, Lose_their_rights_also_on_a_board_that_was_off) {
  list({{"anna", "--role", "operate"}, {"ben", "--role", "administer"}});
  ASSERT_EQ(send(path("keys")).code, 0);
  ASSERT_EQ(as("anna", {"set", "torque=1"}).code, 0);
  stop_agent("a", SIGKILL);
  list({{"ben", "--role", "administer"}, {"carl", "--role", "administer"}});
  const Outcome sent = send(path("keys/users/ben"));
  EXPECT_EQ(sent.code, 6) << sent.out;
  EXPECT_THAT(sent.err, HasSubstr("takes this one from another board"));
  start_agent("a");
  ASSERT_TRUE(wait_until([&] {
    return as("anna", {"set", "torque=2"}).err.find("anna is not in this board's list") != std::string::npos;
  })) << "without another users send";
  const Json log = audit();
  const auto taken =
      std::find_if(log.begin(), log.end(), [](const Json& entry) { return entry["from"] == "another board"; });
  ASSERT_NE(taken, log.end()) << log;
  EXPECT_EQ((*taken)["who"], "ben");
  EXPECT_EQ((*taken)["action"], "set users");

  // Carl became an administrator while the board was off: it knows that from the list, so his own list counts.
  list({{"anna", "--role", "operate"}, {"carl", "--role", "administer"}});
  EXPECT_EQ(send(path("keys/users/carl")).code, 0);
  EXPECT_TRUE(wait_until([&] { return as("anna", {"set", "torque=3"}).code == 0; }));
}

TEST_F(RemoteUsers, Are_not_made_by_one_whom_the_board_does_not_know_as_administrator) {
  list({{"anna", "--role", "operate"}});
  ASSERT_EQ(send(path("keys")).code, 0);
  stop_agent("a", SIGKILL);
  list({{"ben", "--role", "administer"}});
  ASSERT_EQ(send(path("keys")).code, 6);
  list({{"ben", "--role", "administer"}, {"carl", "--role", "operate"}});
  ASSERT_EQ(send(path("keys/users/ben")).code, 6);
  start_agent("a");
  // Its own list, of a deployer, does not know ben, and the one between them is gone.
  ASSERT_TRUE(agent("a").says("was not taken: ben is not in"));
  EXPECT_THAT(as("carl", {"set", "torque=1"}).err, HasSubstr("carl is not in this board's list"));
  EXPECT_EQ(as("anna", {"set", "torque=1"}).code, 0) << "its own list is still valid";
  ASSERT_EQ(send(path("keys")).code, 0);
  EXPECT_EQ(as("carl", {"set", "torque=1"}).code, 0);
}

TEST_F(RemoteUsers, Keep_their_rights_when_the_agent_starts_again_and_lose_them_with_their_keys) {
  list({{"anna", "--role", "operate"}});
  ASSERT_EQ(send(path("keys")).code, 0);
  stop_agent("a", SIGKILL);
  start_agent("a");
  ASSERT_TRUE(wait_until([&] { return as("anna", {"set", "torque=1"}).code == 0; }));
  ASSERT_EQ(indurop_here({"keys", "revoke", "anna", "--dir", path("keys")}).code, 0);
  const auto plant = folder() / "etc" / ("p" + std::to_string(::getpid()));
  std::filesystem::copy_file(path("keys/revoked.pem"), plant / board("a") / "revoked.pem",
                             std::filesystem::copy_options::overwrite_existing);
  EXPECT_TRUE(wait_until([&] { return as("anna", {"set", "torque=1"}).code != 0; }));
  ASSERT_TRUE(wait_until([&] {
    return indurop({"set", "torque=2", "--board", board("a")}).code == 0;
  })) << "a deployer still may";
  EXPECT_NE(as("anna", {"set", "torque=1"}).code, 0);
}

}  // namespace
}  // namespace indurop::test
