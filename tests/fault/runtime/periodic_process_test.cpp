// SPDX-License-Identifier: Apache-2.0
// A periodic process with nodes that come, go, are replaced and do not fit.

#include <gtest/gtest.h>
#include <indurop/generated.h>
#include <indurop/indurop.h>

#include "hosted_program.h"
#include "store/runtime/message_ring.h"
#include "store/vars/process.h"
#include "test_node.h"

namespace {

using indurop::scheduler::ModuleType;
using indurop::test::Program;
using indurop::testing::hosted_program;
using indurop::testing::sample_schema;
using indurop::testing::TestModule;
using indurop::testing::TestNode;
using indurop::testing::wait_until;

std::vector<TestModule> one_process() {
  return {{"other", {}, 0, {}, ""}, {"cntr4.exe", ModuleType::Process, 500'000, {{"gain", "2.5"}}, PERIODIC_PROGRAM}};
}

std::uint32_t tick_of(TestNode& node) {
  std::uint32_t value = 0;
  const auto* entry = node.store().find(indurop::abi::fnv1a64("knu::Robot::tick", 16));
  EXPECT_TRUE(node.store().read(*entry, 0, {reinterpret_cast<std::uint8_t*>(&value), sizeof value}));
  return value;
}

void launched(TestNode& node, const Program& child) {
  node.module(1).pid = child.pid();
}
bool enrolled(TestNode& node, const Program& child) {
  return wait_until([&] { return node.slot(1).pid == child.pid(); });
}
bool done(TestNode& node) {
  return wait_until([&] { return node.slot(1).done == node.slot(1).released; });
}
void stop(TestNode& node) {
  node.slot(1).stop = 1;
  node.slot(1).wake.wake();
}

TEST(PeriodicProcess, Runs_once_per_release_and_ends_when_asked) {
  TestNode node(one_process());
  Program child = hosted_program(PERIODIC_PROGRAM, node.name(), "1");
  ASSERT_TRUE(enrolled(node, child)) << child.out();
  for (std::uint64_t i = 1; i <= 3; ++i) {
    node.release(1, i * 5, static_cast<std::int64_t>(i) * 1000);
    ASSERT_TRUE(done(node));
    EXPECT_EQ(tick_of(node), 7 + i);
    EXPECT_GT(node.slot(1).start_ns, 0);
    EXPECT_GE(node.slot(1).end_ns, node.slot(1).start_ns);
  }
  stop(node);
  EXPECT_EQ(child.wait(), 0);
  EXPECT_EQ(child.out(), "initPeriodExe 0 gain 2.5\n");
  indurop::runtime::MessageReader reader(node.run());
  indurop::runtime::Message message;
  ASSERT_TRUE(reader.next(message, {}));
  EXPECT_EQ(message.text, "run 8\n");
  EXPECT_EQ(message.module, 1U);
}

TEST(PeriodicProcess, That_loops_for_ever_is_ended) {
  TestNode node(one_process());
  Program child = hosted_program(PERIODIC_PROGRAM, node.name(), "1", {"endless"});
  ASSERT_TRUE(enrolled(node, child)) << child.out();
  stop(node);
  EXPECT_EQ(child.wait(), 0);
}

TEST(PeriodicProcess, Finds_its_module_by_its_file) {
  TestNode node(one_process());
  Program child = hosted_program(PERIODIC_PROGRAM, node.name(), "");
  EXPECT_TRUE(enrolled(node, child)) << child.out();
}

TEST(PeriodicProcess, Started_before_the_node_waits_for_it) {
  const std::string name = TestNode::next_name();
  Program child = hosted_program(PERIODIC_PROGRAM, name, "");
  ASSERT_TRUE(child.prints("initPeriodExe -2"));
  EXPECT_NE(child.out().find("node '" + name + "' is not running; start it with: indurop run module.xml"),
            std::string::npos)
      << child.out();
  TestNode node(one_process());
  ASSERT_EQ(node.name(), name);
  ASSERT_TRUE(enrolled(node, child)) << child.out();
  node.release(1);
  ASSERT_TRUE(done(node));
  EXPECT_EQ(tick_of(node), 8U);
}

TEST(PeriodicProcess, Of_a_module_that_runs_already_is_refused) {
  TestNode node(one_process());
  Program first = hosted_program(PERIODIC_PROGRAM, node.name(), "1");
  ASSERT_TRUE(enrolled(node, first));
  Program second = hosted_program(PERIODIC_PROGRAM, node.name(), "1");
  EXPECT_EQ(second.wait(), 1);
  EXPECT_NE(
      second.out().find("module 'cntr4.exe' of node '" + node.name() + "' is process " + std::to_string(first.pid())),
      std::string::npos)
      << second.out();
  EXPECT_TRUE(first.running());
}

// A node that is delayed after it has launched a process does not know its id when the process asks.
TEST(PeriodicProcess, That_is_to_follow_another_one_waits_until_the_node_knows_it) {
  TestNode node(one_process());
  Program first = hosted_program(PERIODIC_PROGRAM, node.name(), "1");
  ASSERT_TRUE(enrolled(node, first));
  node.slot(1).successor = indurop::scheduler::kBeingLaunched;
  Program second = hosted_program(PERIODIC_PROGRAM, node.name(), "1");
  EXPECT_FALSE(wait_until([&] { return !second.running() || !second.out().empty(); }, std::chrono::milliseconds(300)))
      << second.out();
  node.slot(1).successor = second.pid();
  EXPECT_TRUE(second.prints("initPeriodExe 0"));
  EXPECT_TRUE(wait_until([&] { return node.slot(1).ready == second.pid(); }));
  EXPECT_TRUE(first.running());
}

TEST(PeriodicProcess, Whose_variables_do_not_fit_refuses_to_run) {
  auto schema = sample_schema();
  auto& tick = schema.variables[0];
  ASSERT_EQ(tick.name, "knu::Robot::tick");
  tick.type.base = indurop::schema::Base::UInt16;
  tick.type.element_size = tick.type.align = 2;
  tick.initial.clear();
  tick.type_hash = hash_of(tick.type);
  TestNode node(one_process(), schema);
  Program child = hosted_program(PERIODIC_PROGRAM, node.name(), "1");
  EXPECT_EQ(child.wait(), 8);
  EXPECT_NE(child.out().find("initPeriodExe -10"), std::string::npos) << child.out();
  EXPECT_NE(child.out().find("variable knu::Robot::tick: this program was built with uint32_t (4 bytes), node '" +
                             node.name() + "' has uint16_t (2 bytes)"),
            std::string::npos)
      << child.out();
}

TEST(PeriodicProcess, Does_not_mind_variables_its_code_never_uses) {
  auto schema = sample_schema();
  schema.variables.pop_back();  // ready
  TestNode node(one_process(), schema);
  Program child = hosted_program(PERIODIC_PROGRAM, node.name(), "1");
  EXPECT_TRUE(enrolled(node, child)) << child.out();
  EXPECT_EQ(child.out(), "initPeriodExe 0 gain 2.5\n");
}

TEST(PeriodicProcess, Outlives_its_node_and_enrols_with_the_next) {
  TestNode node(one_process());
  Program child = hosted_program(PERIODIC_PROGRAM, node.name(), "1");
  ASSERT_TRUE(enrolled(node, child)) << child.out();
  node.run().node_pid = indurop::test::dead_pid();
  ASSERT_TRUE(child.prints("has ended; waiting for it to start again"));
  // Another layout, so the variables move to another block too.
  auto schema = sample_schema();
  schema.variables.pop_back();
  node.restart(schema, one_process());
  ASSERT_TRUE(enrolled(node, child)) << child.out();
  node.release(1);
  ASSERT_TRUE(done(node));
  EXPECT_EQ(tick_of(node), 8U);
  stop(node);
  EXPECT_EQ(child.wait(), 0);
}

TEST(PeriodicProcess, Left_over_from_a_dead_node_gives_way_to_the_next_nodes_own) {
  TestNode node(one_process());
  Program child = hosted_program(PERIODIC_PROGRAM, node.name(), "1");
  ASSERT_TRUE(enrolled(node, child)) << child.out();
  node.run().node_pid = indurop::test::dead_pid();
  ASSERT_TRUE(child.prints("has ended; waiting"));
  Program fresh = hosted_program("/bin/sleep", node.name(), "1", {"1000"});
  node.restart(sample_schema(), one_process());
  launched(node, fresh);
  EXPECT_EQ(child.wait(), 0) << child.out();
  EXPECT_NE(child.out().find("is process " + std::to_string(fresh.pid())), std::string::npos) << child.out();
}

TEST(PeriodicProcess, Killed_in_its_run_is_followed_by_a_clean_one) {
  TestNode node(one_process());
  for (int i = 0; i < 5; ++i) {
    Program child = hosted_program(PERIODIC_PROGRAM, node.name(), "1");
    ASSERT_TRUE(enrolled(node, child)) << child.out();
    ASSERT_TRUE(done(node));
    node.release(1);
    child.kill();
    node.slot(1).pid = 0;
  }
}

}  // namespace
