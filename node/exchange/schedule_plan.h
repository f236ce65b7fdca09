// SPDX-License-Identifier: Apache-2.0
// What another configuration makes of the modules of a running node, and whether a change of its schedule is enough for
// it. Pure comparison.

#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "config/check/check.h"
#include "scheduler/run_block.h"

namespace indurop::node {

struct ModuleFate {
  enum class Kind {
    Kept,
    Rescheduled,
    Added,
    Ended,
  };
  std::string module;
  Kind kind = Kind::Kept;
  std::string text;  // "period 2 ms -> 4 ms, priority 1 -> 3"; empty: nothing more to say
};
const char* to_text(ModuleFate::Kind kind) noexcept;

struct SchedulePlan {
  static constexpr std::uint32_t kNoModule = ~std::uint32_t{0};
  std::vector<ModuleFate> modules;     // those of the other configuration, then those that end
  std::vector<std::uint32_t> indices;  // in the run block, of the modules of the other configuration; kNoModule: new
  std::vector<std::uint32_t> added;    // places in the other configuration
  std::vector<std::uint32_t> ended;    // indices in the run block
  std::vector<std::string> restarts;   // why only a restart leads there; empty: it does not need one
  bool changes = false;                // the schedule becomes another one
};

// `running`: by index in the run block, as the modules run now; those that have ended are marked there. `next` was
// checked with the result `check`.
SchedulePlan plan_schedule(const config::Config& running, const scheduler::RunBlock& run, const config::Config& next,
                           const config::CheckResult& check);

// Returns true if it is the file, by its content, that the module runs or ran last. Reads the whole file.
bool runs_file(const scheduler::ModuleRecord& module, const std::filesystem::path& file);

// Adds to a plan a restart for each module that stays and whose file in `next` is not the one that runs.
void require_same_files(SchedulePlan& plan, const scheduler::RunBlock& run, const config::Config& next);

}  // namespace indurop::node
