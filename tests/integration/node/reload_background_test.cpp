// SPDX-License-Identifier: Apache-2.0
// Modules in the background, and processes released by a signal, that are exchanged while the node runs: the one that
// runs ends, and the new version continues or begins.
#include <csignal>
#include <filesystem>
#include <fstream>
#include <string>

#include "reload_fixture.h"

namespace indurop::test {
namespace {

using scheduler::ModuleState;
using scheduler::VersionState;

class ReloadBackground : public Reload {
 protected:
  static Module background(const std::string& file, const std::string& more = "<period>2ms</period>") {
    return {.file = file, .name = "counter", .operation = "non-real", .more = more};
  }
  static Module process(const std::string& argument, const std::string& operation = "non-real") {
    return {.file = "process.exe",
            .name = "process",
            .type = "process",
            .operation = operation,
            .more = "<restart max=\"3\"/><argument>" + argument + "</argument>"};
  }
  std::string copy_of(const std::string& file, int number = 1) const {
    const std::filesystem::path from = std::filesystem::path(MODULE_DIR) / file;
    const std::string copy = folder().string() + "/" + std::to_string(number) + from.extension().string();
    std::filesystem::copy_file(from, copy);
    std::ofstream(copy, std::ios::app) << "version " << number;
    return copy;
  }
  // Each run was executed once, and counted.
  bool counts_all() {
    return wait_until([&] {
      const auto runs = static_cast<std::int64_t>(module("counter").runs.load());
      const std::int64_t now = counted();
      return runs > 0 && (now == runs || now == runs + 1);
    });
  }
  bool comes_to_run(const std::string& program) {
    return wait_until([&] {
      const pid_t now = module("process").pid.load();
      std::error_code gone;
      return now > 0 && std::filesystem::read_symlink("/proc/" + std::to_string(now) + "/exe", gone) == program;
    });
  }
  bool runs_more() { return runs_reach("counter", module("counter").runs.load() + 20); }
  void expect_other_undisturbed() {
    EXPECT_EQ(module("other").skipped.load(), run()->lost_ticks.load());
    EXPECT_EQ(module("other").faults.load(), 0U);
  }
};

TEST_F(ReloadBackground, A_thread_continues_with_what_it_keeps_and_returns) {
  Program& sut = start_and_wait({kOther, background("reload_same.so")});
  ASSERT_TRUE(runs_reach("counter", 20));
  for (int i = 0; i < 5; ++i) {
    const Outcome done = reload({"counter", copy_of("reload_same.so", i), "--health", "0s"});
    ASSERT_EQ(done.code, 0) << done.err;
    EXPECT_CONTAINS(done.err, "exchanged, with what it keeps");
    EXPECT_TRUE(runs_more());
    EXPECT_TRUE(counts_all()) << counted() << " of " << module("counter").runs.load();
  }
  Program client({INDUROP_PROGRAM, "reload", "counter", built("other"), "--health", "60s", "--node", node()},
                 environment());
  ASSERT_TRUE(wait_until([&] { return module("counter").version_state.load() == VersionState::Watched; }));
  EXPECT_TRUE(runs_more());
  EXPECT_TRUE(counts_all());
  EXPECT_EQ(reload({"counter", "--back"}).code, 0);
  EXPECT_EQ(client.wait(), 5) << client.err();
  EXPECT_TRUE(runs_more());
  EXPECT_TRUE(counts_all()) << counted() << " of " << module("counter").runs.load();
  EXPECT_EQ(module("counter").version.load(), 8U);
  expect_other_undisturbed();
  sut.signal(SIGTERM);
  EXPECT_EQ(sut.wait(), 0) << sut.err();
}

TEST_F(ReloadBackground, A_thread_that_fails_gives_way_to_the_previous_version) {
  start_and_wait({kOther, background("reload_same.so")});
  ASSERT_TRUE(runs_reach("counter", 20));
  const Outcome thrown = reload({"counter", built("throws"), "--lossy", "--health", "60s"});
  EXPECT_EQ(thrown.code, 5) << thrown.err;
  EXPECT_CONTAINS(thrown.err, "the new one faulted");
  EXPECT_EQ(module("counter").state.load(), ModuleState::Running);
  EXPECT_TRUE(runs_more());
  EXPECT_EQ(reload({"counter", built("other"), "--health", "60s", "--guard", "nt::walked >= 0"}).code, 5);
  EXPECT_EQ(reload({"counter", built("bad_start"), "--lossy"}).code, 1);
  EXPECT_EQ(reload({"counter", built("fresh")}).code, 4);
  EXPECT_TRUE(runs_more());
  EXPECT_EQ(module("counter").faults.load(), 1U);
  expect_other_undisturbed();
}

TEST_F(ReloadBackground, A_run_that_does_not_return_is_left_alone) {
  Module slow = background("faulty.so");
  slow.properties = {{"busy_us", "3500000"}};
  start_and_wait({kOther, slow});
  ASSERT_TRUE(wait_until([&] { return module("counter").state.load() == ModuleState::Running; }));
  const Outcome late = reload({"counter", copy_of("faulty.so"), "--lossy", "--health", "0s"});
  EXPECT_EQ(late.code, 1) << late.err;
  EXPECT_CONTAINS(late.err, "its run does not return within 2 s");
  EXPECT_EQ(module("counter").state.load(), ModuleState::Running);
  EXPECT_EQ(module("counter").version.load(), 1U);
}

TEST_F(ReloadBackground, A_module_that_runs_once_runs_again) {
  start_and_wait({kOther, background("reload_same.so", "")});
  ASSERT_TRUE(wait_until([&] { return module("counter").state.load() == ModuleState::Exited; }));
  const Outcome done = reload({"counter", copy_of("reload_same.so"), "--health", "0s"});
  EXPECT_EQ(done.code, 0) << done.err;
  EXPECT_TRUE(wait_until([&] { return counted() == 2; }));
  ASSERT_EQ(indurop({"stop", "counter", "--node", node()}).code, 0);
  EXPECT_CONTAINS(reload({"counter", copy_of("reload_same.so", 2)}).err, "is stopped, and begins with this version");
  ASSERT_EQ(indurop({"start", "counter", "--node", node()}).code, 0);
  EXPECT_TRUE(wait_until([&] { return module("counter").runs.load() == 3; }));
}

TEST_F(ReloadBackground, A_process_ends_and_one_of_the_new_version_is_launched) {
  Program& sut = start_and_wait({kOther, process("count")});
  const pid_t first = module("process").pid.load();
  const std::string next = copy_of("process.exe");
  EXPECT_CONTAINS(reload({"process", next}).err, "--lossy exchanges it nevertheless");
  EXPECT_EQ(reload({"process", "/bin/false", "--lossy", "--health", "0s"}).code, 1);
  const Outcome done = reload({"process", next, "--lossy", "--health", "0s"});
  EXPECT_EQ(done.code, 0) << done.err;
  EXPECT_CONTAINS(done.out, "its process ends before the next one is launched");
  EXPECT_NE(module("process").pid.load(), first);
  EXPECT_NE(::kill(first, 0), 0);
  EXPECT_TRUE(comes_to_run(next));
  EXPECT_EQ(module("process").version.load(), 2U);
  int number = 1;
  for (const std::string bad : {"/bin/false", "killed", "back"}) {
    const std::string file = bad == "/bin/false" ? bad : copy_of("process.exe", ++number);
    Program client({INDUROP_PROGRAM, "reload", "process", file, "--lossy", "--health", "60s", "--node", node()},
                   environment());
    if (bad != "/bin/false") {
      ASSERT_TRUE(wait_until([&] { return module("process").version_state.load() == VersionState::Watched; }));
      bad == "back" ? (void)reload({"process", "--back"}) : (void)::kill(module("process").pid.load(), SIGKILL);
    }
    EXPECT_NE(client.wait(), 0) << bad << client.err();
    EXPECT_TRUE(comes_to_run(next)) << bad;
    EXPECT_EQ(module("process").state.load(), ModuleState::Running);
  }
  EXPECT_EQ(module("process").restarts.load(), 0U);
  expect_other_undisturbed();
  sut.signal(SIGTERM);
  EXPECT_EQ(sut.wait(), 0) << sut.err();
}

TEST_F(ReloadBackground, A_process_brings_variables) {
  start_and_wait(
      {kOther, {.file = "rambler_process.exe", .name = "process", .type = "process", .operation = "non-real"}});
  const Outcome done = reload({"process", copy_of("rambler_gains_process.exe"), "--lossy", "--health", "0s"});
  EXPECT_EQ(done.code, 0) << done.err;
  EXPECT_CONTAINS(done.out, "new       nt::gained, nt::pair, nt::limit");
  EXPECT_EQ(value<std::int64_t>("nt::gained"), 11);
  EXPECT_EQ(module("process").state.load(), ModuleState::Running);
}

TEST_F(ReloadBackground, A_process_that_is_released_by_a_signal_is_launched_again) {
  start_and_wait({kOther,
                  {.file = "legacy.exe",
                   .name = "legacy",
                   .type = "process",
                   .period = "5ms",
                   .priority = 2,
                   .more = "<argument>" + (folder() / "wakes").string() + "</argument><signal>SIGUSR1</signal>"}});
  ASSERT_TRUE(runs_reach("legacy", 20));
  const pid_t first = module("legacy").pid.load();
  const Outcome done = reload({"legacy", copy_of("legacy.exe"), "--lossy", "--health", "100ms"});
  EXPECT_EQ(done.code, 0) << done.err;
  EXPECT_NE(module("legacy").pid.load(), first);
  EXPECT_TRUE(runs_reach("legacy", module("legacy").runs.load() + 20));
  EXPECT_EQ(module("legacy").faults.load(), 0U);
  expect_other_undisturbed();
}

}  // namespace
}  // namespace indurop::test
