// SPDX-License-Identifier: Apache-2.0
// Third phase of a run: the thread modules are loaded into this process and bound to the store, and the scheduler's
// tasks call them.

#pragma once

#include <vector>

#include "node/modules/module_library.h"
#include "node/run/prepared.h"
#include "scheduler/task.h"

namespace indurop::node {

// Keeps the variables of this process attached to a store. The destructor moves them back to private memory.
class Attached {
 public:
  Attached() = default;
  Attached(Attached&& other) noexcept : held_(std::exchange(other.held_, false)) {}
  Attached(const Attached&) = delete;
  Attached& operator=(const Attached&) = delete;
  Attached& operator=(Attached&&) = delete;
  ~Attached();

 private:
  bool held_ = true;
};

struct Loaded {
  std::vector<ModuleLibrary> libraries;  // one per module, empty for processes
  std::vector<scheduler::Task> tasks;
  Attached attached;  // destroyed before the libraries
};

Result<Loaded, Ending> load(const Options& options, const Checked& checked, const Prepared& prepared,
                            const Console& console, base::StopSignal& signals);

}  // namespace indurop::node
