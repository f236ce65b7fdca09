// SPDX-License-Identifier: Apache-2.0
// A running node and the programs of examples/external: Cyclone DDS in C, Fast DDS in C++, both generated from the IDL.

#include <csignal>

#include "live.h"

namespace indurop::test {
namespace {

TEST_F(Live, A_Cyclone_program_sees_the_state) {
  start_axis();
  expect_samples(tool({"watch_cyclone", domain(), "5"}), 5);
}

TEST_F(Live, A_killed_reader_disturbs_no_other_program) {
  Program& node = start_axis();
  Program& first = tool({"watch_cyclone", domain()});
  Program& second = tool({"watch_cyclone", domain()});
  ASSERT_TRUE(wait_until([&] { return lines(first) > 3 && lines(second) > 3; })) << first.err();
  for (int i = 0; i < 5; ++i) {
    Program& victim = tool({"watch_cyclone", domain()});
    ASSERT_TRUE(wait_until([&] { return lines(victim) > 1; }));
    victim.kill();
    const std::size_t before = lines(second);
    ASSERT_TRUE(wait_until([&] { return lines(second) > before + 5; }));
  }
  first.signal(SIGSTOP);  // reads nothing any more, but is still there
  const std::size_t before = lines(second);
  EXPECT_TRUE(wait_until([&] { return lines(second) > before + 50; }));
  first.kill();
  EXPECT_EQ(module("axis").faults.load(), 0U);
  node.signal(SIGTERM);
  EXPECT_EQ(node.wait(), 0);
  EXPECT_TRUE(second.prints("publishes station/state any more"));
}

TEST_F(Live, A_node_that_comes_back_is_heard_again) {
  Program& watch = tool({"watch_cyclone", domain()});
  Program& node = start_axis();
  ASSERT_TRUE(wait_until([&] { return lines(watch) > 3; }));
  node.kill();
  ASSERT_EQ(node.wait(), 128 + SIGKILL);
  const std::size_t before = lines(watch);
  start_axis();
  EXPECT_TRUE(wait_until([&] { return lines(watch) > before + 5; }));
}

TEST_F(Live, Types_of_another_glb_are_named_and_the_modules_run) {
  Program& sut = start_file(configuration(STRANGE_TYPES), {"--node", node()});
  ASSERT_TRUE(wait_until_running(sut));
  EXPECT_TRUE(sut.says("was built from another .glb than the modules: station::State has 16 bytes there"));
  EXPECT_TRUE(sut.says("no types library has the type of station::limit"));
  EXPECT_TRUE(wait_until([&] { return block() != nullptr && block()->topics == 1; })) << "the one that fits";
  EXPECT_TRUE(runs_reach("axis", 20));
  sut.signal(SIGTERM);
  EXPECT_EQ(sut.wait(), 0);
}

TEST_F(Live, Status_tells_who_reads) {
  start_axis();
  Program& watch = tool({"watch_cyclone", domain()});
  ASSERT_TRUE(wait_until([&] { return lines(watch) > 0; }));
  EXPECT_TRUE(wait_until([&] {
    return contains(indurop({"status", "--node", node()}).out,
                    "DDS domain " + domain() + ", 3 topics, 1 with readers, 1 can be set");
  })) << indurop({"status", "--node", node()}).out;
}

// Each variable by the board that owns it: no board writes target and limit, the first board that reads them has them.
TEST_F(Live, Boards_of_a_plant_show_what_they_own) {
  const std::string module = "<module><filename>" EXAMPLE_FOLDER
                             "/axis.so</filename><moduletype>thread</moduletype><operationtype>periodic"
                             "</operationtype><period>1ms</period><priority>1</priority></module>";
  const std::string plant = write(
      "plant.xml", "<plant name=\"" + node() + "\"><domain>" + std::to_string(dds_domain(1)) + "</domain><external>" +
                       domain() +
                       "</external><types>" EXAMPLE_FOLDER
                       "/libstation_types.so</types><variable name=\"station::target\" external=\"write\"/><variable "
                       "name=\"station::limit\" external=\"off\"/><board name=\"empty\"/><board name=\"" +
                       node() + "\">" + module + "</board></plant>");
  Program& sut = start_file(plant, {"--node", node(), "--board", node(), "--one-host"});
  ASSERT_TRUE(wait_until_running(sut)) << sut.err();
  ASSERT_TRUE(wait_until([&] { return block() != nullptr && block()->network.load() == mirror::Network::Up; }));
  EXPECT_EQ(block()->topics, 2U) << "state and target, limit is off";
  EXPECT_EQ(block()->writable, 1U);
  const std::string other = node() + "e";
  Program& idle = start_file(plant, {"--node", other, "--board", "empty", "--one-host"});
  EXPECT_TRUE(idle.says("0 variables for other tools"));
  EXPECT_TRUE(runs_reach("axis", 300));
  expect_samples(tool({"watch_cyclone", domain(), "3"}), 3);
  idle.signal(SIGTERM);
  EXPECT_EQ(idle.wait(), 0);
  EXPECT_EQ(indurop({"clean", "--node", other}).code, 0);
}

TEST_F(Network, Programs_on_another_machine_see_and_set_variables_without_any_setting) {
  if (!up()) {
    GTEST_SKIP() << "network namespaces cannot be made here (root and iproute2 are needed)";
  }
  Program& axis = on("a", {NODE_PROGRAM, EXAMPLE_FOLDER "/module.xml", "--node", node()});
  ASSERT_TRUE(wait_until_running(axis)) << axis.err();
  ASSERT_TRUE(runs_reach("axis", 300));
  expect_samples(on("b", {EXAMPLE_FOLDER "/watch_cyclone", "0", "3"}), 3);
#ifdef WITH_FASTDDS
  expect_samples(on("b", {EXAMPLE_FOLDER "/watch_fastdds", "0", "3"}), 3);
  Program& set = on("b", {EXAMPLE_FOLDER "/set_fastdds", "42.5", "0"});
  EXPECT_EQ(set.wait(), 0) << set.out() << set.err();
  EXPECT_CONTAINS(get("station::target"), "42.5");
#endif
}

#ifdef WITH_FASTDDS
TEST_F(Live, A_Fast_DDS_program_sees_the_state) {
  start_axis();
  expect_samples(tool({"watch_fastdds", domain(), "5"}), 5);
  // A participant that joins when the axis is at standstill.
  ASSERT_TRUE(wait_until([&] { return contains(get("station::state.mode"), "ARRIVED"); }));
  expect_samples(tool({"watch_fastdds", domain(), "1"}), 1);
}

TEST_F(Live, A_Fast_DDS_program_sets_the_target_within_its_range) {
  start_axis();
  Program& good = tool({"set_fastdds", "42.5", domain()});
  EXPECT_EQ(good.wait(), 0) << good.out() << good.err();
  EXPECT_CONTAINS(get("station::target"), "42.5");
  Program& bad = tool({"set_fastdds", "501", domain()});
  EXPECT_EQ(bad.wait(), 3) << bad.out() << bad.err();
  EXPECT_CONTAINS(bad.out(), "target is 42.500 mm");
  EXPECT_CONTAINS(get("station::target"), "42.5");
  EXPECT_GE(block()->refused.load(), 1U);
  EXPECT_CONTAINS(block()->problem.get(), "station::target from outside is rejected: 501 is outside 0..500");
}
#else
TEST_F(Live, Fast_DDS_programs) {
  GTEST_SKIP() << "fastddsgen or libfastrtps-dev is not installed";
}
#endif

}  // namespace
}  // namespace indurop::test
