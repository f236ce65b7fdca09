// SPDX-License-Identifier: Apache-2.0
// Everything that can be known to be wrong before a module runs: files, ABI, machine, symbols, schedule, and from the
// access map who reads and writes which variable. Used by `indurop check` and by the node before it starts.

#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "config/model/config.h"
#include "scheduler/period_table.h"
#include "schema/elf.h"
#include "schema/schema.h"

namespace indurop::config {

// Modules built from the same .glb files contain the same text; they share what was read from it.
struct ModuleFacts {
  schema::ModuleFile file;  // without the text of the schema
  std::shared_ptr<const schema::Schema> schema = std::make_shared<schema::Schema>();
};

struct VariableUse {
  std::string name;
  std::vector<std::string> readers;  // module names in execution order
  std::vector<std::string> writers;
};

// How long a module takes at most from its release to its end.
struct Timing {
  bool known = false;   // it and all that run before it say how long they execute
  base::Nanos worst{};  // scheduler::WorstResponses::kNotDone: not before its next release
};

struct CheckResult {
  std::vector<base::Diagnostic> diagnostics;
  scheduler::PeriodTable table;       // periodic modules, indices into `periodic`
  std::vector<std::size_t> periodic;  // indices into Config::modules
  std::vector<std::size_t> sporadic;  // by priority
  std::vector<std::size_t> non_real;
  std::vector<Timing> timings;     // one per Config::modules
  double dispatch_share = 0;       // of a core, for ticks; 0 if no module says how long it executes
  std::vector<ModuleFacts> facts;  // one per Config::modules
  schema::Schema schema;           // of all modules together
  std::vector<VariableUse> uses;   // by variable name
  // Modules that read or write by names known only at run time, indices into Config::modules.
  std::vector<std::size_t> unknown_readers;
  std::vector<std::size_t> unknown_writers;
  [[nodiscard]] bool ok() const noexcept;  // no errors; warnings allowed
};

struct CheckOptions {
  using Times = std::map<std::string, base::Nanos>;
  bool files = true;    // look at the module files; false: schedule only (plan works without built modules)
  bool adjust = false;  // --adjust: apply the proposed periods to the configuration instead of an error
  // Compare with this machine: its cores, its kind of processor. false: the modules are to run elsewhere.
  bool machine = true;
  bool simulation = false;       // also note what a run in virtual time cannot repeat
  const Times* times = nullptr;  // longest executions that were measured, by module: of those without <wcet>
  std::string board{};  // of a plant: the only one of its boards that is to run on this machine; empty: all are
};

CheckResult check_config(Config& config, const CheckOptions& options);

}  // namespace indurop::config
