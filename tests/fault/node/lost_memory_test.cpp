// SPDX-License-Identifier: Apache-2.0
// A node whose shared memory is cut by a process with write access ends in a defined state; one whose files were
// removed says so and keeps its name.

#include <sys/resource.h>
#include <unistd.h>
#include <csignal>

#include <filesystem>
#include <regex>
#include <string>
#include <vector>

#include "node_fixture.h"
#include "store/vars/store.h"

namespace indurop::test {
namespace {

using ::testing::HasSubstr;

std::vector<Module> with_failsafe() {
  return {
      {.file = "counter.so", .name = "counter", .more = "<failsafe variable=\"nt::output\">-7</failsafe>"},
      {.file = "process.exe", .name = "process", .type = "process", .period = "5ms", .priority = 2},
  };
}

class LostMemory : public NodeTest {
 protected:
  void SetUp() override {
    sut_ = &start_and_wait(with_failsafe());
    ASSERT_TRUE(runs_reach("counter", 20));
    child_ = module("process").pid.load();
  }
  [[nodiscard]] std::string block() const { return "/dev/shm/" + vars::block_file(node()); }
  void expect_defined_end() {
    EXPECT_EQ(sut_->wait(), 1) << sut_->err();
    EXPECT_THAT(sut_->err(), HasSubstr("truncated it: values were lost"));
    EXPECT_THAT(sut_->err(), HasSubstr("the black box is in"));
    EXPECT_THAT(run()->stop_reason, HasSubstr("values were lost"));
    EXPECT_EQ(run()->state.load(), scheduler::NodeState::Failed);
    EXPECT_TRUE(wait_until([this] { return !alive(child_); }));
    std::filesystem::remove(block());
    EXPECT_EQ(run_to_end(with_failsafe(), {"--duration", "20ms"}).code, 0) << "the next start works";
  }

  Program* sut_ = nullptr;
  pid_t child_ = 0;
};

TEST_F(LostMemory, Cut_to_nothing) {
  SKIP_CRASHES_UNDER_TSAN();
  ASSERT_EQ(::truncate(block().c_str(), 0), 0);
  expect_defined_end();
}

TEST_F(LostMemory, Emptied_and_grown_again) {
  SKIP_CRASHES_UNDER_TSAN();
  const auto size = static_cast<off_t>(std::filesystem::file_size(block()));
  ASSERT_EQ(::truncate(block().c_str(), 0), 0);
  ASSERT_EQ(::truncate(block().c_str(), size), 0);
  expect_defined_end();
}

TEST_F(LostMemory, What_is_left_gets_the_values_declared_for_faults) {
  SKIP_CRASHES_UNDER_TSAN();
  const auto store = vars::Store::attach(node(), vars::Mode::ReadOnly);
  ASSERT_TRUE(store.ok());
  const auto* const output = store->find(abi::fnv1a64("nt::output", 10));
  ASSERT_NE(output, nullptr);
  const auto size = static_cast<off_t>(std::filesystem::file_size(block()));
  const off_t rest = static_cast<off_t>(output->offset / 4096 + 1) * 4096;
  ASSERT_LT(rest, size);
  ASSERT_EQ(::truncate(block().c_str(), rest), 0);
  expect_defined_end();
  std::int32_t value = 0;
  EXPECT_TRUE(store->read(*output, 0, {reinterpret_cast<std::uint8_t*>(&value), sizeof value}).ok());
  EXPECT_EQ(value, -7);
}

TEST_F(LostMemory, The_run_block_or_the_tape_counts_as_well) {
  SKIP_CRASHES_UNDER_TSAN();
  ASSERT_EQ(::truncate(("/dev/shm/" + vars::tape_file(node())).c_str(), 4096), 0);
  EXPECT_EQ(sut_->wait(), 1) << sut_->err();
  EXPECT_THAT(sut_->err(), HasSubstr(vars::tape_file(node()) + " truncated it"));
}

TEST_F(LostMemory, Removed_files_are_reported_and_not_taken_over) {
  for (const std::string& file : files_left()) {
    std::filesystem::remove("/dev/shm/" + file);
  }
  const Outcome second = run_to_end(with_failsafe(), {"--duration", "20ms"});
  EXPECT_EQ(second.code, 1);
  EXPECT_THAT(second.err, HasSubstr("already running"));
  EXPECT_TRUE(sut_->says("a process removed files of this node from /dev/shm")) << sut_->err();
  EXPECT_TRUE(sut_->running());
  EXPECT_TRUE(wait_until([this] {
    const std::string nodes = indurop({"nodes"}).out;  // other nodes of this machine may have longer names
    return std::regex_search(nodes, std::regex("(^|\n)" + node() + " +files removed"));
  }));
  EXPECT_THAT(indurop({"vars", "--node", node()}).err, HasSubstr("its files in /dev/shm were removed"));
  EXPECT_EQ(indurop({"stop", "--node", node()}).code, 0);
  EXPECT_EQ(sut_->wait(), 0);
}

TEST_F(NodeTest, A_limit_of_file_sizes_is_named) {
  Environment limited = environment();
  limited.prepare = [] {
    const rlimit none{2048, 2048};
    return ::setrlimit(RLIMIT_FSIZE, &none) == 0;
  };
  // What it prints goes to files, too: through a pipe it is not limited.
  Program& sut = start_file(write("module.xml", xml({{.file = "counter.so", .name = "counter"}})), {}, limited);
  EXPECT_EQ(sut.wait(), 1);
  EXPECT_THAT(sut.err(), HasSubstr("ulimit -f"));
}

}  // namespace
}  // namespace indurop::test
