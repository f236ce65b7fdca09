// SPDX-License-Identifier: Apache-2.0
// Lays out and fills in a run block before a run. Not real-time safe.

#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "scheduler/run_block.h"

namespace indurop::scheduler {

struct ModuleSetup {
  std::string name;
  std::string file;
  ModuleType type = ModuleType::Thread;
  Operation operation = Operation::Periodic;
  OverrunPolicy overrun = OverrunPolicy::Skip;
  int priority = 0;
  int core = -1;
  std::int64_t period_ns = 0;
  std::int64_t offset_ns = 0;
  std::int64_t deadline_ns = 0;
  std::int64_t budget_ns = 0;
  std::vector<std::pair<std::string, std::string>> properties;
};

struct RunBlockSetup {
  std::string node_name;
  std::string config_file;
  std::string board;       // name in the plant; empty: none
  std::string plant_file;  // empty: none
  std::string deployment;
  std::int64_t basic_period_ns = 0;
  std::int64_t macro_period_ns = 0;
  std::uint64_t slot_count = 0;
  std::vector<ModuleSetup> modules;
};

// How many modules can be added while the node runs, and the bytes of their properties.
inline constexpr std::uint32_t kSpareModules = 8;
inline constexpr std::size_t kSpareProperties = 4096;

// Returns the size in bytes of a block for this setup.
std::size_t run_block_size(const RunBlockSetup& setup);

// `block` points to run_block_size() zero bytes. The magic is stored last.
void init_run_block(RunBlock& block, const RunBlockSetup& setup);

// Adds a module that no schedule has: it is stopped, and has ended. Returns its index; nothing if there is no room for
// it or its properties. One thread of the node.
std::optional<std::uint32_t> add_module(RunBlock& block, const ModuleSetup& setup);

}  // namespace indurop::scheduler
