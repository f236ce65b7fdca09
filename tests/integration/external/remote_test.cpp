// SPDX-License-Identifier: Apache-2.0
// `indurop` reads boards from a machine without a node and without their types.

#include <csignal>
#include <nlohmann/json.hpp>

#include "live.h"
#include "store/vars/store.h"

namespace indurop::test {
namespace {

using Json = nlohmann::json;

class Remote : public Live {
 protected:
  Outcome remote(std::vector<std::string> words) const {
    words.insert(words.end(), {"--one-host", "--domain", domain()});
    return indurop(words);
  }
  // Prints a line each time it sees another value.
  Program& watch_cycle() {
    programs_.push_back(
        std::make_unique<Program>(std::vector<std::string>{INDUROP_PROGRAM, "watch", "station::state.cycle", "--hz",
                                                           "20", "--one-host", "--domain", domain()},
                                  environment()));
    return *programs_.back();
  }
};

TEST_F(Remote, Values_are_read_by_name_in_the_forms_that_a_local_node_has) {
  start_axis();
  const Outcome target = remote({"get", "station::target"});
  EXPECT_EQ(target.code, 0) << target.err;
  EXPECT_EQ(target.out, "100\n");
  EXPECT_EQ(remote({"get", "station::state.program"}).out, "\"pick and place\"\n");
  const Outcome all = remote({"get", "station::*", "-o", "json"});
  ASSERT_EQ(all.code, 0) << all.err;
  const Json json = Json::parse(all.out);
  EXPECT_EQ(json["running"], true);
  ASSERT_EQ(json["values"].size(), 3U);
  EXPECT_EQ(json["values"][0]["name"], "station::limit");
  EXPECT_EQ(json["values"][0]["unit"], "mm");
  const Outcome board = remote({"get", "target@" + node()});
  EXPECT_EQ(board.out, "100\n") << board.err;
}

TEST_F(Remote, Vars_and_typeof_tell_units_and_ranges) {
  start_axis();
  const Outcome vars = remote({"vars", "-o", "json"});
  ASSERT_EQ(vars.code, 0) << vars.err;
  const Json json = Json::parse(vars.out);
  ASSERT_EQ(json["variables"].size(), 3U);
  EXPECT_EQ(json["variables"][2]["name"], "station::target");
  EXPECT_EQ(json["variables"][2]["type"], "double");
  EXPECT_EQ(json["variables"][2]["range"], Json({0, 500}));
  const Outcome type = remote({"typeof", "station::state"});
  EXPECT_CONTAINS(type.out, "station::state.force");
  EXPECT_CONTAINS(type.out, "HOLDING, MOVING, ARRIVED");
  EXPECT_CONTAINS(indurop({"typeof", "state", "--node", node()}).out, "float[3]");
}

TEST_F(Remote, A_locked_board_is_not_set_by_tools_elsewhere) {
  start_axis();
  ASSERT_EQ(remote({"set", "station::target", "42.5"}).code, 0);
  ASSERT_EQ(indurop({"lock", "all", "--node", node()}).code, 0);
  const Outcome locked = remote({"set", "station::target", "17"});
  EXPECT_EQ(locked.code, 1);
  EXPECT_CONTAINS(locked.err, "is it locked");
  EXPECT_CONTAINS(get("station::target"), "42.5");
  ASSERT_EQ(indurop({"lock", "none", "--node", node()}).code, 0);
  EXPECT_EQ(remote({"set", "station::target", "17"}).code, 0);
  EXPECT_CONTAINS(get("station::target"), "17");
}

TEST_F(Remote, Setting_is_confirmed_by_the_board_and_only_what_the_manifest_lets) {
  start_axis();
  const Outcome good = remote({"set", "station::target", "42.5"});
  EXPECT_EQ(good.code, 0) << good.err;
  EXPECT_CONTAINS(get("station::target"), "42.5");
  const Outcome beyond = remote({"set", "station::target", "501"});
  EXPECT_EQ(beyond.code, 1);
  EXPECT_CONTAINS(beyond.err, "501 is outside 0..500");
  const Outcome closed = remote({"set", "station::limit", "3"});
  EXPECT_EQ(closed.code, 1);
  EXPECT_CONTAINS(closed.err, "does not let it be set from outside: external=\"write\"");
  EXPECT_CONTAINS(get("station::limit"), "400");
}

// Their topics tell nothing about their types and have other names: only the board knows both.
TEST_F(Remote, Names_of_ROS_2_make_no_difference) {
  start_axis(" ros2=\"on\"");
  EXPECT_EQ(remote({"get", "station::target"}).out, "100\n");
  EXPECT_EQ(remote({"get", "station::state.program"}).out, "\"pick and place\"\n");
  EXPECT_EQ(remote({"get", "station::state.force[1]"}).out, "9.5\n");
  const Outcome vars = remote({"vars", "-o", "json"});
  ASSERT_EQ(vars.code, 0) << vars.err;
  EXPECT_EQ(Json::parse(vars.out)["variables"].size(), 3U);
  EXPECT_EQ(vars.err, "") << "no topic is left over as a stranger's";
  EXPECT_CONTAINS(remote({"typeof", "station::state"}).out, "HOLDING, MOVING, ARRIVED");
  const Outcome hz = remote({"hz", "station::state", "--once", "-o", "json"});
  ASSERT_EQ(hz.code, 0) << hz.err;
  EXPECT_GT(Json::parse(hz.out)["rate_hz"].get<double>(), 5);
  const Outcome good = remote({"set", "station::target", "42.5"});
  EXPECT_EQ(good.code, 0) << good.err;
  EXPECT_CONTAINS(get("station::target"), "42.5");
  const Outcome closed = remote({"set", "station::limit", "3"});
  EXPECT_EQ(closed.code, 1);
  EXPECT_CONTAINS(closed.err, "does not let it be set from outside");
}

class RemoteReturn : public Remote, public ::testing::WithParamInterface<const char*> {};

TEST_P(RemoteReturn, Watch_goes_on_when_the_node_comes_back) {
  Program& first = start_axis(GetParam());
  Program& watch = watch_cycle();
  ASSERT_TRUE(wait_until([&] { return lines(watch) > 3; })) << watch.err();
  first.kill();
  ASSERT_EQ(first.wait(), 128 + SIGKILL);
  EXPECT_TRUE(watch.says("not heard: " + node()));
  const std::size_t before = lines(watch);
  start_axis(GetParam());
  EXPECT_TRUE(wait_until([&] { return lines(watch) > before + 5; })) << watch.err();
  EXPECT_TRUE(watch.says("all boards are heard again"));
  watch.signal(SIGINT);
  EXPECT_EQ(watch.wait(), 130);
}

INSTANTIATE_TEST_SUITE_P(Names, RemoteReturn, ::testing::Values("", " ros2=\"on\""));

TEST_F(Remote, Watch_goes_on_when_the_node_comes_back_with_another_type) {
  Program& first = start_axis();
  Program& watch = watch_cycle();
  ASSERT_TRUE(wait_until([&] { return lines(watch) > 3; })) << watch.err();
  first.kill();
  ASSERT_EQ(first.wait(), 128 + SIGKILL);
  EXPECT_TRUE(watch.says("not heard: " + node()));
  Program& second = start_file(configuration(STRANGE_TYPES, "", STRANGE_AXIS), {"--node", node()});
  ASSERT_TRUE(wait_until_running(second)) << second.err();
  const std::size_t before = lines(watch);
  EXPECT_TRUE(wait_until([&] { return lines(watch) > before + 5; })) << watch.out() << watch.err();
  EXPECT_EQ(remote({"get", "station::state.position"}).out, "1.5\n");
  watch.signal(SIGINT);
  EXPECT_EQ(watch.wait(), 130);
}

TEST_F(Remote, Hz_counts_what_comes_over_the_network) {
  start_axis();
  const Outcome sut = remote({"hz", "station::state", "--once", "-o", "json"});
  ASSERT_EQ(sut.code, 0) << sut.err;
  EXPECT_GT(Json::parse(sut.out)["rate_hz"].get<double>(), 5);
}

TEST_F(Remote, Without_participants_the_answer_comes_in_bounded_time) {
  const Outcome alone = remote({"get", "station::target", "--wait", "300ms"});
  EXPECT_EQ(alone.code, 6);
  EXPECT_CONTAINS(alone.err, "shows variables in DDS domain " + domain());
  start_axis();
  const Outcome wrong = remote({"get", "station::targt"});
  EXPECT_EQ(wrong.code, 1);
  EXPECT_CONTAINS(wrong.err, "station::target");
  EXPECT_CONTAINS(remote({"get", "station::target@elsewhere"}).err, "there is no board elsewhere");
  EXPECT_EQ(indurop({"get", "station::target", "--remote", "--node", node()}).code, 2);
}

TEST_F(Remote, Boards_that_are_not_heard_are_named) {
  const std::string plant =
      write("plant.xml", "<plant name=\"" + node() + "\"><domain>" + std::to_string(dds_domain(1)) +
                             "</domain><external>" + domain() +
                             "</external><types>" EXAMPLE_FOLDER
                             "/libstation_types.so</types><board name=\"absent\"/>"
                             "<board name=\"" +
                             node() +
                             "\"><module><filename>" EXAMPLE_FOLDER
                             "/axis.so</filename><moduletype>thread</moduletype><operationtype>periodic</operationtype>"
                             "<period>1ms</period><priority>1</priority></module></board></plant>");
  Program& sut = start_file(plant, {"--node", node(), "--board", node(), "--one-host"});
  ASSERT_TRUE(wait_until_running(sut)) << sut.err();
  ASSERT_TRUE(runs_reach("axis", 300));
  const Outcome heard = remote({"get", "station::state.inside", "--wait", "2s"});
  EXPECT_EQ(heard.code, 0) << heard.err;
  EXPECT_EQ(heard.out, "true\n");
  EXPECT_CONTAINS(heard.err, "silent: absent");
}

// Two boards that run the axis, one of them as standby.
class RemoteStandby : public Remote {
 protected:
  ~RemoteStandby() override {
    for (const auto& program : programs_) {
      program->kill();
      (void)program->wait();
    }
    (void)vars::remove_node(backup());
  }
  std::string backup() const { return node() + "-backup"; }
  std::string plant() const {
    return write("plant.xml", "<plant name=\"" + node() + "\"><domain>" + std::to_string(dds_domain(1)) +
                                  "</domain><external>" + domain() +
                                  "</external><types>" EXAMPLE_FOLDER "/libstation_types.so</types><board name=\"" +
                                  node() +
                                  "\"><module><filename>" EXAMPLE_FOLDER
                                  "/axis.so</filename><moduletype>thread</moduletype><operationtype>periodic"
                                  "</operationtype><period>1ms</period><priority>1</priority><standby>" +
                                  backup() + "</standby></module></board><board name=\"" + backup() + "\"/></plant>");
  }
  Program& run_board(const std::string& board) {
    return start_file(plant(), {"--node", board, "--board", board, "--one-host", "-q"});
  }
  bool shown_by(const std::string& board) const { return remote({"get", "station::state.cycle@" + board}).code == 0; }
  std::uint64_t cycle() const {
    return std::strtoull(remote({"get", "station::state.cycle", "--wait", "3s"}).out.c_str(), nullptr, 10);
  }
};

TEST_F(RemoteStandby, What_it_computes_is_shown_by_the_board_that_leads) {
  Program& first = run_board(node());
  ASSERT_TRUE(wait_until([&] { return cycle() > 2000; })) << first.err();
  Program& second = run_board(backup());
  Program& watch = watch_cycle();
  ASSERT_TRUE(wait_until([&] { return lines(watch) > 3; })) << watch.err() << second.err();
  EXPECT_TRUE(shown_by(node()));
  EXPECT_FALSE(shown_by(backup())) << "it has served less";
  first.kill();
  ASSERT_EQ(first.wait(), 128 + SIGKILL);
  ASSERT_TRUE(wait_until([&] { return shown_by(backup()); }));
  const std::size_t before = lines(watch);
  EXPECT_TRUE(wait_until([&] { return lines(watch) > before + 5; })) << watch.out() << watch.err();
  EXPECT_GT(cycle(), 0U);
  Program& again = run_board(node());
  ASSERT_TRUE(wait_until([&] {
    const auto* block = run();
    return block != nullptr && block->tick.load() > 2000;
  })) << again.err();
  EXPECT_TRUE(shown_by(backup()));
  EXPECT_FALSE(shown_by(node())) << "the lead is not taken back";
  watch.signal(SIGINT);
  EXPECT_EQ(watch.wait(), 130);
}

TEST_F(Remote, Topics_of_a_program_that_is_no_board_are_shown_by_their_types) {
  const Environment alone{
      {"CYCLONEDDS_URI=<General><Interfaces><NetworkInterface name=\"lo\" multicast=\"true\"/></Interfaces></General>"},
      static_cast<uid_t>(-1),
      {}};
  Program stranger({STRANGER, domain()}, alone);
  const Outcome sut = remote({"get", "lab::probe.text", "lab::probe.colour", "lab::probe.d"});
  ASSERT_EQ(sut.code, 0) << sut.err;
  EXPECT_CONTAINS(sut.out, "\"hi\"");
  EXPECT_CONTAINS(sut.out, "BLUE");
  EXPECT_CONTAINS(sut.out, "2.5");
  EXPECT_CONTAINS(remote({"typeof", "lab::probe"}).out, "lab::probe.u32");
  EXPECT_EQ(remote({"set", "lab::probe.d", "1"}).code, 1);
}

using RemoteNetwork = Network;

TEST_F(RemoteNetwork, A_machine_without_a_node_looks_and_sets) {
  if (!up()) {
    GTEST_SKIP() << "network namespaces cannot be made here (root and iproute2 are needed)";
  }
  Program& axis = on("a", {NODE_PROGRAM, EXAMPLE_FOLDER "/module.xml", "--node", node()});
  ASSERT_TRUE(wait_until_running(axis)) << axis.err();
  ASSERT_TRUE(runs_reach("axis", 300));
  Program& looks = on("b", {INDUROP_PROGRAM, "get", "station::target", "--remote"});
  EXPECT_EQ(looks.wait(), 0) << looks.err();
  EXPECT_EQ(looks.out(), "100\n");
  Program& watch = on("b", {INDUROP_PROGRAM, "watch", "station::state.cycle", "--hz", "20", "--remote"});
  ASSERT_TRUE(wait_until([&] { return lines(watch) > 3; })) << watch.err();
  ASSERT_EQ(lab("unplug a"), 0);
  EXPECT_TRUE(watch.says("not heard: " + node()));
  ASSERT_EQ(lab("plug a"), 0);
  EXPECT_TRUE(watch.says("all boards are heard again"));
  const std::size_t before = lines(watch);
  EXPECT_TRUE(wait_until([&] { return lines(watch) > before + 5; })) << watch.err();
  Program& sets = on("b", {INDUROP_PROGRAM, "set", "station::target", "7", "--remote"});
  EXPECT_EQ(sets.wait(), 0) << sets.err();
  EXPECT_CONTAINS(get("station::target"), "7");
}

TEST_F(RemoteNetwork, Without_multicast_a_board_is_found_at_its_address) {
  if (!up() || std::system("command -v iptables >/dev/null") != 0) {
    GTEST_SKIP() << "network namespaces cannot be made here (root, iproute2 and iptables are needed)";
  }
  for (const char* machine : {"a", "b"}) {
    Program& deaf = on(machine, {"iptables", "-A", "INPUT", "-d", "224.0.0.0/4", "-j", "DROP"});
    ASSERT_EQ(deaf.wait(), 0) << deaf.err();
  }
  Program& axis = on("a", {NODE_PROGRAM, EXAMPLE_FOLDER "/module.xml", "--node", node()});
  ASSERT_TRUE(wait_until_running(axis)) << axis.err();
  ASSERT_TRUE(runs_reach("axis", 300));
  Program& alone = on("b", {INDUROP_PROGRAM, "get", "station::target", "--remote", "--wait", "1s"});
  EXPECT_EQ(alone.wait(), 6) << alone.out();
  EXPECT_CONTAINS(alone.err(), "--peer");
  Program& looks = on("b", {INDUROP_PROGRAM, "get", "station::target", "--remote", "--peer", "10.77.0.1"});
  EXPECT_EQ(looks.wait(), 0) << looks.err();
  EXPECT_EQ(looks.out(), "100\n");
}

}  // namespace
}  // namespace indurop::test
