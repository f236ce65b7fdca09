// SPDX-License-Identifier: Apache-2.0
// Commands to boards from elsewhere, and boards that a deployment leaves out.

#include <cstdlib>

#include "agents_fixture.h"

namespace indurop::test {
namespace {

using testing::HasSubstr;

class Commands : public AgentsTest {
 protected:
  std::string deployed(const std::string& file) {
    const Outcome done = deploy(file);
    EXPECT_EQ(done.code, 0) << done.err;
    return done.code == 0 ? done.json()["deployment"].get<std::string>() : "";
  }
  void start_plant() {
    start_agent("a");
    start_agent("b");
    id_ = deployed(manifest("v1.xml", {{"a", "steady"}, {"b", "steady"}}));
    ASSERT_TRUE(wait_until([&] { return runs("a", id_) && runs("b", id_); }));
  }
  std::string module_state(const std::string& name) {
    const Json all = indurop_here({"status", "--node", board(name), "-o", "json"}).json();
    return all.is_object() && !all["modules"].empty() ? all["modules"][0]["state"].get<std::string>() : "none";
  }
  std::string id_;
};

TEST_F(Commands, Stop_and_start_a_module_of_one_board_only) {
  start_plant();
  const Outcome stopped = indurop({"stop", "steady@" + board("a")});
  ASSERT_EQ(stopped.code, 0) << stopped.err;
  EXPECT_THAT(stopped.err, HasSubstr("steady@" + board("a") + " stopped after"));
  EXPECT_EQ(module_state("a"), "stopped");
  EXPECT_EQ(module_state("b"), "running");
  EXPECT_THAT(indurop({"stop", "steady@" + board("a")}).err, HasSubstr("is stopped already"));
  EXPECT_EQ(indurop({"start", "steady@" + board("a")}).code, 0);
  EXPECT_EQ(module_state("a"), "running");
  EXPECT_EQ(indurop({"restart", "steady@" + board("a"), "steady@" + board("b")}).code, 0);
  EXPECT_EQ(module_state("b"), "running");
}

// These modules do not declare what they keep, so that each exchange needs consent.
TEST_F(Commands, A_module_of_one_board_is_exchanged_with_a_file_from_here) {
  start_plant();
  const auto reload = [&](const std::string& file, const std::vector<std::string>& more) {
    std::vector<std::string> words = {"reload", "steady", std::string(MODULE_FOLDER) + "/" + file, "--board",
                                      board("a")};
    words.insert(words.end(), more.begin(), more.end());
    return indurop(words);
  };
  const auto version = [&](const std::string& name) {
    return indurop_here({"status", "--node", board(name), "-o", "json"}).json()["modules"][0]["version"].get<int>();
  };
  EXPECT_EQ(reload("other.so", {}).code, 4) << "values would be lost";
  EXPECT_EQ(reload("absent.so", {}).code, 1);
  EXPECT_EQ(reload("other.so", {"--lossy", "--dry-run"}).code, 0);
  EXPECT_EQ(version("a"), 1);
  const Outcome done = reload("other.so", {"--lossy", "--health", "300ms"});
  EXPECT_EQ(done.code, 0) << done.out << done.err;
  EXPECT_THAT(done.out, HasSubstr("version 2 runs since tick"));
  EXPECT_EQ(version("a"), 2);
  EXPECT_EQ(version("b"), 1);
  const Outcome faulty = reload("faulty.so", {"--lossy", "--health", "20s"});
  EXPECT_EQ(faulty.code, 5) << faulty.out << faulty.err;
  EXPECT_THAT(faulty.err, HasSubstr("the previous version runs again: the new one faulted"));
  EXPECT_EQ(module_state("a"), "running");
  ASSERT_EQ(reload("steady.so", {"--lossy", "--health", "0s"}).code, 0);
  const Outcome back = indurop({"reload", "steady", "--back", "--board", board("a")});
  EXPECT_EQ(back.code, 0) << back.err;
  EXPECT_THAT(back.err, HasSubstr("the previous version runs again"));
  EXPECT_TRUE(runs("a", id_)) << "the deployment is what it was";
  ASSERT_EQ(indurop({"restart", "@" + board("a")}).code, 0);
  EXPECT_EQ(version("a"), 1) << "a node starts with what was deployed";
}

TEST_F(Commands, An_agent_refuses_an_exchange_that_it_cannot_begin) {
  start_plant();
  const std::string file = std::string(MODULE_FOLDER) + "/other.so";
  const Outcome module = indurop({"reload", "stedy", file, "--board", board("a")});
  EXPECT_EQ(module.code, 1);
  EXPECT_THAT(module.err, HasSubstr("it has no module stedy; it has steady"));
  const Outcome health = indurop({"reload", "steady", file, "--board", board("a"), "--health", "1h"});
  EXPECT_EQ(health.code, 1);
  EXPECT_THAT(health.err, HasSubstr("is 60 s at most"));
  EXPECT_EQ(indurop({"reload", "steady", file, "--board", "missing", "--timeout", "1s"}).code, 6);
  EXPECT_EQ(indurop({"reload", "steady", "--board", board("a")}).code, 2) << "no file";
  EXPECT_EQ(indurop({"reload", "steady", file, "--board", board("a"), "--shadow", "1s"}).code, 2);
}

TEST_F(Commands, The_node_tells_what_was_deployed) {
  start_plant();
  EXPECT_EQ(indurop_here({"status", "--node", board("a"), "-o", "json"}).json()["deployment"], id_);
  EXPECT_THAT(indurop_here({"status", "--node", board("a")}).out, HasSubstr("deployed  " + id_.substr(0, 12)));
}

TEST_F(Commands, A_board_stopped_by_command_stays_down_until_it_is_commanded_to_start) {
  start_plant();
  const pid_t first = vars::running_node(board("b"));
  ASSERT_EQ(indurop({"stop", "@" + board("b")}).code, 0);
  EXPECT_EQ(vars::running_node(board("b")), 0);
  const Json seen = report("b");
  EXPECT_EQ(seen["state"], "stopped");
  EXPECT_THAT(seen["message"].get<std::string>(), HasSubstr("stopped by command from"));
  EXPECT_THAT(indurop({"stop", "@" + board("b")}).err, HasSubstr("is stopped already"));
  EXPECT_EQ(indurop({"stop", "steady@" + board("b")}).code, 1) << "there is no node to command";
  const Outcome started = indurop({"start", "@" + board("b")});
  EXPECT_EQ(started.code, 0) << started.err;
  EXPECT_TRUE(runs("b", id_));
  EXPECT_NE(vars::running_node(board("b")), first);
  const pid_t second = vars::running_node(board("b"));
  EXPECT_EQ(indurop({"restart", "@" + board("b")}).code, 0);
  EXPECT_NE(vars::running_node(board("b")), second);
  EXPECT_TRUE(runs("b", id_));
}

TEST_F(Commands, A_deployment_starts_a_stopped_board_and_a_bad_one_leaves_it_stopped) {
  start_plant();
  ASSERT_EQ(indurop({"stop", "@" + board("b")}).code, 0);
  EXPECT_EQ(deploy(manifest("v2.xml", {{"a", "faulty"}, {"b", "other"}}), {"--health", "5s"}).code, 5);
  EXPECT_TRUE(wait_until([&] { return runs("a", id_) && report("b")["state"] == "stopped"; }));
  const std::string next = deployed(manifest("v3.xml", {{"a", "other"}, {"b", "other"}}));
  EXPECT_TRUE(wait_until([&] { return runs("a", next) && runs("b", next); }));
}

TEST_F(Commands, A_process_that_died_once_does_not_spoil_later_deployments) {
  std::filesystem::copy_file(std::string(MODULE_FOLDER) + "/waits", folder() / "waits");
  const std::string file =
      manifest("v1.xml", {{"a", "steady"}},
               "<module><filename>./waits</filename><moduletype>process</moduletype>"
               "<operationtype>non-real</operationtype><restart delay=\"10ms\" max=\"9\"/></module>");
  const auto process = [&] {
    const Json all = indurop_here({"status", "--node", board("a"), "-o", "json"}).json();
    return all.is_object() && all["modules"].size() == 2 ? all["modules"][1] : Json();
  };
  start_agent("a");
  const std::string id = deployed(file);
  ASSERT_TRUE(wait_until([&] { return runs("a", id); }));
  const pid_t node = vars::running_node(board("a"));
  const Json first = process();
  ASSERT_EQ(first["state"], "running");
  ASSERT_EQ(::kill(first["pid"].get<pid_t>(), SIGKILL), 0);
  ASSERT_TRUE(wait_until([&] {
    const Json now = process();
    return now["state"] == "running" && now["pid"] != first["pid"];
  }));
  EXPECT_EQ(deployed(file), id);
  EXPECT_EQ(vars::running_node(board("a")), node);
  EXPECT_EQ(deploy(manifest("v2.xml", {{"a", "faulty"}}), {"--health", "5s"}).code, 5);
  EXPECT_TRUE(wait_until([&] { return runs("a", id); }));
}

TEST_F(Commands, Unknown_boards_and_modules_are_named) {
  start_plant();
  const Outcome board_wrong = indurop({"stop", "steady@missing", "--timeout", "1s"});
  EXPECT_EQ(board_wrong.code, 6);
  EXPECT_THAT(board_wrong.err, HasSubstr("board missing was not heard"));
  const Outcome module_wrong = indurop({"stop", "stedy@" + board("a")});
  EXPECT_EQ(module_wrong.code, 1);
  EXPECT_THAT(module_wrong.err, HasSubstr("it has no module stedy; it has steady"));
}

TEST_F(Commands, A_board_with_a_key_takes_signed_commands_only) {
  const std::string file = manifest("v1.xml", {{"a", "steady"}, {"b", "steady"}});
  bring_keys(file, {"a", "b"});
  ASSERT_EQ(indurop_here({"keys", "init", file, "--dir", path("strange")}).code, 0);
  const auto thief = folder() / "thief";
  std::filesystem::copy(folder() / "keys/deployer", thief);
  std::filesystem::copy_file(folder() / "strange/deployer/deploy.key", thief / "deploy.key",
                             std::filesystem::copy_options::overwrite_existing);
  start_agent("a");
  start_agent("b");
  const std::string plant = "p" + std::to_string(::getpid());
  speak_with_keys(path("keys"));
  const Outcome done = deploy(file);
  ASSERT_EQ(done.code, 0) << done.err;
  const Outcome refused = indurop({"stop", "steady@" + board("a"), "--keys", thief.string()});
  EXPECT_EQ(refused.code, 1) << refused.err;
  EXPECT_THAT(refused.err, HasSubstr("it is not signed with the key of plant " + plant));
  EXPECT_EQ(module_state("a"), "running");
  const std::string other = std::string(MODULE_FOLDER) + "/other.so";
  const std::vector<std::string> reload = {"reload",   "steady",  other,      "--board",
                                           board("a"), "--lossy", "--health", "0s"};
  std::vector<std::string> as_thief = reload;
  as_thief.insert(as_thief.end(), {"--keys", thief.string()});
  EXPECT_EQ(indurop(as_thief).code, 1);
  const Outcome exchanged = indurop(reload);
  EXPECT_EQ(exchanged.code, 0) << exchanged.err;
  const Outcome good = indurop({"stop", "steady@" + board("a")});
  EXPECT_EQ(good.code, 0) << good.err;
  EXPECT_EQ(module_state("a"), "stopped");
}

TEST_F(Commands, A_board_left_out_of_the_plant_stops_with_the_switch) {
  start_plant();
  const Outcome done = deploy(manifest("v2.xml", {{"a", "other"}}));
  ASSERT_EQ(done.code, 0) << done.err;
  EXPECT_THAT(done.err, HasSubstr("board " + board("b") + " is not part of the plant any more: its node ends"));
  EXPECT_EQ(vars::running_node(board("b")), 0);
  const Json seen = report("b");
  EXPECT_EQ(seen["state"], "empty");
  EXPECT_THAT(seen["message"].get<std::string>(), HasSubstr("no longer part of plant"));
  // Its agent comes back and knows it.
  stop_agent("b", SIGKILL);
  start_agent("b");
  EXPECT_TRUE(wait_until([&] { return report("b").is_object(); }));
  EXPECT_EQ(vars::running_node(board("b")), 0);
  EXPECT_THAT(deploy(manifest("v3.xml", {{"a", "steady"}})).err, testing::Not(HasSubstr("not part of the plant")));
  // And belongs to it again when the manifest says so.
  const std::string both = deployed(path("v1.xml"));
  EXPECT_TRUE(wait_until([&] { return runs("b", both); }));
}

TEST_F(Commands, A_board_left_out_goes_on_if_the_deployment_is_taken_back) {
  start_plant();
  EXPECT_EQ(deploy(manifest("v2.xml", {{"a", "faulty"}}), {"--health", "5s"}).code, 5);
  EXPECT_TRUE(wait_until([&] { return runs("a", id_) && runs("b", id_); }));
}

TEST_F(Commands, A_board_left_out_while_it_was_away_stops_when_it_is_back) {
  start_plant();
  stop_agent("b", SIGKILL);  // its node goes on
  ASSERT_TRUE(wait_until([&] { return report("b").is_null(); }));
  const Outcome done = deploy(manifest("v2.xml", {{"a", "other"}}));
  ASSERT_EQ(done.code, 0) << done.err;
  EXPECT_THAT(done.err, HasSubstr("was not heard: its node ends when it comes back"));
  EXPECT_NE(vars::running_node(board("b")), 0);
  start_agent("b");
  EXPECT_TRUE(wait_until([&] { return vars::running_node(board("b")) == 0; }));
}

}  // namespace
}  // namespace indurop::test
