// SPDX-License-Identifier: Apache-2.0
// How the node of a board does and what is forced on it, seen and changed from elsewhere.

#include <cstdlib>
#include <fstream>

#include "agents_fixture.h"

namespace indurop::test {
namespace {

using testing::HasSubstr;

class RemoteLook : public AgentsTest {
 protected:
  RemoteLook() { std::filesystem::copy_file(TWO_BOARDS "/table.so", folder() / "table.so"); }
  void start_boards(const std::vector<std::string>& more = {}) {
    start_agent("a");
    start_agent("b");
    const Outcome done = deploy(manifest("v1.xml", {{"a", "table"}, {"b", "steady"}}), more);
    ASSERT_EQ(done.code, 0) << done.err;
  }
  Outcome at_a(std::vector<std::string> words) {
    words.insert(words.end(), {"--board", board("a")});
    return indurop(words);
  }
  Json here(std::vector<std::string> words) {
    words.insert(words.end(), {"--node", board("a"), "-o", "json"});
    return indurop_here(words).json();
  }
};

// Compared with what the same verbs read in the node's own memory.
TEST_F(RemoteLook, Runs_and_figures_are_those_of_the_node) {
  start_boards();
  ASSERT_TRUE(wait_until([&] { return here({"status"})["modules"][0]["runs"] >= 200; }));
  const Json remote = at_a({"log", "-n", "500", "-o", "json"}).json();
  const Json near = here({"log", "-n", "8192"});
  ASSERT_GE(remote["runs"].size(), 100U);
  std::map<std::uint64_t, Json> known;
  for (const Json& run : near["runs"]) {
    known[run["tick"]] = run;
  }
  for (const Json& run : remote["runs"]) {
    EXPECT_EQ(run, known[run["tick"]]);
  }
  const Json before = here({"jitter"})["modules"][0];
  const Json seen = at_a({"jitter", "-o", "json"}).json()["modules"][0];
  const Json after = here({"jitter"})["modules"][0];
  EXPECT_EQ(seen["name"], "table");
  for (const char* quantity : {"jitter_ns", "latency_ns", "exec_ns", "response_ns"}) {
    for (const char* rising : {"count", "max"}) {
      EXPECT_LE(before[quantity][rising], seen[quantity][rising]) << quantity;
      EXPECT_LE(seen[quantity][rising], after[quantity][rising]) << quantity;
    }
  }
  const Json status = at_a({"status", "-o", "json"}).json();
  const Json same = here({"status"});
  for (const char* constant : {"node", "running", "pid", "config_file", "deployment", "basic_period_ns", "forces"}) {
    EXPECT_EQ(status[constant], same[constant]) << constant;
  }
  EXPECT_NEAR(status["uptime_ns"].get<double>(), same["uptime_ns"].get<double>(), 60e9);
  EXPECT_EQ(at_a({"overruns", "-o", "json"}).json()["node"], board("a"));
}

TEST_F(RemoteLook, Values_are_forced_all_or_none) {
  start_boards();
  const Outcome wrong = at_a({"force", "torque=9", "echo=7", "nothing=1", "encoder={speed: ?}"});
  EXPECT_EQ(wrong.code, 1);
  EXPECT_THAT(wrong.err, HasSubstr("9 is outside -5..5"));
  EXPECT_THAT(wrong.err, HasSubstr("no variable 'nothing'"));
  EXPECT_THAT(wrong.err, HasSubstr("encoder: speed: '?' is not a number"));
  EXPECT_EQ(here({"forces"})["forces"], Json::array()) << "all or none";
  ASSERT_EQ(at_a({"force", "echo=7", "encoder={speed: 0.5}", "--for", "60s", "--reason", "a trial"}).code, 0);
  EXPECT_EQ(here({"get", "echo", "encoder.speed"})["values"][0]["value"], 7);
  Json near = here({"forces"})["forces"];
  Json remote = at_a({"forces", "-o", "json"}).json()["forces"];
  ASSERT_EQ(near.size(), 2U);
  for (Json* list : {&near, &remote}) {
    for (Json& force : *list) {
      EXPECT_GT(force["left_ns"].get<std::int64_t>(), 0);
      force["left_ns"] = 0;
      EXPECT_EQ(force["reason"], "a trial");
      EXPECT_NE(force["from"], "");
    }
  }
  EXPECT_EQ(remote, near);
  EXPECT_THAT(at_a({"status"}).out, HasSubstr("forced    cell::echo = 7"));
  EXPECT_EQ(at_a({"unforce", "nothing"}).code, 1);
  ASSERT_EQ(at_a({"unforce", "encoder"}).code, 0);
  EXPECT_EQ(here({"forces"})["forces"].size(), 1U);
  ASSERT_EQ(at_a({"unforce", "--all"}).code, 0);
  EXPECT_EQ(here({"forces"})["forces"], Json::array());
}

TEST_F(RemoteLook, Values_are_set_all_or_none) {
  start_boards();
  const auto value = [&](const char* name) { return here({"get", name})["values"][0]["value"]; };
  const Json before = value("echo");
  const Outcome wrong = at_a({"set", "echo=7", "torque=9", "nothing=1"});
  EXPECT_EQ(wrong.code, 1);
  EXPECT_THAT(wrong.err, HasSubstr("9 is outside -5..5"));
  EXPECT_THAT(wrong.err, HasSubstr("no variable 'nothing'"));
  EXPECT_EQ(value("echo"), before) << "all or none";
  ASSERT_EQ(at_a({"set", "torque", "2.5", "--reason", "a trial"}).code, 0);
  EXPECT_EQ(value("torque"), 2.5);
  ASSERT_EQ(at_a({"set", "encoder={speed: 0.25}", "torque=-1"}).code, 0);
  EXPECT_EQ(value("torque"), -1);
  ASSERT_EQ(at_a({"force", "torque=1"}).code, 0);
  const Outcome forced = at_a({"set", "torque=2"});
  EXPECT_EQ(forced.code, 1);
  EXPECT_THAT(forced.err, HasSubstr("torque is forced"));
  ASSERT_EQ(at_a({"unforce", "--all"}).code, 0);
  ASSERT_EQ(at_a({"lock", "all"}).code, 0);
  const Outcome locked = at_a({"set", "torque=3"});
  EXPECT_EQ(locked.code, 1);
  EXPECT_THAT(locked.err, HasSubstr("its write lock is 'all'"));
  EXPECT_EQ(value("torque"), 1);
}

// Compared with the same orders given on the board itself.
TEST_F(RemoteLook, Orders_are_noted_as_those_given_on_the_board) {
  start_boards();
  const std::vector<std::vector<std::string>> orders{
      {"set", "echo=3", "--reason", "a start"},
      {"force", "torque=1", "encoder.speed=0.5", "--for", "600s", "--reason", "a trial"},
      {"unforce", "torque", "--reason", "trial over"},
      {"force", "echo=7"},
      {"unforce", "--all", "--reason", "shift ends"},
      {"force", "torque=2"},
      {"unforce", "*::torque"},
      {"lock", "tune", "--reason", "production"},
      {"lock", "none"},
  };
  const auto file = folder() / "state" / board("a") / "orders.jsonl";
  const auto noted = [&] {
    Json all = Json::array();
    std::ifstream lines(file);
    for (std::string line; std::getline(lines, line);) {
      Json one = Json::parse(line);
      EXPECT_GT(one["node_ns"].get<std::int64_t>(), 0) << line;
      EXPECT_NE(one["from"], "") << line;
      one["ends"] = one["until_ns"].get<std::int64_t>() > one["node_ns"].get<std::int64_t>();
      for (const char* other : {"node_ns", "wall_ns", "until_ns", "from"}) {
        one.erase(other);
      }
      all.push_back(std::move(one));
    }
    std::filesystem::remove(file);
    return all;
  };
  for (const std::vector<std::string>& order : orders) {
    const Outcome outcome = at_a(order);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
  }
  const Json remote = noted();
  for (std::vector<std::string> order : orders) {
    order.insert(order.end(), {"--node", board("a")});
    const Outcome outcome = indurop_here(order);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
  }
  const Json local = noted();
  EXPECT_EQ(local.size(), orders.size() + 2);  // two that are of two values
  EXPECT_EQ(remote, local);
}

// Compared with the same commands given on the board itself.
TEST_F(RemoteLook, Commands_to_modules_are_noted_with_user_and_reason) {
  start_boards();
  const auto file = folder() / "state" / board("a") / "orders.jsonl";
  const auto noted = [&] {
    Json all = Json::array();
    std::ifstream lines(file);
    for (std::string line; std::getline(lines, line);) {
      const Json one = Json::parse(line);
      EXPECT_NE(one["from"], "") << line;
      all.push_back({one["action"], one["what"], one["who"], one["reason"]});
    }
    std::filesystem::remove(file);
    return all;
  };
  const std::vector<std::string> verbs{"stop", "start", "restart"};
  for (const std::string& verb : verbs) {
    const Outcome outcome = indurop({verb, "table@" + board("a"), "--reason", verb + ": \"shift\" ends"});
    EXPECT_EQ(outcome.code, 0) << outcome.err;
  }
  const Json remote = noted();
  for (const std::string& verb : verbs) {
    const Outcome outcome = indurop_here({verb, "table", "--node", board("a"), "--reason", verb + ": \"shift\" ends"});
    EXPECT_EQ(outcome.code, 0) << outcome.err;
  }
  const Json local = noted();
  EXPECT_EQ(local.size(), verbs.size());
  EXPECT_EQ(remote, local);
}

TEST_F(RemoteLook, Commands_to_a_node_are_noted_with_user_and_reason) {
  start_boards();
  ASSERT_EQ(indurop({"stop", "@" + board("a"), "--reason", "belt torn"}).code, 0);
  const std::string message = report("a")["message"];
  EXPECT_THAT(message, HasSubstr("belt torn"));
  ASSERT_EQ(indurop({"start", "@" + board("a"), "--reason", "belt mended"}).code, 0);
  std::ifstream lines(folder() / "state" / board("a") / "orders.jsonl");
  Json all = Json::array();
  for (std::string line; std::getline(lines, line);) {
    const Json one = Json::parse(line);
    EXPECT_THAT(message, HasSubstr(one["who"].get<std::string>()));
    all.push_back({one["action"], one["what"], one["reason"]});
  }
  EXPECT_EQ(all, Json({{"stop", "@" + board("a"), "belt torn"}, {"start", "@" + board("a"), "belt mended"}}));
}

// The values of the variables, as the same literals set them on the board itself.
TEST_F(RemoteLook, Agents_take_the_literals_of_PLC_programs) {
  start_boards();
  for (const char* text : {"16#7F", "INT#-5", "2#1010", "T#5ns", "TRUE", "INT#70000"}) {
    const Outcome local = indurop_here({"set", "echo", text, "--node", board("a")});
    const Json wanted = here({"get", "echo"})["values"][0]["value"];
    ASSERT_EQ(indurop_here({"set", "echo=1", "--node", board("a")}).code, 0);
    const Outcome remote = at_a({"set", "echo", text});
    EXPECT_EQ(remote.code, local.code) << text << ": " << remote.err << local.err;
    if (local.code == 0) {
      EXPECT_EQ(here({"get", "echo"})["values"][0]["value"], wanted) << text;
    }
  }
  ASSERT_EQ(at_a({"force", "echo=INT#16#11"}).code, 0);
  EXPECT_EQ(here({"forces"})["forces"][0]["value"], 17);
}

TEST_F(RemoteLook, A_refusal_is_worded_as_on_the_board) {
  start_boards();
  ASSERT_EQ(at_a({"force", "torque=1"}).code, 0);
  for (const std::vector<std::string>& order : std::vector<std::vector<std::string>>{
           {"set", "torque=2"}, {"set", "torque=9"}, {"set", "nothing=1"}, {"unforce", "nothing"}}) {
    const auto reason = [](const Outcome& outcome) {
      EXPECT_EQ(outcome.code, 1) << outcome.err;
      const auto at = outcome.err.find("error: ");
      return at == std::string::npos ? outcome.err : outcome.err.substr(at + 7);
    };
    std::vector<std::string> here = order;
    here.insert(here.end(), {"--node", board("a")});
    EXPECT_EQ(reason(at_a(order)), "board " + board("a") + ": " + reason(indurop_here(here)));
  }
}

TEST_F(RemoteLook, A_lease_ends_with_its_remote_client) {
  start_boards();
  Program& holder = start_indurop({"force", "echo=7", "--lease", "--board", board("a")});
  ASSERT_TRUE(wait_until([&] { return here({"forces"})["forces"].size() == 1; })) << holder.out();
  EXPECT_EQ(here({"forces"})["forces"][0]["lease"], true);
  const auto left = [&] { return here({"forces"})["forces"][0]["left_ns"].get<std::int64_t>(); };
  std::int64_t before = left();
  EXPECT_TRUE(wait_until([&] { return std::exchange(before, left()) < before; })) << "it is renewed";
  holder.signal(SIGKILL);
  EXPECT_TRUE(wait_until([&] { return here({"forces"})["forces"].empty(); }));
  Program& other = start_indurop({"force", "echo=8", "--lease", "--board", board("a")});
  ASSERT_TRUE(wait_until([&] { return here({"forces"})["forces"].size() == 1; })) << other.out();
  other.signal(SIGINT);
  EXPECT_EQ(other.wait(), 0) << other.err();
  EXPECT_EQ(here({"forces"})["forces"], Json::array()) << "at once";
}

TEST_F(RemoteLook, A_locked_board_refuses_remote_orders) {
  start_boards();
  ASSERT_EQ(at_a({"lock", "tune", "--reason", "production"}).code, 0);
  EXPECT_THAT(at_a({"lock"}).out, HasSubstr("tune"));
  EXPECT_EQ(here({"lock"})["reason"], "production");
  for (const std::vector<std::string>& words : {std::vector<std::string>{"force", "echo=7"}, {"unforce", "--all"}}) {
    const Outcome refused = at_a(words);
    EXPECT_EQ(refused.code, 1);
    EXPECT_THAT(refused.err, HasSubstr("its write lock is 'tune'"));
  }
  const Outcome stop = indurop({"stop", "table@" + board("a")});
  EXPECT_EQ(stop.code, 1);
  EXPECT_THAT(stop.err, HasSubstr("its write lock is 'tune'"));
  ASSERT_EQ(at_a({"lock", "none"}).code, 0);
  EXPECT_EQ(at_a({"force", "echo=7"}).code, 0);
}

TEST_F(RemoteLook, Boards_with_keys_are_forced_by_who_has_them) {
  bring_keys(manifest("v1.xml", {{"a", "table"}, {"b", "steady"}}), {"a", "b"});
  start_boards({"--keys", path("keys")});
  const Outcome unheard = at_a({"force", "echo=7"});
  EXPECT_EQ(unheard.code, 6);
  EXPECT_THAT(unheard.err, HasSubstr("--keys DIR"));
  const Outcome refused = at_a({"force", "echo=7", "--keys", path("keys/viewer")});
  EXPECT_EQ(refused.code, 1);
  EXPECT_THAT(refused.err, HasSubstr("deploy.key is missing"));
  EXPECT_EQ(here({"forces"})["forces"], Json::array());
  EXPECT_EQ(at_a({"set", "torque=1", "--keys", path("keys/viewer")}).code, 1);
  EXPECT_EQ(at_a({"set", "torque=1", "--keys", path("keys")}).code, 0);
  EXPECT_EQ(here({"get", "torque"})["values"][0]["value"], 1);
  EXPECT_EQ(at_a({"force", "echo=7", "--keys", path("keys")}).code, 0);
  EXPECT_EQ(here({"forces"})["forces"].size(), 1U);
}

TEST_F(RemoteLook, What_a_node_did_before_it_died_is_kept) {
  start_boards();
  const std::uint64_t ticks = here({"status"})["ticks"];
  const pid_t first = vars::running_node(board("a"));
  ::kill(first, SIGKILL);
  const std::filesystem::path kept = folder() / "state" / board("a") / "blackbox";
  ASSERT_TRUE(wait_until([&] {
    const pid_t next = vars::running_node(board("a"));
    return next > 0 && next != first;
  }));
  ASSERT_TRUE(std::filesystem::exists(kept));
  const std::string file = std::filesystem::directory_iterator(kept)->path();
  const Outcome status = indurop_here({"status", "--from", file, "-o", "json"});
  ASSERT_EQ(status.code, 0) << status.err;
  const Json sut = status.json();
  EXPECT_EQ(sut["node"], board("a"));
  EXPECT_EQ(sut["running"], false);
  EXPECT_GE(sut["ticks"].get<std::uint64_t>(), ticks);
  const Json log = indurop_here({"log", "--from", file, "-n", "8192", "-o", "json"}).json();
  ASSERT_FALSE(log["runs"].empty());
  EXPECT_GE(log["runs"].back()["tick"].get<std::uint64_t>() + 2, sut["ticks"].get<std::uint64_t>());
  EXPECT_EQ(indurop_here({"jitter", "--from", file}).code, 0);
  EXPECT_EQ(indurop_here({"overruns", "--from", path("v1.xml")}).code, 1);
  EXPECT_EQ(indurop_here({"overruns", "--from", path("none")}).code, 1);
}

TEST_F(RemoteLook, Who_is_not_there_is_named) {
  start_boards();
  const Outcome unknown = indurop({"log", "--board", "missing"});
  EXPECT_EQ(unknown.code, 6);
  EXPECT_THAT(unknown.err, HasSubstr("no agent is named missing"));
  EXPECT_THAT(unknown.err, HasSubstr(board("a") + ", " + board("b")));
  const Outcome which = indurop({"jitter", "--remote"});
  EXPECT_EQ(which.code, 2);
  EXPECT_THAT(which.err, HasSubstr("say which with --board: " + board("a") + ", " + board("b")));
  EXPECT_EQ(indurop({"status", "--board", board("a"), "--node", board("a")}).code, 2);
  ASSERT_EQ(indurop({"stop", "@" + board("a")}).code, 0);
  EXPECT_EQ(at_a({"status"}).code, 6) << "the last figures are shown";
  EXPECT_EQ(at_a({"force", "echo=7"}).code, 1);
}

}  // namespace
}  // namespace indurop::test
