// SPDX-License-Identifier: Apache-2.0
// Thread modules that throw, crash, hang or overflow their stack: named, shut out, their fail-safe values written, and
// the other modules keep their ticks.

#include <algorithm>
#include <csignal>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "node_fixture.h"

namespace indurop::test {
namespace {

using scheduler::ModuleState;

struct Fault {
  const char* name;
  const char* text;  // what the node says about it
};
void PrintTo(const Fault& fault, std::ostream* out) {
  *out << fault.name;
}

constexpr const char* kFailSafe = "<failsafe variable=\"nt::output\">-7</failsafe>";

class ThreadFaults : public NodeTest, public ::testing::WithParamInterface<Fault> {};

std::string short_budget(const std::string& fault) {
  return fault == "loop" ? "<budget>20ms</budget>" : "";
}

Module faulty(const std::string& fault, const std::string& at) {
  return {.file = "faulty.so",
          .name = "bad",
          .priority = 1,
          .properties = {{"fault", fault}, {"at", at}, {"after", "5"}},
          .more = kFailSafe + short_budget(fault)};
}

TEST_P(ThreadFaults, In_run_stops_only_the_module_itself) {
  SKIP_CRASHES_UNDER_TSAN();
  Program& sut =
      start_and_wait({faulty(GetParam().name, "run"), {.file = "counter.so", .name = "good", .priority = 2}});
  const auto& bad = module("bad");
  ASSERT_TRUE(wait_until([&] { return bad.faults.load() == 1; }));
  const auto before = module("good").runs.load();
  EXPECT_TRUE(runs_reach("good", before + 50));
  EXPECT_EQ(bad.runs.load(), 6U) << "five good runs and the bad one";
  EXPECT_EQ(bad.state.load(), ModuleState::Faulted);
  EXPECT_EQ(value<std::int32_t>("nt::output"), -7);
  EXPECT_TRUE(sut.says("module bad faulted at tick"));
  EXPECT_TRUE(sut.says(GetParam().text));
  sut.signal(SIGTERM);
  EXPECT_EQ(sut.wait(), 1);
  EXPECT_TRUE(sut.says("1 module faulted during the run"));
}

TEST_P(ThreadFaults, In_a_slower_band_leave_the_basic_period_alone) {
  SKIP_CRASHES_UNDER_TSAN();
  Module slow = faulty(GetParam().name, "run");
  slow.period = "5ms";
  slow.priority = 2;
  Program& sut = start_and_wait({{.file = "counter.so", .name = "good"}, slow});
  ASSERT_TRUE(wait_until([&] { return module("bad").faults.load() == 1; }));
  EXPECT_TRUE(runs_reach("good", module("good").runs.load() + 50));
  EXPECT_TRUE(sut.says(GetParam().text));
  EXPECT_EQ(value<std::int32_t>("nt::output"), -7);
}

TEST_P(ThreadFaults, In_stop_are_named_and_the_other_modules_still_stop) {
  SKIP_CRASHES_UNDER_TSAN();
  const auto sut = run_to_end({faulty(GetParam().name, "stop"), {.file = "counter.so", .name = "good", .priority = 2}},
                              {"--duration", "20ms"});
  EXPECT_EQ(sut.code, 1);
  EXPECT_CONTAINS(sut.err, std::string("stop() failed: ") + GetParam().text);
  EXPECT_CONTAINS(sut.out, "counter stops after");
}

TEST_P(ThreadFaults, In_start_end_the_node_before_anything_ran) {
  SKIP_CRASHES_UNDER_TSAN();
  if (std::string(GetParam().name) == "loop") {
    GTEST_SKIP() << "start() may take its time; see the tests of signals";
  }
  const auto sut =
      run_to_end({faulty(GetParam().name, "start"), {.file = "counter.so", .name = "good", .priority = 2}});
  EXPECT_EQ(sut.code, 1);
  EXPECT_CONTAINS(sut.err, std::string("start() failed: ") + GetParam().text);
  EXPECT_CONTAINS(sut.err, "nothing was run");
  EXPECT_EQ(module("good").runs.load(), 0U);
}

INSTANTIATE_TEST_SUITE_P(Node, ThreadFaults,
                         ::testing::Values(Fault{"throw", "exception: out of ink"},
                                           Fault{"throw-number", "exception of an unknown type"},
                                           Fault{"segv", "SIGSEGV (invalid memory access) at address 0x10"},
                                           Fault{"fpe", "SIGFPE"}, Fault{"abort", "SIGABRT"},
                                           Fault{"stack", "stack overflow"}, Fault{"loop", "did not return within"}),
                         [](const auto& test) {
                           std::string name = test.param.name;
                           std::replace(name.begin(), name.end(), '-', '_');
                           return name;
                         });

using ThreadFault = NodeTest;

TEST_F(ThreadFault, Of_many_modules_in_one_node_are_each_contained) {
  SKIP_CRASHES_UNDER_TSAN();
  std::vector<Module> modules = {{.file = "counter.so", .name = "good", .priority = 1}};
  int priority = 2;
  for (const char* fault : {"throw", "segv", "fpe", "abort", "stack", "loop", "throw-number"}) {
    Module bad = faulty(fault, "run");
    bad.name = fault;
    bad.more = short_budget(fault);
    bad.period = priority % 2 == 0 ? "1ms" : "2ms";
    bad.priority = priority++;
    modules.push_back(bad);
  }
  Program& sut = start_and_wait(modules);
  for (std::size_t i = 1; i < modules.size(); ++i) {
    const auto& record = module(modules[i].name);
    EXPECT_TRUE(wait_until([&] { return record.state.load() == ModuleState::Faulted; })) << modules[i].name;
  }
  EXPECT_TRUE(runs_reach("good", module("good").runs.load() + 50));
  EXPECT_TRUE(sut.running());
  sut.signal(SIGINT);
  EXPECT_EQ(sut.wait(), 130);
}

TEST_F(ThreadFault, In_a_thread_of_its_own_is_contained_where_the_module_asked_for_it) {
  SKIP_CRASHES_UNDER_TSAN();
  Program& sut = start_and_wait({{.file = "thread_crash.so", .name = "bad"}, {.file = "counter.so", .name = "good"}});
  ASSERT_TRUE(wait_until([&] { return module("bad").faults.load() == 1 || !sut.running(); }));
  EXPECT_CONTAINS(std::string(module("bad").last_fault), "SIGSEGV (invalid memory access) at address 0x10");
  EXPECT_TRUE(runs_reach("good", module("good").runs.load() + 50));
  sut.signal(SIGTERM);
  EXPECT_EQ(sut.wait(), 1);
}

TEST_F(ThreadFault, In_a_shared_function_ends_its_service_and_not_the_node) {
  SKIP_CRASHES_UNDER_TSAN();
  Program& sut = start_and_wait({{.file = "server.so", .name = "server", .properties = {{"good_calls", "5"}}},
                                 {.file = "caller.so", .name = "caller", .period = "5ms", .priority = 2}});
  ASSERT_TRUE(wait_until([&] { return value<std::uint32_t>("nt::failures") >= 5 || !sut.running(); }));
  EXPECT_EQ(value<std::uint32_t>("nt::answers"), 5U);
  EXPECT_TRUE(sut.prints("shared function nt::add crashed with signal 11"));
  EXPECT_TRUE(runs_reach("caller", module("caller").runs.load() + 50));
  sut.signal(SIGTERM);
  EXPECT_EQ(sut.wait(), 0);
}

TEST_F(ThreadFault, Shows_in_status_and_report) {
  SKIP_CRASHES_UNDER_TSAN();
  const std::string report = folder() / "r.json";
  Program& sut = start_and_wait({faulty("throw", "run")}, {"--report", report});
  ASSERT_TRUE(wait_until([&] { return module("bad").state.load() == ModuleState::Faulted; }));
  const auto status = indurop({"status", "-o", "json"});
  EXPECT_EQ(status.code, 0);
  const auto now = nlohmann::json::parse(status.out);
  EXPECT_EQ(now["modules"][0]["state"], "faulted");
  EXPECT_CONTAINS(now["modules"][0]["last_fault"].get<std::string>(), "out of ink");
  sut.signal(SIGTERM);
  EXPECT_EQ(sut.wait(), 1);
  const auto end = nlohmann::json::parse(std::ifstream(report));
  EXPECT_EQ(end["modules"][0]["state"], "faulted");
  EXPECT_EQ(end["modules"][0]["faults"], 1);
  EXPECT_EQ(end["modules"][0]["last_fault"]["text"], "exception: out of ink");
}

TEST_F(ThreadFault, Ends_the_node_if_its_policy_says_so) {
  SKIP_CRASHES_UNDER_TSAN();
  Module bad = faulty("throw", "run");
  bad.more += "<overrun>stop-node</overrun>";
  const auto sut = run_to_end({bad, {.file = "counter.so", .name = "good", .priority = 2}});
  EXPECT_EQ(sut.code, 1);
  EXPECT_CONTAINS(sut.err, "module bad: faulted (policy stop-node)");
  EXPECT_CONTAINS(sut.out, "counter stops after");
}

TEST_F(ThreadFault, In_condition_shuts_out_a_sporadic_module) {
  SKIP_CRASHES_UNDER_TSAN();
  Program& sut = start_and_wait(
      {{.file = "counter.so", .name = "good"}, {.file = "bad_condition.so", .name = "bad", .operation = "sporadic"}});
  ASSERT_TRUE(wait_until([&] { return module("bad").faults.load() == 1; }));
  EXPECT_TRUE(runs_reach("good", module("good").runs.load() + 50));
  EXPECT_TRUE(sut.says("exception: no idea"));
}

}  // namespace
}  // namespace indurop::test
