// SPDX-License-Identifier: Apache-2.0
// All checks that are possible before a module runs: files, ABI, machine, symbols, schedule, and from the access map
// which modules read and write which variable. Used by `indurop check` and by the node before it starts.

#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "config/model/config.h"
#include "core/schema/elf.h"
#include "core/schema/schema.h"
#include "scheduler/period_table.h"

namespace indurop::config {

// The facts read from a module file. Modules built from the same .glb files contain the same schema text and share its
// schema.
struct ModuleFacts {
  schema::ModuleFile file;  // without the text of the schema
  std::shared_ptr<const schema::Schema> schema = std::make_shared<schema::Schema>();
};

struct VariableUse {
  std::string name;
  std::vector<std::string> readers;  // module names in execution order
  std::vector<std::string> writers;
};

// Worst-case response time of a module: from its release to its end.
struct Timing {
  bool known = false;   // execution times are known of it and of all modules that run before it
  base::Nanos worst{};  // scheduler::WorstResponses::kNotDone: not before its next release
};

// Two modules whose order matters: on one core they run in this order; on two cores the second waits for the first.
struct Sharing {
  std::size_t first = 0;  // indices into Config::modules
  std::size_t second = 0;
  std::string why;  // the shared data, or the setting that requires the order
};

// The distribution of the periodic modules by <cores>.
struct Spreading {
  struct One {
    std::size_t module = 0;  // index into Config::modules
    int core = 0;
    base::Nanos execution{};  // configured, measured, or assumed
    base::Nanos moved{};      // its offset was moved by this time
    std::string why;
  };
  std::vector<int> cores;    // the node's own core first
  std::vector<One> modules;  // in order of execution
  bool holds = false;        // the schedule is met, if the execution times are right
  bool reordered = false;    // the modules have new priorities
  base::Nanos busiest{};     // maximum time from the start of a basic period until a core is done
};

struct CheckResult {
  std::vector<base::Diagnostic> diagnostics;
  scheduler::PeriodTable table;       // periodic modules, indices into `periodic`
  std::vector<std::size_t> periodic;  // indices into Config::modules
  std::vector<std::size_t> sporadic;  // by priority
  std::vector<std::size_t> non_real;
  std::vector<Timing> timings;     // one per Config::modules
  double dispatch_share = 0;       // share of a core used by ticks; 0 if no module has a known execution time
  std::vector<ModuleFacts> facts;  // one per Config::modules
  schema::Schema schema;           // of all modules together
  std::vector<VariableUse> uses;   // by variable name
  // Modules that access variables by names known only at run time, indices into Config::modules.
  std::vector<std::size_t> unknown_readers;
  std::vector<std::size_t> unknown_writers;
  std::vector<std::size_t> undeclared;  // modules that do not declare what they keep; only with CheckOptions::kept
  std::vector<Sharing> sharing;  // in order of execution; pairs on one core only if the module files were checked
  std::optional<Spreading> spreading;
  [[nodiscard]] bool ok() const noexcept;  // no errors; warnings allowed
};

struct CheckOptions {
  using Times = std::map<std::string, base::Nanos>;
  bool files = true;    // check the module files; false: schedule only (plan works without built modules)
  bool adjust = false;  // --adjust: apply the proposed periods to the configuration instead of an error
  // Check against this machine: its cores and processor type. false: the modules will run on another machine.
  bool machine = true;
  bool simulation = false;       // also report what differs between runs in virtual time
  bool kept = false;             // also report modules that do not declare what they keep
  const Times* times = nullptr;  // longest measured executions by module name, used for modules without <wcet>
  std::string arch{};            // what modules must be built for: amd64, arm64; empty: any, but all for the same
  std::string board{};           // of a plant: the only board that will run on this machine; empty: all
};

CheckResult check_config(Config& config, const CheckOptions& options);

// Returns true if the modules do not all run on the same core.
bool uses_several_cores(const Config& config);

}  // namespace indurop::config
