// SPDX-License-Identifier: Apache-2.0
// What a module gets from its node: its properties, globals of its own, its text on the terminal, signals for programs
// that know nothing of us.

#include <csignal>
#include <fstream>
#include <nlohmann/json.hpp>

#include "node_fixture.h"

namespace indurop::test {
namespace {

using Modules = NodeTest;

TEST_F(Modules, Of_one_file_have_their_own_properties_and_globals) {
  std::vector<Module> modules;
  for (int i = 1; i <= 5; ++i) {
    const std::string name = "m" + std::to_string(i);
    modules.push_back(
        {.file = "label.so", .name = name, .priority = i, .properties = {{"label", name}, {"add", std::to_string(i)}}});
  }
  Program& sut = start_and_wait(modules);
  for (int i = 1; i <= 5; ++i) {
    const std::string text = "m" + std::to_string(i) + " has " + std::to_string(10 * i) + "\n";
    EXPECT_TRUE(sut.prints(text)) << text;
  }
  sut.signal(SIGTERM);
  EXPECT_EQ(sut.wait(), 0);
  for (int i = 1; i <= 5; ++i) {
    EXPECT_CONTAINS(sut.out(), "m" + std::to_string(i) + " ends with " + std::to_string(10 * i) + "\n");
  }
}

TEST_F(Modules, Printing_too_much_is_dropped_counted_and_said) {
  const auto sut = run_to_end({{.file = "flood.so", .name = "flood", .period = "20ms"}},
                              {"--duration", "400ms", "--report", folder() / "r.json"});
  EXPECT_EQ(sut.code, 0);
  EXPECT_CONTAINS(sut.out, "flood 1\n");
  EXPECT_CONTAINS(sut.err, "lines of irp::printf dropped, its ring was full");
  const auto report = nlohmann::json::parse(std::ifstream(folder() / "r.json"));
  EXPECT_GT(report["modules"][0]["lost_messages"].get<std::uint64_t>(), 0U);
  std::uint64_t lines = 0;
  for (std::size_t at = sut.out.find("flood "); at != std::string::npos && std::isdigit(sut.out[at + 6]) != 0;
       at = sut.out.find("flood ", at + 1)) {
    ++lines;
  }
  EXPECT_EQ(lines + report["modules"][0]["lost_messages"].get<std::uint64_t>(),
            report["modules"][0]["runs"].get<std::uint64_t>() * 2000);
}

TEST_F(Modules, Quiet_node_still_shows_what_modules_print) {
  const auto sut = run_to_end({{.file = "counter.so", .name = "counter"}}, {"--duration", "20ms", "--quiet"});
  EXPECT_EQ(sut.code, 0);
  EXPECT_CONTAINS(sut.out, "counter stops after");
  EXPECT_THAT(sut.out, ::testing::Not(::testing::HasSubstr("jit p50")));
  EXPECT_THAT(sut.err, ::testing::Not(::testing::HasSubstr("stopped:")));
}

TEST_F(Modules, Legacy_program_is_woken_by_its_signal) {
  const std::string file = folder() / "wakes";
  Program& sut = start_and_wait({{.file = "counter.so", .name = "counter"},
                                 {.file = "legacy.exe",
                                  .name = "legacy",
                                  .type = "process",
                                  .period = "5ms",
                                  .priority = 2,
                                  .more = "<argument>" + file + "</argument><signal>SIGUSR1</signal>"}});
  const auto wakes = [&] {
    int number = 0;
    std::ifstream(file) >> number;
    return number;
  };
  EXPECT_TRUE(wait_until([&] { return wakes() >= 20; }));
  EXPECT_GE(module("legacy").runs.load(), 20U);
  const pid_t pid = module("legacy").pid.load();
  sut.signal(SIGTERM);
  EXPECT_EQ(sut.wait(), 0);
  EXPECT_FALSE(alive(pid));
}

TEST_F(Modules, Legacy_program_that_starts_slowly_is_not_killed_by_the_signal_that_is_to_wake_it) {
  const std::string file = folder() / "wakes";
  start_and_wait({{.file = "counter.so", .name = "counter"},
                  {.file = "legacy.exe",
                   .name = "legacy",
                   .type = "process",
                   .period = "5ms",
                   .priority = 2,
                   .more = "<argument>" + file + "</argument><argument>800</argument><signal>SIGUSR1</signal>"}});
  EXPECT_TRUE(wait_until([&] { return module("legacy").runs.load() >= 20; }));
  EXPECT_EQ(module("legacy").faults.load(), 0U);
}

TEST_F(Modules, Of_a_process_share_variables_with_those_of_threads) {
  Program& sut = start_and_wait({{.file = "writer.exe", .name = "writer", .type = "process", .priority = 1},
                                 {.file = "verify.so", .name = "verify", .priority = 2}});
  EXPECT_TRUE(wait_until([&] { return value<std::uint64_t>("nt::newest") > 5000; }));
  EXPECT_EQ(value<std::uint64_t>("nt::torn"), 0U);
  sut.signal(SIGTERM);
  EXPECT_EQ(sut.wait(), 0);
}

TEST_F(Modules, In_c_run_as_threads_and_processes) {
  Program& sut = start_and_wait({{.file = "c_thread.so", .name = "thread", .priority = 1},
                                 {.file = "c_process.exe",
                                  .name = "process",
                                  .type = "process",
                                  .period = "2ms",
                                  .priority = 2,
                                  .properties = {{"name", "left"}}}});
  EXPECT_TRUE(wait_until([&] { return value<std::uint64_t>("nt::newest") > 200; }));
  EXPECT_GE(value<std::int32_t>("nt::output"), 100);
  EXPECT_GE(value<std::uint32_t>("nt::process_runs"), 50U);
  EXPECT_TRUE(sut.prints("c_thread: 1.0 ms\n"));
  EXPECT_TRUE(sut.prints("c_process: left\n"));
  EXPECT_CONTAINS(indurop({"set", "nt::output", "5"}).err, "nt::output is written by thread too");
  sut.signal(SIGTERM);
  EXPECT_EQ(sut.wait(), 0);
  EXPECT_CONTAINS(sut.out(), "c_thread: " + std::to_string(module("thread").runs.load()) + " runs\n");
}

TEST_F(Modules, In_c_that_use_a_wrong_index_have_a_fault_that_names_the_variable) {
  start_and_wait({{.file = "counter.so", .name = "counter", .priority = 1},
                  {.file = "c_thread.so", .name = "thread", .priority = 2, .properties = {{"bad_run", "40"}}}});
  EXPECT_TRUE(wait_until([&] { return module("thread").faults.load() == 1; }));
  EXPECT_CONTAINS(std::string(module("thread").last_fault), "nt::block");
  const std::uint64_t before = module("counter").runs.load();
  EXPECT_TRUE(runs_reach("counter", before + 10));
}

TEST_F(Modules, Variables_are_seen_and_set_by_the_command_line) {
  Program& sut = start_and_wait({{.file = "counter.so", .name = "counter"}});
  ASSERT_TRUE(runs_reach("counter", 5));
  const auto set = indurop({"set", "nt::counted", "1000000"});
  EXPECT_EQ(set.code, 0);
  EXPECT_CONTAINS(set.err, "nt::counted is written by counter too");
  EXPECT_CONTAINS(set.err, "indurop force nt::counted=1000000");
  EXPECT_TRUE(wait_until([&] { return value<std::uint32_t>("nt::counted") > 1'000'000; }));
  const auto shown = indurop({"get", "nt::counted"});
  EXPECT_EQ(shown.code, 0);
  EXPECT_CONTAINS(shown.out, "1000");
  sut.signal(SIGTERM);
  EXPECT_EQ(sut.wait(), 0);
}

}  // namespace
}  // namespace indurop::test
