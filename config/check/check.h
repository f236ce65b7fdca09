// SPDX-License-Identifier: Apache-2.0
// Everything that can be known to be wrong before a module runs: files, ABI, machine, symbols, schedule, and from the
// access map who reads and writes which variable. Used by `indurop check` and by the node before it starts.

#pragma once

#include <map>
#include <memory>
#include <optional>
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

// Two modules whose order matters: on one core they are in order, on two the second waits for the first.
struct Sharing {
  std::size_t first = 0;  // indices into Config::modules
  std::size_t second = 0;
  std::string why;  // the data, or what says so
};

// What <cores> made of the periodic modules.
struct Spreading {
  struct One {
    std::size_t module = 0;  // index into Config::modules
    int core = 0;
    base::Nanos execution{};  // as told, measured, or assumed
    base::Nanos moved{};      // its offset, by so much
    std::string why;
  };
  std::vector<int> cores;    // the node's own first
  std::vector<One> modules;  // in order of execution
  bool holds = false;        // as far as execution times are right
  bool reordered = false;    // the modules have new priorities
  base::Nanos busiest{};     // from the begin of a basic period until a core is done, at most
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
  std::vector<Sharing> sharing;  // in order of execution; of one core only if its files were looked at
  std::optional<Spreading> spreading;
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

// Modules that are not all on one core, whichever that is.
bool uses_several_cores(const Config& config);

}  // namespace indurop::config
