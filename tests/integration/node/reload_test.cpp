// SPDX-License-Identifier: Apache-2.0
// indurop reload: the code of a module is exchanged while the node runs.

#include <fmt/format.h>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <random>

#include "reload_fixture.h"

namespace indurop::test {
namespace {

using scheduler::ModuleState;
using scheduler::VersionState;

TEST_F(Reload, The_new_version_continues_and_no_run_is_left_out) {
  Program& sut = start_counting();
  EXPECT_GT(value<std::int64_t>("nt::walked"), 0);
  const Outcome done = reload({"counter", built("other"), "--health", "100ms"});
  EXPECT_EQ(done.code, 0) << done.out << done.err;
  EXPECT_CONTAINS(done.out, "kept      counted, filtered, history");
  EXPECT_CONTAINS(done.err, "exchanged, with what it keeps");
  EXPECT_CONTAINS(done.out, "version 2 runs since tick");
  EXPECT_LT(value<std::int64_t>("nt::walked"), 0);
  expect_all_counted();
  EXPECT_EQ(module("counter").faults.load(), 0U);
  EXPECT_GT(value<std::int32_t>("nt::output"), 0) << "its start() wrote to copies only";
  EXPECT_CONTAINS(indurop({"status", "--node", node()}).out, "exchanged counter: version 2");
  const auto json = indurop({"status", "--node", node(), "-o", "json"}).json();
  EXPECT_EQ(json["modules"][1]["version"], 2);
  EXPECT_EQ(json["modules"][1]["version_digest"].get<std::string>().size(), 64U);
  EXPECT_TRUE(sut.prints("starts, and sees what was walked"));
  sut.signal(SIGTERM);
  EXPECT_EQ(sut.wait(), 0) << sut.err();
}

TEST_F(Reload, Back_returns_to_the_previous_version_with_state) {
  start_counting();
  ASSERT_EQ(reload({"counter", built("other"), "--health", "0s"}).code, 0);
  EXPECT_LT(value<std::int64_t>("nt::walked"), 0);
  const Outcome back = reload({"counter", "--back"});
  EXPECT_EQ(back.code, 0) << back.err;
  EXPECT_CONTAINS(back.err, "the previous version runs again");
  EXPECT_GT(value<std::int64_t>("nt::walked"), 0);
  expect_all_counted();
  EXPECT_EQ(reload({"counter", "--back"}).code, 4) << "there is none any more";
}

TEST_F(Reload, A_version_that_throws_is_replaced_by_the_previous_one_with_the_state_before_that_run) {
  start_counting("same", "<failsafe variable=\"nt::output\">-7</failsafe>");
  const Outcome done = reload({"counter", built("throws"), "--health", "20s"});
  EXPECT_EQ(done.code, 5) << done.out << done.err;
  EXPECT_CONTAINS(done.err, "the previous version runs again: the new one faulted in tick");
  EXPECT_EQ(module("counter").state.load(), ModuleState::Running);
  EXPECT_EQ(module("counter").version_state.load(), VersionState::Returned);
  EXPECT_EQ(module("counter").faults.load(), 1U);
  EXPECT_GT(value<std::int64_t>("nt::walked"), 0);
  expect_all_counted(1);  // but the run that threw
  EXPECT_TRUE(counts_up_to(counted() + 50));
}

TEST_F(Reload, A_version_that_loops_is_ended_and_replaced) {
  SKIP_CRASHES_UNDER_TSAN();
  start_counting();
  const Outcome done = reload({"counter", built("loops"), "--health", "20s"});
  EXPECT_EQ(done.code, 5) << done.out << done.err;
  EXPECT_CONTAINS(done.err, "did not return");
  EXPECT_GT(value<std::int64_t>("nt::walked"), 0);
  EXPECT_TRUE(counts_up_to(counted() + 50));
  EXPECT_TRUE(wait_until([&] { return module("counter").kept_loaded.load() == 1U; }))
      << "its code was left in the middle";
}

TEST_F(Reload, A_version_that_overruns_is_replaced) {
  start_counting();
  const Outcome done = reload({"counter", built("overruns"), "--health", "20s"});
  EXPECT_EQ(done.code, 5) << done.out << done.err;
  EXPECT_TRUE(wait_until([&] { return value<std::int64_t>("nt::walked") > 0; }));
  EXPECT_EQ(module("counter").faults.load(), 0U);
}

// As by a variable of a shell script that is not set.
TEST_F(Reload, A_guard_or_a_shadow_that_is_nothing_is_refused) {
  start_counting();
  EXPECT_EQ(reload({"counter", built("other"), "--guard", ""}).code, 2);
  EXPECT_EQ(reload({"counter", built("other"), "--shadow", "0s"}).code, 2);
  EXPECT_EQ(module("counter").version.load(), 1U);
  expect_all_counted();
}

TEST_F(Reload, A_guard_that_does_not_hold_returns_the_previous_version) {
  start_counting();
  const Outcome done = reload({"counter", built("other"), "--health", "20s", "--guard", "walked > 0"});
  EXPECT_EQ(done.code, 5) << done.out << done.err;
  EXPECT_GT(value<std::int64_t>("nt::walked"), 0);
  expect_all_counted();
  const Outcome wrong = reload({"counter", built("other"), "--guard", "wlked > 0"});
  EXPECT_EQ(wrong.code, 4);
  EXPECT_CONTAINS(wrong.err, "walked");
}

TEST_F(Reload, What_cannot_run_is_refused_with_all_errors) {
  start_counting();
  struct Case {
    std::string file;
    std::vector<std::string> texts;
  };
  const std::vector<Case> cases = {
      {(std::filesystem::path(MODULE_DIR) / "other_abi.so").string(), {"ABI 4711", "module.xml:"}},
      {(std::filesystem::path(MODULE_DIR) / "undefined.so").string(), {"function_without_body"}},
      {(std::filesystem::path(MODULE_DIR) / "no_run.so").string(), {"run function"}},
      {(folder() / "absent.so").string(), {"no such file"}},
      {built("offers"), {"shared functions"}},
      {built("threads"), {"threads of its own"}},
      {built("more_access"), {"it writes variable nt::events"}},
      {(std::filesystem::path(MODULE_DIR) / "process.exe").string(), {"not a shared library"}}};
  for (const Case& one : cases) {
    const Outcome done = reload({"counter", one.file});
    EXPECT_EQ(done.code, 4) << one.file << done.out << done.err;
    for (const std::string& text : one.texts) {
      EXPECT_CONTAINS(done.err, text);
    }
  }
  EXPECT_EQ(module("counter").version.load(), 1U);
  expect_all_counted();
}

TEST_F(Reload, Values_that_would_be_lost_are_named_and_need_consent) {
  start_counting();
  Outcome done = reload({"counter", built("typed")});
  EXPECT_EQ(done.code, 4) << done.err;
  EXPECT_CONTAINS(done.out, "changed   filtered");
  EXPECT_CONTAINS(done.err, "--lossy");
  done = reload({"counter", built("shrunk")});
  EXPECT_EQ(done.code, 4) << done.err;
  EXPECT_CONTAINS(done.out, "changed   history");
  done = reload({"counter", built("fresh")});
  EXPECT_EQ(done.code, 4) << done.err;
  EXPECT_CONTAINS(done.out, "lost      all that it keeps: the new version does not declare what it keeps");
  EXPECT_EQ(module("counter").version.load(), 1U);
  done = reload({"counter", built("typed"), "--lossy", "--health", "0s"});
  EXPECT_EQ(done.code, 0) << done.err;
  expect_all_counted();
  done = reload({"counter", built("fresh"), "--lossy", "--health", "0s"});
  EXPECT_EQ(done.code, 0) << done.err;
  EXPECT_TRUE(wait_until([&] { return counted() > 0 && counted() < 50000; }));
}

TEST_F(Reload, Check_names_and_counts_modules_that_do_not_declare_what_they_keep) {
  const std::string file = write("kept.xml", xml({kOther,
                                                  counter(),
                                                  {.file = "caller.so", .name = "stateless", .priority = 3},
                                                  {.file = "process.exe",
                                                   .name = "process",
                                                   .type = "process",
                                                   .priority = 4,
                                                   .more = "<argument>count</argument>"},
                                                  {.file = "faulty.so", .name = "normal", .operation = "non-real"}}));
  const Outcome sut = indurop({"check", file});
  EXPECT_EQ(sut.code, 0) << sut.out << sut.err;
  EXPECT_CONTAINS(sut.out, "note: module other has variables of its own (label and own) and does not declare");
  EXPECT_CONTAINS(sut.out, "note: module process is a process");
  EXPECT_CONTAINS(sut.out, ", 2 modules without INDUROP_STATE");
  EXPECT_EQ(indurop({"check", file, "-o", "json"}).json()["undeclared"], nlohmann::json({"other", "process"}));
}

TEST_F(Reload, What_is_gone_or_new_or_longer_is_listed_and_the_rest_is_carried) {
  start_counting();
  Outcome done = reload({"counter", built("grown"), "--health", "0s"});
  EXPECT_EQ(done.code, 0) << done.err;
  EXPECT_CONTAINS(done.out, "grown     history");
  done = reload({"counter", built("less"), "--health", "0s"});
  EXPECT_EQ(done.code, 0) << done.err;
  EXPECT_CONTAINS(done.out, "kept      counted");
  EXPECT_CONTAINS(done.out, "added     own");
  EXPECT_CONTAINS(done.out, "removed   filtered, history");
  expect_all_counted();
}

TEST_F(Reload, A_dry_run_exchanges_nothing) {
  start_counting();
  const Outcome done = reload({"counter", built("other"), "--dry-run"});
  EXPECT_EQ(done.code, 0) << done.err;
  EXPECT_CONTAINS(done.err, "would be exchanged, with what it keeps");
  EXPECT_EQ(module("counter").version.load(), 1U);
  EXPECT_GT(value<std::int64_t>("nt::walked"), 0);
}

TEST_F(Reload, The_same_version_is_left_alone) {
  start_counting();
  const Outcome done = reload({"counter"});
  EXPECT_EQ(done.code, 0) << done.err;
  EXPECT_CONTAINS(done.err, "this version runs already");
  EXPECT_EQ(module("counter").version.load(), 1U);
}

TEST_F(Reload, A_start_that_takes_long_or_fails_does_not_touch_the_running_version) {
  start_counting("same", "<failsafe variable=\"nt::output\">-7</failsafe>");
  Outcome done = reload({"counter", built("slow_start"), "--health", "0s"});
  EXPECT_EQ(done.code, 0) << done.err;
  expect_all_counted();
  done = reload({"counter", built("bad_start")});
  EXPECT_EQ(done.code, 1) << done.err;
  EXPECT_CONTAINS(done.err, "start() failed: exception: no ink");
  expect_all_counted();
  EXPECT_EQ(module("counter").faults.load(), 0U);
}

TEST_F(Reload, A_file_that_cannot_be_loaded_without_harm_is_refused) {
  start_counting();
  for (const auto& [version, text] :
       {std::pair{"dies", "ended by signal 6 (Aborted)"},
        std::pair{"quits", "ended with exit code 0: one of its static constructors calls"},
        std::pair{"hangs", "does not end within 10 s"}}) {
    for (const bool dry : {true, false}) {
      if (dry && std::string_view(version) == "hangs") {
        continue;  // it takes its time
      }
      std::vector<std::string> words = {"counter", built(version)};
      if (dry) {
        words.emplace_back("--dry-run");
      }
      const Outcome done = reload(words);
      EXPECT_EQ(done.code, 4) << version << done.err;
      EXPECT_CONTAINS(done.err, text);
      EXPECT_EQ(module("counter").version.load(), 1U);
    }
  }
  expect_all_counted();
}

// Most bits change nothing that is noticed when the file is loaded: then it is accepted.
TEST_F(Reload, No_file_with_a_damaged_bit_ends_the_node) {
  start_counting();
  std::ifstream in(built("other"), std::ios::binary);
  const std::string whole((std::istreambuf_iterator<char>(in)), std::istreambuf_iterator<char>());
  const char* const other_seed = std::getenv("INDUROP_DAMAGE_SEED");
  const auto seed = static_cast<unsigned>(std::strtoul(other_seed != nullptr ? other_seed : "2241440737", nullptr, 10));
  std::mt19937 random(seed);
  int refused = 0;
  constexpr int kFiles = 40;
  for (int i = 0; i < kFiles; ++i) {
    std::string damaged = whole;
    const std::size_t place = std::uniform_int_distribution<std::size_t>(0, whole.size() - 1)(random);
    damaged[place] = static_cast<char>(damaged[place] ^ (1 << std::uniform_int_distribution<int>(0, 7)(random)));
    const std::string file = folder() / fmt::format("damaged_{}.so", i);
    std::ofstream(file, std::ios::binary) << damaged;
    refused += reload({"counter", file, "--dry-run"}).code == 0 ? 0 : 1;
    ASSERT_TRUE(runs_reach("counter", module("counter").runs.load() + 1)) << "seed " << seed << ", file " << i;
  }
  std::printf("seed %u: %d of %d files were refused\n", seed, refused, kFiles);
}

TEST_F(Reload, State_that_functions_copy_or_that_is_large_is_copied_between_two_runs) {
  for (const auto& [from, to] : {std::pair{"by", "by_other"}, std::pair{"large", "same"}}) {
    Program& program = start_counting(from);
    const Outcome done = reload({"counter", built(to), "--health", "50ms"});
    EXPECT_EQ(done.code, 0) << done.out << done.err;
    expect_all_counted();
    const Outcome back = reload({"counter", "--back"});
    EXPECT_EQ(back.code, 0) << back.err;
    expect_all_counted();
    program.signal(SIGTERM);
    EXPECT_EQ(program.wait(), 0);
  }
}

TEST_F(Reload, Sporadic_modules_are_exchanged) {
  start_and_wait(
      {kOther, {.file = "event.so", .name = "event", .operation = "sporadic", .period = "10ms", .priority = 3}});
  ASSERT_TRUE(runs_reach("event", 5));
  const std::string copy = folder() / "event.so";
  std::filesystem::copy_file(std::filesystem::path(MODULE_DIR) / "event.so", copy);
  std::ofstream(copy, std::ios::app) << "another version";
  const Outcome done = reload({"event", copy, "--lossy", "--health", "0s"});
  EXPECT_EQ(done.code, 0) << done.err;
  EXPECT_TRUE(runs_reach("event", module("event").runs.load() + 5));
  EXPECT_CONTAINS(reload({"evnt"}).err, "Did you mean 'event'?");
}

TEST_F(Reload, A_stopped_module_begins_with_the_new_version) {
  start_counting();
  ASSERT_EQ(indurop({"stop", "counter", "--node", node()}).code, 0);
  const Outcome done = reload({"counter", built("other")});
  EXPECT_EQ(done.code, 0) << done.err;
  EXPECT_CONTAINS(done.err, "is stopped, and begins with this version");
  ASSERT_EQ(indurop({"start", "counter", "--node", node()}).code, 0);
  EXPECT_TRUE(wait_until([&] { return value<std::int64_t>("nt::walked") < 0; }));
}

TEST_F(Reload, In_the_health_window_another_exchange_is_refused_and_back_is_accepted) {
  Program& sut = start_counting();
  Program first({INDUROP_PROGRAM, "reload", "counter", built("other"), "--health", "60s", "--node", node()},
                environment());
  ASSERT_TRUE(wait_until([&] { return module("counter").version_state.load() == VersionState::Watched; }));
  first.kill();  // the node does not need it any more
  const Outcome second = reload({"other", std::filesystem::path(MODULE_DIR) / "walker.so"});
  EXPECT_EQ(second.code, 4) << second.err;
  EXPECT_CONTAINS(second.err, "module counter is being exchanged");
  const Outcome back = reload({"counter", "--back"});
  EXPECT_EQ(back.code, 0) << back.err;
  EXPECT_GT(value<std::int64_t>("nt::walked"), 0);
  expect_all_counted();
  sut.signal(SIGTERM);
  EXPECT_EQ(sut.wait(), 0);
}

TEST_F(Reload, The_node_may_end_or_be_killed_at_any_time) {
  for (const int number : {SIGTERM, SIGKILL}) {
    for (const char* version : {"slow_start", "other"}) {
      Program& sut = start_counting();
      Program command({INDUROP_PROGRAM, "reload", "counter", built(version), "--health", "60s", "--node", node()},
                      environment());
      if (std::string(version) == "other") {
        ASSERT_TRUE(wait_until([&] { return module("counter").version_state.load() == VersionState::Watched; }));
      } else {
        ASSERT_TRUE(wait_until([&] { return contains(sut.out(), "sees what was walked"); }));
      }
      sut.signal(number);
      EXPECT_EQ(sut.wait(), number == SIGTERM ? 0 : 128 + SIGKILL) << sut.err();
      EXPECT_EQ(command.wait(), 6) << command.err();
    }
  }
}

TEST_F(Reload, A_recording_across_an_exchange_is_repeated_with_both_versions) {
  start_counting();
  const std::string file = folder() / "run.mcap";
  Program recorder({INDUROP_PROGRAM, "record", "-o", file, "--duration", "4s", "--node", node()}, environment());
  ASSERT_TRUE(runs_reach("counter", module("counter").runs.load() + 1500));
  ASSERT_EQ(reload({"counter", built("other"), "--health", "0s"}).code, 0);
  const auto tick = module("counter").version_tick.load();
  ASSERT_EQ(recorder.finish().code, 0);
  const Outcome before = indurop({"replay", file, "--node", node() + "-r"});
  EXPECT_EQ(before.code, 0) << before.out << before.err;
  EXPECT_CONTAINS(before.out, " values: equal");
  EXPECT_CONTAINS(before.err, "module counter: from tick " + std::to_string(tick) + " on it is the version of");
  const Outcome after = indurop({"replay", file, "--from", std::to_string(tick + 1500), "--config",
                                 write("new.xml", xml({kOther, counter("other")})), "--node", node() + "-r"});
  EXPECT_EQ(after.code, 0) << after.out << after.err;
  EXPECT_CONTAINS(after.out, " values: equal");
  EXPECT_FALSE(contains(after.err, "was exchanged")) << after.err;
}

TEST_F(Reload, Two_hundred_exchanges_leave_out_nothing_and_leave_nothing_behind) {
  start_counting();
  const auto maps = [&] {
    std::ifstream in("/proc/" + std::to_string(run()->node_pid.load()) + "/maps");
    std::size_t lines = 0;
    for (std::string line; std::getline(in, line);) {
      ++lines;
    }
    return lines;
  };
  const auto resident = [&] {
    std::ifstream in("/proc/" + std::to_string(run()->node_pid.load()) + "/statm");
    std::size_t all = 0;
    std::size_t pages = 0;
    in >> all >> pages;
    return pages;
  };
  constexpr int kExchanges = 200;
  [[maybe_unused]] std::size_t maps_before = 0;
  [[maybe_unused]] std::size_t resident_before = 0;
  for (int i = 0; i < kExchanges; ++i) {
    const Outcome done = reload({"counter", built(i % 2 == 0 ? "other" : "same"), "--health", "0s"});
    ASSERT_EQ(done.code, 0) << i << done.err;
    if (i == kExchanges / 4) {
      maps_before = maps();
      resident_before = resident();
    }
  }
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)  // they keep what was freed
  EXPECT_TRUE(wait_until([&] { return maps() <= maps_before + 8; })) << maps_before << " " << maps();
  EXPECT_LE(resident(), resident_before + 64) << "pages";
#endif
  EXPECT_EQ(module("counter").kept_loaded.load(), 0U);
  expect_all_counted();
}

}  // namespace
}  // namespace indurop::test
