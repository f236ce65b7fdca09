// SPDX-License-Identifier: Apache-2.0
// A node without modules' code: its store and run block under a name of this test process, removed at the end.

#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "core/schema/schema.h"
#include "scheduler/run_block.h"
#include "store/vars/run_file.h"
#include "store/vars/store.h"
#include "tests/support/wait_until.h"

namespace indurop::testing {

// The variables and functions of sample.glb, as this test program carries them.
schema::Schema sample_schema();

struct TestModule {
  std::string name;
  scheduler::ModuleType type = scheduler::ModuleType::Thread;
  std::int64_t period_ns = 1'000'000;
  std::vector<std::pair<std::string, std::string>> properties;
  std::string file;
};

class TestNode {
 public:
  // The name of the next TestNode, for who must know it before there is one.
  static std::string next_name();
  explicit TestNode(const std::vector<TestModule>& modules = {{"m", {}, 1'000'000, {}, ""}},
                    const schema::Schema& schema = sample_schema(), std::uint32_t ring_capacity = 8);
  ~TestNode();
  TestNode(const TestNode&) = delete;
  TestNode& operator=(const TestNode&) = delete;

  [[nodiscard]] const std::string& name() const noexcept { return name_; }
  vars::Store& store() noexcept { return *store_; }
  scheduler::RunBlock& run() noexcept { return *static_cast<scheduler::RunBlock*>(run_->data()); }
  scheduler::ModuleRecord& module(std::size_t index) noexcept { return run().modules()[index]; }
  scheduler::ProcessSlot& slot(std::size_t index) noexcept { return run().process_slots()[index]; }
  void release(std::size_t index, std::uint64_t tick = 0, std::int64_t grid_ns = 0) noexcept;

  // As after a restart of the node: a new store (another layout retires the old one) and a new run block.
  void restart(const schema::Schema& schema, const std::vector<TestModule>& modules);

 private:
  void make_run(const std::vector<TestModule>& modules);
  std::string name_;
  std::uint32_t ring_capacity_;
  std::unique_ptr<vars::Store> store_;
  std::unique_ptr<vars::RunFile> run_;
};

using test::wait_until;

}  // namespace indurop::testing
