// SPDX-License-Identifier: Apache-2.0
// The comparison of one module with its recorded runs, for Replay::report: it goes on with what it wrote itself, so
// that it shows what this file of the module would have done in the recorded one's place.

#pragma once

#include <indurop/result.h>

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "core/base/problem.h"
#include "node/replay/other_declarations.h"
#include "node/replay/replayed_module.h"

namespace indurop::node {

class Alone {
 public:
  // Both are borrowed.
  Alone(ReplayedModule& module, const vars::Store& store);

  [[nodiscard]] ReplayedModule& module() const noexcept { return module_; }
  // It begins with initial values, because of `why`: nothing tells what the recorded module kept.
  void begin_with_initial_values(const std::string& why) {
    initial_values_ = initial_values_.empty() ? why : initial_values_;
  }
  // Notes a run that was repeated and compared.
  void note(const recorder::RunWords& run);
  // Writes the result as JSON (docs/reload.md). Errors: those of the disk.
  [[nodiscard]] Result<void, base::Problem> write(const std::filesystem::path& file,
                                                  const OtherDeclarations& others) const;

 private:
  ReplayedModule& module_;
  const vars::Store& store_;
  std::string initial_values_;
  std::uint64_t first_tick_ = 0;
  std::uint64_t last_tick_ = 0;
  std::vector<std::int64_t> now_ns_;   // processor time of each run
  std::vector<std::int64_t> then_ns_;  // from the first to the last instruction of each recorded run
};

}  // namespace indurop::node
