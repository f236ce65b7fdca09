// SPDX-License-Identifier: Apache-2.0
// indurop-node --sim: virtual time, the same on every run.

#include <csignal>
#include <fstream>
#include <nlohmann/json.hpp>

#include "node_fixture.h"

namespace indurop::test {
namespace {

class Simulation : public NodeTest {
 protected:
  nlohmann::json report() const { return nlohmann::json::parse(std::ifstream(folder() / "r.json")); }
  // Its report and all values, after so much virtual time.
  std::string everything(const std::string& file, const std::string& time) {
    Program& sut = start_file(file, {"--sim", "--until", time, "--report", folder() / "r.json"});
    EXPECT_EQ(sut.wait(), 0) << sut.err();
    auto measured = report();
    measured.erase("started");
    return measured.dump(1) + indurop({"vars", "-o", "json"}).out;
  }
};

TEST_F(Simulation, Of_the_chapters_example_is_the_same_on_every_run) {
  const std::string file = std::string(EXAMPLE_DIR) + "/module.xml";
  if (!std::filesystem::exists(file)) {
    GTEST_SKIP() << "the examples are not built";
  }
  // Threads, a periodic and a sporadic process, an event, and a sporadic thread.
  const std::string first = everything(file, "3s");
  EXPECT_EQ(run()->tick.load(), 30'000U);
  EXPECT_EQ(run()->lost_ticks.load(), 0U);
  EXPECT_EQ(module("cntr4").runs.load(), 6'000U) << "a process";
  EXPECT_GT(module("event1").runs.load(), 0U);
  EXPECT_EQ(first, everything(file, "3s"));
}

TEST_F(Simulation, Takes_as_long_as_wcet_says_and_shows_overruns_that_are_not_there_in_real_time) {
  const std::vector<Module> modules = {
      {.file = "counter.so", .name = "fast", .priority = 1, .more = "<wcet>300us</wcet>"},
      {.file = "label.so", .name = "slow", .period = "10ms", .priority = 2, .more = "<wcet>5ms</wcet>"}};
  const Outcome fits = run_to_end(modules, {"--sim", "--duration", "1s", "--report", folder() / "r.json"});
  EXPECT_EQ(fits.code, 0) << fits.err;
  const auto slow = report()["modules"][1];
  EXPECT_EQ(slow["exec_ns"]["max"], 7'100'000) << "preempted seven times: 5 ms and 7 x 300 us";
  EXPECT_EQ(slow["response_ns"]["max"], 7'400'000);
  EXPECT_EQ(slow["overruns"], 0);
  // Measured by another run: 8 ms in addition to 30 % of load do not fit into 10 ms.
  auto measured = report();
  measured["modules"][1]["exec_ns"]["max"] = 8'000'000;
  const std::string file = write("longer.json", measured.dump());
  std::vector<Module> undeclared = modules;
  undeclared[1].more.clear();
  const Outcome over = run_to_end(undeclared, {"--sim", "--duration", "1s", "--times", file});
  EXPECT_EQ(over.code, 0) << over.err;
  EXPECT_GT(module("slow").overruns.load(), 30U);
  EXPECT_EQ(module("fast").overruns.load(), 0U);
}

TEST_F(Simulation, Stands_after_each_tick_and_goes_on_as_standard_input_says) {
  Program& sut = start({{.file = "counter.so", .name = "one"}}, {"--sim", "--step"});
  ASSERT_TRUE(sut.prints("tick 0, "));
  sut.input("\n");
  ASSERT_TRUE(sut.prints("tick 1, 1 ms"));
  EXPECT_EQ(module("one").runs.load(), 1U);
  sut.input("10\n");
  ASSERT_TRUE(sut.prints("tick 11, 11 ms"));
  sut.input("20ms\nwhat\n");
  ASSERT_TRUE(sut.prints("tick 31, 31 ms"));
  EXPECT_TRUE(sut.says("'what' is not understood"));
  EXPECT_EQ(module("one").runs.load(), 31U);
  sut.input("q\n");
  EXPECT_EQ(sut.wait(), 0);
}

TEST_F(Simulation, Starts_a_process_that_died_again_after_its_virtual_delay) {
  const auto restarts = [&] {
    Program& sut = start(
        {{.file = "process.exe",
          .name = "dies",
          .type = "process",
          .more =
              "<argument>die</argument><argument>100</argument><restart delay=\"50ms\" max=\"100\" window=\"1min\"/>"}},
        {"--sim", "--duration", "10s"});
    EXPECT_EQ(sut.wait(), 0) << sut.err();
    return std::pair(module("dies").restarts.load(), module("dies").runs.load());
  };
  const auto first = restarts();
  EXPECT_GT(first.first, 10U);
  EXPECT_EQ(first, restarts());
}

TEST_F(Simulation, Ends_a_module_that_does_not_return) {
  SKIP_CRASHES_UNDER_TSAN();
  Program& sut = start({{.file = "faulty.so", .name = "stuck", .properties = {{"fault", "loop"}, {"after", "4"}}},
                        {.file = "counter.so", .name = "next", .priority = 2}},
                       {"--sim"});
  ASSERT_TRUE(wait_until_running(sut));
  ASSERT_TRUE(runs_reach("next", 4));
  sut.signal(SIGINT);
  sut.wait();
  EXPECT_EQ(module("stuck").state.load(), scheduler::ModuleState::Faulted);
  EXPECT_STREQ(module("stuck").last_fault, "did not return");
}

TEST_F(Simulation, Keeps_time_with_the_real_clock_on_request) {
  Program& sut = start({{.file = "counter.so", .name = "one"}}, {"--sim", "--speed", "2"});
  ASSERT_TRUE(wait_until_running(sut));
  const auto began = std::chrono::steady_clock::now();
  const std::uint64_t before = module("one").runs.load();
  ASSERT_TRUE(runs_reach("one", before + 400));
  EXPECT_GE(std::chrono::steady_clock::now() - began, std::chrono::milliseconds(150)) << "400 ms of virtual time";
  sut.signal(SIGTERM);
  EXPECT_EQ(sut.wait(), 0);
}

TEST_F(Simulation, Check_names_what_it_cannot_repeat) {
  const std::string file = write(
      "chance.xml", xml({{.file = "counter.so", .name = "plain"},
                         {.file = "process.exe", .name = "background", .type = "process", .operation = "non-real"}}));
  const Outcome notes = indurop({"check", "--sim", file});
  EXPECT_EQ(notes.code, 0) << notes.err;
  EXPECT_CONTAINS(notes.out + notes.err, "module background: it runs outside the schedule, at any time");
  EXPECT_FALSE(contains(notes.out + notes.err, "module plain:"));
  const Outcome none = indurop({"check", file});
  EXPECT_FALSE(contains(none.out + none.err, "module background:"));
}

TEST_F(Simulation, Refuses_what_makes_no_sense) {
  const std::vector<Module> modules = {{.file = "counter.so", .name = "one"}};
  EXPECT_EQ(run_to_end(modules, {"--speed", "2"}).code, 2) << "without --sim";
  const Outcome speed = run_to_end(modules, {"--sim", "--speed", "fast"});
  EXPECT_EQ(speed.code, 2);
  EXPECT_CONTAINS(speed.err, "'fast' is not a speed: use max");
  const Outcome times = run_to_end(modules, {"--sim", "--times", folder() / "none.json"});
  EXPECT_EQ(times.code, 2);
  EXPECT_CONTAINS(times.err, "none.json");
}

}  // namespace
}  // namespace indurop::test
