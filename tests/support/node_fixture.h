// SPDX-License-Identifier: Apache-2.0
// Tests of indurop-node from outside: nodes with names of their own, started and inspected as a user would, and what
// they leave is removed in any case.

#pragma once

#include <gmock/gmock.h>

#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "scheduler/run_block.h"
#include "store/vars/run_file.h"
#include "tests/support/program.h"
#include "tests/support/unprivileged.h"

// Named as GoogleTest names its own.
// NOLINTBEGIN(cppcoreguidelines-macro-usage,readability-identifier-naming)
#if defined(__SANITIZE_THREAD__)
#define SKIP_CRASHES_UNDER_TSAN() GTEST_SKIP() << "ThreadSanitizer cannot follow a jump out of a crashed module"
#else
#define SKIP_CRASHES_UNDER_TSAN() static_cast<void>(0)
#endif

#define EXPECT_CONTAINS(text, part) EXPECT_PRED2(::indurop::test::contains, text, part)
// NOLINTEND(cppcoreguidelines-macro-usage,readability-identifier-naming)

namespace indurop::test {

inline bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

// One <module>.
struct Module {
  std::string file{};  // in the folder of the test modules
  std::string name{};
  std::string type = "thread";
  std::string operation = "periodic";
  std::string period = "1ms";  // sporadic: the deadline
  int priority = 1;
  std::vector<std::pair<std::string, std::string>> properties{};
  std::string more{};  // further elements, as they are written
};
std::string xml(const std::vector<Module>& modules);

class NodeTest : public ::testing::Test {
 protected:
  NodeTest();
  void TearDown() override;

  [[nodiscard]] const std::string& node() const noexcept { return name_; }
  [[nodiscard]] const std::filesystem::path& folder() const noexcept { return folder_; }
  std::string write(const std::string& file, const std::string& text) const;
  [[nodiscard]] Environment environment() const;

  // indurop-node with these modules, under this test's node name. It has started when run() shows it.
  Program& start(const std::vector<Module>& modules, const std::vector<std::string>& more = {});
  Program& start_file(const std::string& file, const std::vector<std::string>& more, const Environment& environment);
  Program& start_file(const std::string& file, const std::vector<std::string>& more = {}) {
    return start_file(file, more, environment());
  }
  // The same and waits until its schedule runs; says what the node said if it does not.
  Program& start_and_wait(const std::vector<Module>& modules, const std::vector<std::string>& more = {});
  bool wait_until_running(Program& program);
  // The same, run to its end.
  Outcome run_to_end(const std::vector<Module>& modules, const std::vector<std::string>& more = {});

  // `indurop` with these arguments.
  Outcome indurop(const std::vector<std::string>& arguments) const;

  // The node's newest run block, null if there is none. Stays valid until the test ends.
  const scheduler::RunBlock* run();
  const scheduler::ModuleRecord& module(const std::string& name);
  bool runs_reach(const std::string& name, std::uint64_t runs);
  // A scalar variable, or word [0] of an array; fails the test if there is none.
  template <class T>
  T value(const std::string& name) const {
    T result{};
    read(name, &result, sizeof result);
    return result;
  }
  // Every run that the node counts of "process", which is process.exe, was executed by one process, and none twice.
  void expect_each_run_once();
  [[nodiscard]] std::vector<std::string> files_left() const;

  std::vector<std::unique_ptr<Program>> programs_;

 private:
  void read(const std::string& name, void* to, std::size_t size) const;
  std::string name_;
  std::filesystem::path folder_;
  std::map<std::uint64_t, vars::RunFile> seen_;  // by inode
};

// The slot log, per tick the modules in the order they started, without ticks at the rim of the log and those in which
// a module did not run because of a lost basic period.
struct Started {
  std::uint64_t tick;
  std::uint32_t module;
  std::int64_t start_ns;
  std::int64_t end_ns;
};
std::vector<Started> slot_log(const scheduler::RunBlock& run);

// Starts of periodic modules that came before the end of one with a higher priority released in the same tick.
int order_violations(const scheduler::RunBlock& run);

}  // namespace indurop::test
